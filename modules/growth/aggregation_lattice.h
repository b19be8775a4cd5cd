#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "growth/brick_distances.h"
#include "growth/cube_walk.h"

namespace pneuma {

/// The lattice in which particles walk and stick: which cells are open to walkers, which belong to
/// the cluster, and how far a walker may jump without meeting it.
///
/// Cells are kept in bricks of 8 along each axis, one bit for each property, so that a walker near
/// the cluster stays within a few cache lines. How far the cluster is, is kept for every brick, and
/// for cells of 2 and of 4 of those near it. Less than a third of a byte per cell of the box.
template <int D>
class AggregationLattice {
 public:
  using Cell = LatticeCell<D>;
  static constexpr int BrickSide = 8;
  static constexpr int Words = D == 2 ? 1 : 8;  ///< of 8 x 8 cells, one for every z
  using BrickWords = std::array<std::uint64_t, Words>;

  /// @param cells along each axis; rounded up to whole bricks
  explicit AggregationLattice(const Cell& cells)
      : bricksAlong_((cells.array() + BrickSide - 1) / BrickSide),
        size_(bricksAlong_ * BrickSide),
        bricks_(static_cast<std::size_t>(bricksAlong_.prod())),
        occupied_(bricks_.size()),
        near4_(bricks_.size(), 0),
        near2_(bricks_.size(), 0),
        cluster_(bricksAlong_),
        walls_(bricksAlong_) {}

  /// Memory that a lattice of this size takes, bytes.
  static double bytesFor(const Eigen::Matrix<double, D, 1>& cells) {
    return cells.prod() / (D == 2 ? 64.0 : 512.0) * (sizeof(Brick) + sizeof(Occupied) + 11.0);
  }

  const Cell& size() const { return size_; }

  const Cell& bricksAlong() const { return bricksAlong_; }

  bool holds(const Cell& cell) const {
    for (int axis = 0; axis < D; ++axis) {
      if (static_cast<unsigned>(cell[axis]) >= static_cast<unsigned>(size_[axis])) return false;
    }
    return true;
  }

  /// May a walker be here? False off the lattice.
  bool open(const Cell& cell) const {
    return holds(cell) && isSet(bricks_[brickOf(cell)].open, cell);
  }

  bool inCluster(const Cell& cell) const {
    return holds(cell) && isSet(bricks_[brickOf(cell)].cluster, cell);
  }

  /// A cell's number, and back.
  std::uint32_t number(const Cell& cell) const {
    std::uint32_t number = 0;
    for (int axis = D - 1; axis >= 0; --axis) {
      number =
          number * static_cast<std::uint32_t>(size_[axis]) + static_cast<std::uint32_t>(cell[axis]);
    }
    return number;
  }

  Cell cellOf(std::uint32_t number) const {
    Cell cell;
    for (int axis = 0; axis < D; ++axis) {
      cell[axis] = static_cast<int>(number % static_cast<std::uint32_t>(size_[axis]));
      number /= static_cast<std::uint32_t>(size_[axis]);
    }
    return cell;
  }

  /// Opens cells of a brick to walkers.
  void setOpen(const Cell& brick, const BrickWords& words) {
    bricks_[cluster_.index(brick)].open = words;
  }

  void setOpen(const Cell& cell) { bricks_[brickOf(cell)].open[wordOf(cell)] |= bitOf(cell); }

  std::size_t openCells() const;

  /// Closes what no walker can reach from the cluster by steps to neighbours; how many cells.
  std::size_t keepReachable();

  /// The open cells with a face on a cell that is neither open nor cluster, in a fixed order.
  std::vector<Cell> wallCells() const;

  /// Finds out how far the walls are, for look(). Before that they count as near.
  void findWalls();

  /// Lets look() keep off the walls as it keeps off the cluster.
  void keepOffWalls();

