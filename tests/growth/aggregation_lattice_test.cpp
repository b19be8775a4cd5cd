#include "growth/aggregation_lattice.h"

#include <algorithm>
#include <cstdlib>

#include <gtest/gtest.h>

#include "core/random.h"

namespace pneuma {
namespace {

template <int D>
LatticeCell<D> randomCell(const LatticeCell<D>& size, Random& random) {
  LatticeCell<D> cell;
  for (int axis = 0; axis < D; ++axis) {
    cell[axis] = static_cast<int>(random.below(static_cast<std::uint64_t>(size[axis])));
  }
  return cell;
}

template <int D, class F>
void forEachCell(const LatticeCell<D>& size, F&& f) {
  for (int i = 0; i < size.prod(); ++i) {
    LatticeCell<D> cell;
    int left = i;
    for (int axis = 0; axis < D; ++axis) {
      cell[axis] = left % size[axis];
      left /= size[axis];
    }
    f(cell);
  }
}

template <int D>
AggregationLattice<D> openLattice(const LatticeCell<D>& size) {
  AggregationLattice<D> lattice(size);
  forEachCell<D>(size, [&](const LatticeCell<D>& cell) { lattice.setOpen(cell); });
  return lattice;
}

/// Nobody who walks fewer than look().free steps along every axis touches what is there, and the
/// room that is told is worth having.
template <int D>
void expectRoomIsFree(const LatticeCell<D>& size, int particles) {
  AggregationLattice<D> lattice = openLattice<D>(size);
  lattice.findWalls();
  Random random(7);
  std::vector<LatticeCell<D>> cluster;
  double told = 0.0;
  double there = 0.0;
  for (int i = 0; i < particles; ++i) {
    cluster.push_back(randomCell<D>(size, random));
    lattice.addToCluster(cluster.back());
    for (int k = 0; k < 50; ++k) {
      const LatticeCell<D> cell = randomCell<D>(size, random);
      int nearest = 1 << 20;
      for (const LatticeCell<D>& particle : cluster) {
        nearest = std::min(nearest, (particle - cell).cwiseAbs().maxCoeff());
      }
      const int free = lattice.look(cell).free;
      if (nearest == 0) {
        ASSERT_EQ(free, 0);
        continue;
      }
      ASSERT_GE(free, 1);
      ASSERT_TRUE(free == 1 || free < nearest) << "free " << free << ", nearest " << nearest;
      told += std::min(free, 300);
      there += std::min(nearest, 300);
    }
  }
  EXPECT_GT(told, 0.5 * there);
}

TEST(AggregationLattice, TellsHowFarTheClusterIsInThePlane) { expectRoomIsFree<2>({203, 150}, 60); }

TEST(AggregationLattice, TellsHowFarTheClusterIsInSpace) { expectRoomIsFree<3>({61, 40, 83}, 60); }

TEST(AggregationLattice, NumbersCellsBackAndForth) {
  const AggregationLattice<3> lattice({20, 9, 33});
  Random random(3);
  for (int i = 0; i < 1000; ++i) {
    const LatticeCell<3> cell = randomCell<3>(lattice.size(), random);
    ASSERT_EQ(lattice.cellOf(lattice.number(cell)), cell);
  }
}

TEST(AggregationLattice, IsClosedOutside) {
  const AggregationLattice<2> lattice = openLattice<2>({16, 16});
  EXPECT_TRUE(lattice.open({0, 0}));
  EXPECT_FALSE(lattice.open({-1, 0}));
  EXPECT_FALSE(lattice.open({0, 16}));
  EXPECT_EQ(lattice.look({16, 3}).free, 0);
}

TEST(AggregationLattice, FindsTheCellsAtTheWall) {
  const LatticeCell<3> size(24, 16, 40);
  AggregationLattice<3> lattice(size);
  forEachCell<3>(size, [&](const LatticeCell<3>& cell) {
    if ((cell.array() >= 3).all() && (cell.array() < size.array() - 2).all()) lattice.setOpen(cell);
  });
  std::vector<LatticeCell<3>> expected;
  forEachCell<3>(size, [&](const LatticeCell<3>& cell) {
    if (!lattice.open(cell)) return;
    const bool inner = (cell.array() > 3).all() && (cell.array() < size.array() - 3).all();
    if (!inner) expected.push_back(cell);
  });
  std::vector<LatticeCell<3>> found = lattice.wallCells();
  const auto less = [](const LatticeCell<3>& a, const LatticeCell<3>& b) {
    return std::lexicographical_compare(a.data(), a.data() + 3, b.data(), b.data() + 3);
  };
  std::ranges::sort(found, less);
  std::ranges::sort(expected, less);
  EXPECT_EQ(found, expected);
}

TEST(AggregationLattice, ClosesWhatCannotBeReached) {
  // Two rooms with a wall between them, and a winding corridor from the first.
  const LatticeCell<2> size(64, 40);
  AggregationLattice<2> lattice(size);
  std::size_t reachable = 0;
  std::size_t other = 0;
  forEachCell<2>(size, [&](const LatticeCell<2>& cell) {
    const bool first = cell[0] < 20 && cell[1] < 20;
    const bool corridor = cell[1] == 30 || (cell[0] == 5 && cell[1] >= 20 && cell[1] < 30);
    const bool second = cell[0] > 40 && cell[1] < 20;
    if (!first && !corridor && !second) return;
    lattice.setOpen(cell);
    ++(second ? other : reachable);
  });
  lattice.addToCluster({3, 3});
  EXPECT_EQ(lattice.keepReachable(), other);
  EXPECT_EQ(lattice.openCells(), reachable - 1);
  EXPECT_FALSE(lattice.open({50, 10}));
  EXPECT_TRUE(lattice.open({63, 30}));
}

TEST(AggregationLattice, TellsHowFarTheWallIs) {
  const LatticeCell<3> size(96, 96, 96);
  AggregationLattice<3> lattice(size);
  const auto inside = [](const LatticeCell<3>& cell) {
    return (cell - LatticeCell<3>(48, 48, 48)).squaredNorm() <= 44 * 44;
  };
  forEachCell<3>(size, [&](const LatticeCell<3>& cell) {
    if (inside(cell)) lattice.setOpen(cell);
  });
  lattice.findWalls();
  Random random(5);
  int largest = 0;
  for (int i = 0; i < 500; ++i) {
    const LatticeCell<3> cell = randomCell<3>(size, random);
    if (!inside(cell)) continue;
    const int room = lattice.look(cell).wall;
    largest = std::max(largest, room);
    for (int k = 0; k < 200 && room > 0; ++k) {
      LatticeCell<3> way;
      for (int axis = 0; axis < 3; ++axis) {
        way[axis] =
            static_cast<int>(random.below(static_cast<std::uint64_t>(2 * room - 1))) - room + 1;
      }
      ASSERT_TRUE(inside(cell + way)) << "room " << room;
    }
  }
  EXPECT_GT(largest, 10);
}

TEST(AggregationLattice, KeepsOffWallsLikeOffTheClusterIfAsked) {
  AggregationLattice<2> lattice(LatticeCell<2>(64, 64));
  forEachCell<2>({64, 64}, [&](const LatticeCell<2>& cell) {
    if (cell[0] >= 10 && cell[0] < 50 && cell[1] >= 10 && cell[1] < 50) lattice.setOpen(cell);
  });
  lattice.findWalls();
  EXPECT_GT(lattice.look({11, 30}).free, 1);
  lattice.keepOffWalls();
  EXPECT_EQ(lattice.look({10, 30}).free, 1);
  for (int x = 10; x < 50; ++x) {
    const int free = lattice.look({x, 30}).free;
    EXPECT_TRUE(free == 1 || free < std::min(x - 9, 50 - x)) << x;
  }
  EXPECT_GT(lattice.look({30, 30}).free, 8);
}

}  // namespace
}  // namespace pneuma
