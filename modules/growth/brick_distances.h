#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "growth/cube_walk.h"

namespace pneuma {

/// How far every brick of a lattice is from the nearest occupied one, in bricks, the largest
/// coordinate counting (diagonal neighbours are 1 away). What is occupied stays so.
template <int D>
class BrickDistances {
 public:
  static constexpr int Farthest = 40;  ///< as far as distances are told apart

  /// @param bricks along each axis
  explicit BrickDistances(const LatticeCell<D>& bricks)
      : bricks_(bricks), distance_(static_cast<std::size_t>(bricks.prod()), Farthest) {}

  /// 0 for an occupied brick.
  int at(std::size_t brick) const { return distance_[brick]; }

  std::size_t index(const LatticeCell<D>& brick) const {
    std::size_t index = 0;
    for (int axis = D - 1; axis >= 0; --axis) {
      index =
          index * static_cast<std::size_t>(bricks_[axis]) + static_cast<std::size_t>(brick[axis]);
    }
    return index;
  }

  /// Forgets what was occupied and takes these, one flag a brick: Chebyshev distances in two passes
  /// (Rosenfeld and Pfaltz 1966).
  void set(const std::vector<char>& occupied) {
    for (std::size_t i = 0; i < distance_.size(); ++i)
      distance_[i] = occupied[i] != 0 ? 0 : Farthest;
    for (const int way : {-1, 1}) {
      for (std::size_t k = 0; k < distance_.size(); ++k) {
        const std::size_t i = way < 0 ? k : distance_.size() - 1 - k;
        if (distance_[i] > 0) lowerByNeighbours(i, way);
      }
    }
  }

  /// Ring after ring around the brick, until one has nothing left to lower: no farther ring has
  /// then, since neighbours differ by at most one.
  void occupy(const LatticeCell<D>& brick) {
    for (int ring = 0; ring < Farthest; ++ring) {
      if (!lowerRing(brick, ring)) return;
    }
  }

 private:
  /// By those of the neighbours that come before the brick (way -1) or after it (+1).
  void lowerByNeighbours(std::size_t index, int way) {
    LatticeCell<D> brick;
    std::size_t left = index;
    for (int axis = 0; axis < D; ++axis) {
      brick[axis] = static_cast<int>(left % static_cast<std::size_t>(bricks_[axis]));
      left /= static_cast<std::size_t>(bricks_[axis]);
    }
    for (int k = 0; k < (D == 2 ? 4 : 13); ++k) {  // the first half of the 3^D around it
      LatticeCell<D> other;
      bool inside = true;
      int digits = k;
      for (int axis = D - 1, power = D == 2 ? 3 : 9; axis >= 0; --axis, power /= 3) {
        other[axis] = brick[axis] - way * (digits / power - 1);
        digits %= power;
        inside = inside && other[axis] >= 0 && other[axis] < bricks_[axis];
      }
      if (!inside) continue;
      distance_[index] = std::min<std::uint8_t>(
          distance_[index], static_cast<std::uint8_t>(distance_[this->index(other)] + 1));
    }
  }

  /// True if any distance was lowered.
  bool lowerRing(const LatticeCell<D>& centre, int ring) {
    bool lowered = false;
    const int low = std::max(centre[D - 1] - ring, 0);
    const int high = std::min(centre[D - 1] + ring, bricks_[D - 1] - 1);
    for (int last = low; last <= high; ++last) {
      const bool face = std::abs(last - centre[D - 1]) == ring;
      if constexpr (D == 2) {
        lowered = lowerRow({0, last}, centre, ring, face) || lowered;
      } else {
        for (int y = std::max(centre[1] - ring, 0); y <= std::min(centre[1] + ring, bricks_[1] - 1);
             ++y) {
          const bool side = face || std::abs(y - centre[1]) == ring;
          lowered = lowerRow({0, y, last}, centre, ring, side) || lowered;
        }
      }
    }
    return lowered;
  }

  /// A row of the ring along x: all of it, or only its two ends.
  bool lowerRow(LatticeCell<D> row, const LatticeCell<D>& centre, int ring, bool whole) {
    const auto value = static_cast<std::uint8_t>(ring);
    std::uint8_t* distances = distance_.data() + index(row);
    const int low = centre[0] - ring;
    const int high = centre[0] + ring;
    bool lowered = false;
    const auto lower = [&](int x) {
      if (x < 0 || x >= bricks_[0] || distances[x] <= value) return;
      distances[x] = value;
      lowered = true;
    };
    if (whole) {
      for (int x = std::max(low, 0); x <= std::min(high, bricks_[0] - 1); ++x) lower(x);
    } else {
      lower(low);
      lower(high);
    }
    return lowered;
  }

  LatticeCell<D> bricks_;
  std::vector<std::uint8_t> distance_;
};

}  // namespace pneuma