  /// A cell of the lattice joins the cluster; walkers cannot be there any more.
  void addToCluster(const Cell& cell) {
    Brick& brick = bricks_[brickOf(cell)];
    brick.open[wordOf(cell)] &= ~bitOf(cell);
    brick.cluster[wordOf(cell)] |= bitOf(cell);
    occupy(cell);
  }

  /// What a walker sees from a cell.
  struct View {
    /// It touches nothing of the cluster before it is this far along some axis, if it touches it
    /// then; 1 where the cluster may be next to it, 0 where it may not be at all.
    int free = 0;
    int wall = 0;  ///< it meets no wall before it is this far; 0 near one
  };

  View look(const Cell& cell) const {
    if (!holds(cell)) return {};
    const std::size_t brick = brickOf(cell);
    const int toWall = walls_.at(brick);
    if (toWall == 0 && !isSet(bricks_[brick].open, cell)) return {};
    const int edge = toEdge(cell, BrickSide);
    const int wall = toWall > 1 ? BrickSide * (toWall - 1) + edge : 0;
    const int toCluster = cluster_.at(brick);
    if (toCluster > 1) return {BrickSide * (toCluster - 1) + edge, wall};
    if ((near4_[brick] >> within(cell, 2) & 1U) == 0) return {4 + toEdge(cell, 4), wall};
    if ((near2_[brick] >> within(cell, 1) & 1U) == 0) return {2, wall};
    if (toWall > 0 && !isSet(bricks_[brick].open, cell)) return {};
    return {1, wall};
  }

 private:
  struct Brick {
    BrickWords open{};
    BrickWords cluster{};
  };

  /// Cells of 2 and of 4 with something in them.
  struct Occupied {
    std::uint64_t cells2 = 0;
    std::uint8_t cells4 = 0;
  };

  std::size_t brickOf(const Cell& cell) const {
    std::size_t brick = 0;
    for (int axis = D - 1; axis >= 0; --axis) {
      brick = brick * static_cast<std::size_t>(bricksAlong_[axis]) +
              static_cast<std::size_t>(cell[axis] >> 3);
    }
    return brick;
  }

  static std::size_t wordOf(const Cell& cell) {
    return D == 2 ? 0 : static_cast<std::size_t>(cell[D - 1] & 7);
  }

  static std::uint64_t bitOf(const Cell& cell) {
    return std::uint64_t{1} << ((cell[0] & 7) | (cell[1] & 7) << 3);
  }

  static bool isSet(const BrickWords& words, const Cell& cell) {
    return (words[wordOf(cell)] & bitOf(cell)) != 0;
  }

  /// Which of the cells of 2^level in its brick holds this cell.
  static int within(const Cell& cell, int level) {
    const int bits = 3 - level;  // for a place along one axis
    int index = 0;
    for (int axis = D - 1; axis >= 0; --axis) {
      index = index << bits | ((cell[axis] & 7) >> level);
    }
    return index;
  }

  /// Cells between a cell and the nearest edge of the cell of `side` that holds it.
  static int toEdge(const Cell& cell, int side) {
    int least = side;
    for (int axis = 0; axis < D; ++axis) {
      const int offset = cell[axis] & (side - 1);
      least = std::min(least, std::min(offset, side - 1 - offset));
    }
    return least;
  }

  void occupy(const Cell& cell);
  void markAround(const Cell& cell, int level);

  template <class WordAt>
  std::uint64_t neighbours(const Cell& brick, int word, int axis, int way, WordAt&& wordAt) const;
  template <class F>
  void forEachBrick(F&& f) const;

  Cell bricksAlong_;
  Cell size_;
  std::vector<Brick> bricks_;
  std::vector<Occupied> occupied_;
  std::vector<std::uint8_t> near4_;   ///< cells of 4 with something in them or around them
  std::vector<std::uint64_t> near2_;  ///< the same for cells of 2
  BrickDistances<D> cluster_;
  BrickDistances<D> walls_;
};

extern template class AggregationLattice<2>;
extern template class AggregationLattice<3>;

}  // namespace pneuma
