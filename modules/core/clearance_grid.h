#pragma once

#include <algorithm>
#include <bit>
#include <cstdint>
#include <functional>
#include <vector>

#include "core/math.h"

namespace pneuma {

/// A lattice of cubic cells over a region's box. Each cell knows how far it is from the region's
/// wall, so that "inside?" far from the wall costs one look-up however the region is described.
///
/// A cell's clearance is k > 0 if it and all cells within k - 1 steps (also diagonal ones) lie
/// wholly inside, k < 0 likewise outside, and 0 if the wall may pass through it.
class ClearanceGrid {
 public:
  enum class Cell : std::int8_t { Outside = -1, Wall = 0, Inside = 1 };

  /// Lays cells of `cellMm` over `box` with a margin of one cell.
  /// @throws InvalidInput if more than 2^31 cells would be needed
  ClearanceGrid(const Box3& box, double cellMm);

  const Vec3& origin() const { return origin_; }

  double cellMm() const { return cellMm_; }

  /// Cells along x, y, z.
  const Eigen::Vector3i& size() const { return size_; }

  Vec3 cellCentre(int i, int j, int k) const {
    return origin_ + cellMm_ * Vec3(i + 0.5, j + 0.5, k + 0.5);
  }

  /// The cell that holds `p`; may lie off the lattice.
  Eigen::Vector3i cellOf(const Vec3& p) const {
    return ((p - origin_) * inverseCellMm_).array().floor().matrix().cast<int>();
  }

  bool onLattice(const Eigen::Vector3i& cell) const {
    return (cell.array() >= 0).all() && (cell.array() < size_.array()).all();
  }

  std::size_t index(int i, int j, int k) const {
    return static_cast<std::size_t>(i) +
           static_cast<std::size_t>(size_.x()) *
               (static_cast<std::size_t>(j) +
                static_cast<std::size_t>(size_.y()) * static_cast<std::size_t>(k));
  }

  /// Says what every cell is; clearances follow from that.
  /// @pre kinds.size() == number of cells, in the order of index()
  void setCells(const std::vector<Cell>& kinds);

  /// Signed clearance in cells of the cell that holds `p`; -1 off the lattice.
  int clearance(const Vec3& p) const {
    const Vec3 q = (p - origin_) * inverseCellMm_;
    return holds(q) ? clearance_[indexOf(q)] : -1;
  }

  /// A distance that `p` certainly keeps from the wall, mm; 0 if its cell may hold the wall.
  double clearanceMm(const Vec3& p) const;

  /// True only if the whole box certainly lies inside, off the wall.
  bool keepsInside(const Box3& box) const;

  /// As Domain::insideAlongX(): what is far from the wall answers for its neighbours as well.
  /// @param contains `contains(p)`: the answer for one point
  template <class Contains>
  std::uint32_t insideAlongX(const Vec3& first, double stepMm, std::uint32_t wanted,
                             Contains&& contains) const {
    std::uint32_t inside = 0;
    std::uint32_t left = wanted;
    while (left != 0) {
      const int i = std::countr_zero(left);
      const Vec3 p = first + Vec3(i * stepMm, 0.0, 0.0);
      const int alike = std::min(31 - i, static_cast<int>(clearanceMm(p) / stepMm));
      const std::uint32_t bits = ((2U << alike) - 1U) << i;
      if (contains(p)) inside |= bits;
      left &= ~bits;
    }
    return inside & wanted;
  }

  std::size_t cellCount() const { return clearance_.size(); }

 private:
  /// Is `q`, in cells from the origin, on the lattice? False for NaN.
  bool holds(const Vec3& q) const {
    return q.x() >= 0.0 && q.y() >= 0.0 && q.z() >= 0.0 && q.x() < size_.x() && q.y() < size_.y() &&
           q.z() < size_.z();
  }

  std::size_t indexOf(const Vec3& q) const {
    return index(static_cast<int>(q.x()), static_cast<int>(q.y()), static_cast<int>(q.z()));
  }

  Vec3 origin_;
  double cellMm_;
  double inverseCellMm_;
  Eigen::Vector3i size_;
  std::vector<std::int8_t> clearance_;
};

}  // namespace pneuma
