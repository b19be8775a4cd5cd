#include "core/clearance_grid.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

#include <gtest/gtest.h>

#include "core/error.h"
#include "core/random.h"

namespace pneuma {
namespace {

using Cell = ClearanceGrid::Cell;

Box3 cube(double side) { return {Vec3::Zero(), Vec3::Constant(side)}; }

TEST(ClearanceGrid, HoldsItsBoxWithAMargin) {
  const ClearanceGrid grid(cube(10.0), 1.0);
  EXPECT_EQ(grid.cellCount(), static_cast<std::size_t>(grid.size().prod()));
  for (const Vec3& corner : {Vec3(0, 0, 0), Vec3(10, 10, 10), Vec3(0, 10, 0)}) {
    const Eigen::Vector3i cell = grid.cellOf(corner);
    EXPECT_TRUE((cell.array() >= 1).all());
    EXPECT_TRUE((cell.array() < grid.size().array() - 1).all());
  }
}

TEST(ClearanceGrid, FindsTheCellOfItsCentre) {
  const ClearanceGrid grid(cube(7.0), 0.7);
  const Eigen::Vector3i cell(3, 5, 2);
  EXPECT_EQ(grid.cellOf(grid.cellCentre(3, 5, 2)), cell);
  EXPECT_TRUE(grid.onLattice(cell));
  EXPECT_FALSE(grid.onLattice({-1, 0, 0}));
  EXPECT_FALSE(grid.onLattice({0, 0, grid.size().z()}));
}

TEST(ClearanceGrid, IsOutsideUntilItIsTold) {
  const ClearanceGrid grid(cube(3.0), 1.0);
  EXPECT_EQ(grid.clearance(Vec3(1.5, 1.5, 1.5)), -1);
  EXPECT_EQ(grid.clearance(Vec3(-100, 0, 0)), -1);
  EXPECT_EQ(grid.clearance(Vec3::Constant(std::nan(""))), -1);
}

/// Kinds of a grid, chosen at random with some cells of every kind.
std::vector<Cell> randomKinds(const ClearanceGrid& grid, std::uint64_t seed) {
  Random random(seed);
  std::vector<Cell> kinds(grid.cellCount());
  for (Cell& kind : kinds) {
    const double u = random.uniform();
    kind = u < 0.9 ? Cell::Inside : u < 0.95 ? Cell::Wall : Cell::Outside;
  }
  return kinds;
}

/// Steps to the nearest cell of another kind, diagonal steps counting as one; by looking at all.
int clearanceByHand(const ClearanceGrid& grid, const std::vector<Cell>& kinds,
                    const Eigen::Vector3i& at) {
  const auto kindOf = [&](const Eigen::Vector3i& cell) {
    return grid.onLattice(cell) ? kinds[grid.index(cell.x(), cell.y(), cell.z())] : Cell::Outside;
  };
  const Cell here = kindOf(at);
  int nearest = std::numeric_limits<int>::max();
  for (int k = -1; k <= grid.size().z(); ++k)
    for (int j = -1; j <= grid.size().y(); ++j)
      for (int i = -1; i <= grid.size().x(); ++i) {
        const Eigen::Vector3i other(i, j, k);
        if (kindOf(other) != here) {
          nearest = std::min(nearest, (other - at).cwiseAbs().maxCoeff());
        }
      }
  return static_cast<int>(here) * nearest;
}

TEST(ClearanceGrid, ClearanceIsTheNumberOfStepsToAnotherKind) {
  ClearanceGrid grid(Box3(Vec3::Zero(), Vec3(9, 6, 12)), 1.0);
  const std::vector<Cell> kinds = randomKinds(grid, 3);
  grid.setCells(kinds);
  for (int k = 0; k < grid.size().z(); ++k)
    for (int j = 0; j < grid.size().y(); ++j)
      for (int i = 0; i < grid.size().x(); ++i) {
        EXPECT_EQ(grid.clearance(grid.cellCentre(i, j, k)), clearanceByHand(grid, kinds, {i, j, k}))
            << i << " " << j << " " << k;
      }
}

TEST(ClearanceGrid, ClearanceInMmNeverReachesAnotherKind) {
  ClearanceGrid grid(cube(12.0), 1.5);
  std::vector<Cell> kinds(grid.cellCount(), Cell::Inside);
  kinds[grid.index(1, 2, 3)] = Cell::Wall;
  grid.setCells(kinds);
  Random random(5);
  const Vec3 extent = grid.size().cast<double>() * grid.cellMm();
  for (int i = 0; i < 2000; ++i) {
    const double x = random.uniform() * extent.x();
    const double y = random.uniform() * extent.y();
    const Vec3 p = grid.origin() + Vec3(x, y, random.uniform() * extent.z());
    const double clearance = grid.clearanceMm(p);
    EXPECT_GE(clearance, 0.0);
    // Along the axes and diagonals, everything closer is of the same kind.
    for (const Vec3& way : {Vec3(1, 0, 0), Vec3(0, -1, 0), Vec3(-1, -1, -1), Vec3(1, 1, -1)}) {
      const Vec3 q = p + 0.999 * clearance * way.normalized();
      EXPECT_EQ(grid.clearance(q) > 0, grid.clearance(p) > 0);
    }
  }
}

TEST(ClearanceGrid, KnowsNoClearanceAtTheWallAndOffTheLattice) {
  ClearanceGrid grid(cube(4.0), 1.0);
  grid.setCells(std::vector<Cell>(grid.cellCount(), Cell::Wall));
  EXPECT_EQ(grid.clearance(Vec3(2, 2, 2)), 0);
  EXPECT_EQ(grid.clearanceMm(Vec3(2, 2, 2)), 0.0);
  EXPECT_EQ(grid.clearanceMm(Vec3(200, 2, 2)), 0.0);
}

TEST(ClearanceGrid, RefusesMoreCellsThanItCanNumber) {
  try {
    const ClearanceGrid grid(cube(1e6), 1.0);
    FAIL();
  } catch (const InvalidInput& error) {
    EXPECT_NE(std::string(error.what()).find("units"), std::string::npos);
  }
}

}  // namespace
}  // namespace pneuma
