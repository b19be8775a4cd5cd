#include "growth/aggregation_lattice.h"

#include <bit>
#include <deque>

namespace pneuma {
namespace {

constexpr std::uint64_t FirstColumn = 0x0101010101010101U;
constexpr std::uint64_t LastColumn = FirstColumn << 7;

}  // namespace

/// Calls `f(brick, index)` in the order of their indices.
template <int D>
template <class F>
void AggregationLattice<D>::forEachBrick(F&& f) const {
  Cell brick = Cell::Zero();
  for (std::size_t i = 0; i < bricks_.size(); ++i) {
    f(brick, i);
    for (int axis = 0; axis < D; ++axis) {
      if (++brick[axis] < bricksAlong_[axis]) break;
      brick[axis] = 0;
    }
  }
}

/// For the cells of one word, the bits of their neighbours one step along an axis.
/// @param way +1 or -1
/// @param wordAt `wordAt(brickIndex, word)`: the bits that are asked for
template <int D>
template <class WordAt>
std::uint64_t AggregationLattice<D>::neighbours(const Cell& brick, int word, int axis, int way,
                                                WordAt&& wordAt) const {
  const std::size_t here = cluster_.index(brick);
  const auto beside = [&](int otherWord) -> std::uint64_t {
    Cell other = brick;
    other[axis] += way;
    if (other[axis] < 0 || other[axis] >= bricksAlong_[axis]) return 0;
    return wordAt(cluster_.index(other), otherWord);
  };
  if constexpr (D == 3) {
    if (axis == 2) {
      const int next = word + way;
      return next >= 0 && next < Words ? wordAt(here, next) : beside(way > 0 ? 0 : Words - 1);
    }
  }
  const std::uint64_t own = wordAt(here, word);
  if (axis == 1) return way > 0 ? own >> 8 | beside(word) << 56 : own << 8 | beside(word) >> 56;
  return way > 0 ? (own & ~FirstColumn) >> 1 | (beside(word) & FirstColumn) << 7
                 : (own & ~LastColumn) << 1 | (beside(word) & LastColumn) >> 7;
}

template <int D>
std::size_t AggregationLattice<D>::openCells() const {
  std::size_t count = 0;
  for (const Brick& brick : bricks_) {
    for (const std::uint64_t word : brick.open) {
      count += static_cast<std::size_t>(std::popcount(word));
    }
  }
  return count;
}

template <int D>
std::size_t AggregationLattice<D>::keepReachable() {
  std::vector<BrickWords> reached(bricks_.size(), BrickWords{});
  std::deque<Cell> waiting;
  const auto reachedAt = [&](std::size_t brick, int word) {
    return reached[brick][static_cast<std::size_t>(word)] |
           bricks_[brick].cluster[static_cast<std::size_t>(word)];
  };
  /// Floods a brick from what its neighbours and itself have reached; true if anything is new.
  const auto flood = [&](const Cell& brick, std::size_t index) {
    bool any = false;
    for (bool changed = true; changed;) {
      changed = false;
      for (int word = 0; word < Words; ++word) {
        const auto w = static_cast<std::size_t>(word);
        const std::uint64_t open = bricks_[index].open[w];
        std::uint64_t& known = reached[index][w];
        if (known == open) continue;
        std::uint64_t next = known;
        for (int axis = 0; axis < D; ++axis) {
          next |= neighbours(brick, word, axis, 1, reachedAt) |
                  neighbours(brick, word, axis, -1, reachedAt);
        }
        next &= open;
        changed = changed || next != known;
        known = next;
      }
      any = any || changed;
    }
    return any;
  };
  const auto addAround = [&](const Cell& brick) {
    for (int axis = 0; axis < D; ++axis)
      for (const int way : {-1, 1}) {
        Cell other = brick;
        other[axis] += way;
        if (other[axis] >= 0 && other[axis] < bricksAlong_[axis]) waiting.push_back(other);
      }
  };
  forEachBrick([&](const Cell& brick, std::size_t index) {
    bool any = false;
    for (const std::uint64_t word : bricks_[index].cluster) any = any || word != 0;
    if (!any) return;
    waiting.push_back(brick);
    addAround(brick);
  });
  while (!waiting.empty()) {
    const Cell brick = waiting.front();
    waiting.pop_front();
    if (flood(brick, cluster_.index(brick))) addAround(brick);
  }
  std::size_t closed = 0;
  for (std::size_t i = 0; i < bricks_.size(); ++i) {
    for (std::size_t word = 0; word < reached[i].size(); ++word) {
      closed += static_cast<std::size_t>(std::popcount(bricks_[i].open[word] & ~reached[i][word]));
      bricks_[i].open[word] &= reached[i][word];
    }
  }
  return closed;
}

template <int D>
std::vector<LatticeCell<D>> AggregationLattice<D>::wallCells() const {
  std::vector<Cell> cells;
  const auto walkable = [&](std::size_t brick, int word) {
    const auto w = static_cast<std::size_t>(word);
    return bricks_[brick].open[w] | bricks_[brick].cluster[w];
  };
  forEachBrick([&](const Cell& brick, std::size_t index) {
    for (int word = 0; word < Words; ++word) {
      const std::uint64_t open = bricks_[index].open[static_cast<std::size_t>(word)];
      if (open == 0) continue;
      std::uint64_t inner = open;
      for (int axis = 0; axis < D; ++axis) {
        inner &= neighbours(brick, word, axis, 1, walkable) &
                 neighbours(brick, word, axis, -1, walkable);
      }
      for (std::uint64_t wall = open & ~inner; wall != 0; wall &= wall - 1) {
        const int bit = std::countr_zero(wall);
        Cell cell = brick * BrickSide;
        cell[0] += bit & 7;
        cell[1] += bit >> 3;
        if constexpr (D == 3) cell[2] += word;
        cells.push_back(cell);
      }
    }
  });
  return cells;
}

template <int D>
void AggregationLattice<D>::findWalls() {
  std::vector<char> wall(bricks_.size(), 0);
  for (std::size_t i = 0; i < bricks_.size(); ++i) {
    for (std::size_t word = 0; word < Words; ++word) {
      if (~(bricks_[i].open[word] | bricks_[i].cluster[word]) != 0) wall[i] = 1;
    }
  }
  walls_.set(wall);
}

template <int D>
void AggregationLattice<D>::keepOffWalls() {
  for (const Cell& cell : wallCells()) {
    for (int axis = 0; axis < D; ++axis)
      for (const int way : {-1, 1}) {
        Cell wall = cell;
        wall[axis] += way;
        if (holds(wall) && !open(wall) && !inCluster(wall)) occupy(wall);
      }
  }
}

template <int D>
void AggregationLattice<D>::occupy(const Cell& cell) {
  Occupied& occupied = occupied_[brickOf(cell)];
  const std::uint64_t bit2 = std::uint64_t{1} << within(cell, 1);
  if ((occupied.cells2 & bit2) != 0) return;
  occupied.cells2 |= bit2;
  markAround(cell, 1);
  const auto bit4 = static_cast<std::uint8_t>(1U << within(cell, 2));
  if ((occupied.cells4 & bit4) != 0) return;
  const bool first = occupied.cells4 == 0;
  occupied.cells4 |= bit4;
  markAround(cell, 2);
  if (first) cluster_.occupy(cell / BrickSide);
}

/// Marks the cells of 2^level (2 or 4 cells wide) in and around which something is now.
template <int D>
void AggregationLattice<D>::markAround(const Cell& cell, int level) {
  const int side = 1 << level;
  const Cell last = size_.array() - 1;
  Cell at;
  for (int k = 0; k < (D == 2 ? 9 : 27); ++k) {
    int digits = k;
    bool inside = true;
    for (int axis = 0; axis < D; ++axis, digits /= 3) {
      at[axis] = cell[axis] + side * (digits % 3 - 1);
      inside = inside && at[axis] >= 0 && at[axis] <= last[axis];
    }
    if (!inside) continue;
    const std::size_t brick = brickOf(at);
    if (level == 1) {
      near2_[brick] |= std::uint64_t{1} << within(at, 1);
    } else {
      near4_[brick] |= static_cast<std::uint8_t>(1U << within(at, 2));
    }
  }
}

template class AggregationLattice<2>;
template class AggregationLattice<3>;

}  // namespace pneuma
