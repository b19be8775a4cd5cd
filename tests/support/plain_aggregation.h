#pragma once

#include <functional>
#include <set>
#include <vector>

#include "core/random.h"
#include "growth/cube_walk.h"

namespace pneuma::testing {

/// Diffusion-limited aggregation as one reads it, one step after the other: the reference for the
/// engine in modules/growth, with which it shares no code. Steps out of the region are refused.
template <int D>
class PlainAggregation {
 public:
  using Cell = LatticeCell<D>;

  PlainAggregation(std::function<bool(const Cell&)> inside, std::vector<Cell> sites,
                   const Cell& seed)
      : inside_(std::move(inside)), sites_(std::move(sites)) {
    cluster_.insert(key(seed));
  }

  /// The particles in order of arrival.
  std::vector<Cell> run(std::size_t count, Random& random) {
    std::vector<Cell> particles;
    while (particles.size() < count) {
      const Cell start = sites_[random.below(sites_.size())];
      if (cluster_.contains(key(start))) continue;
      particles.push_back(walk(start, random));
      cluster_.insert(key(particles.back()));
    }
    return particles;
  }

 private:
  static std::vector<int> key(const Cell& cell) { return {cell.data(), cell.data() + D}; }

  static Cell step(int way) {
    Cell cell = Cell::Zero();
    cell[way / 2] = way % 2 == 0 ? 1 : -1;
    return cell;
  }

  Cell walk(Cell cell, Random& random) const {
    while (true) {
      for (int way = 0; way < 2 * D; ++way) {
        if (cluster_.contains(key(cell + step(way)))) return cell;
      }
      const Cell next = cell + step(static_cast<int>(random.below(2 * D)));
      if (inside_(next)) cell = next;
    }
  }

  std::function<bool(const Cell&)> inside_;
  std::vector<Cell> sites_;
  std::set<std::vector<int>> cluster_;
};

}  // namespace pneuma::testing
