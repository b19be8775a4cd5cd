#include "growth/row_kernels.h"

#include <memory>

#include <gtest/gtest.h>

#include "core/random.h"
#include "growth/cell_grid.h"
#include "support/simple_domains.h"

namespace pneuma {
namespace {

using testing::ball;
using testing::box;

std::vector<InstructionSet> sets() {
  std::vector<InstructionSet> all;
  for (const auto set : {InstructionSet::Portable, InstructionSet::Avx2, InstructionSet::Avx512}) {
    if (available(set)) all.push_back(set);
  }
  return all;
}

Vec3 anyDirection(Random& random) {
  return Vec3(random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-1, 1)).normalized();
}

Vec3 anyPoint(Random& random) {
  return {random.uniform(-40, 40), random.uniform(-40, 40), random.uniform(-40, 40)};
}

Region anyRegion(const Domain& organ, Random& random) {
  Region region;
  region.organ = &organ;
  region.box = organ.bounds();
  for (int i = 0; i < 3; ++i) {
    const auto kind = static_cast<WedgeKind>(random.below(3));
    region.walls.push_back(
        {kind, 0.5 * anyPoint(random), anyDirection(random), anyDirection(random)});
  }
  region.cuts = region.walls;
  for (int i = 0; i < 4; ++i) {
    region.ancestors.push_back({anyPoint(random), anyPoint(random), random.uniform(1, 6)});
  }
  return region;
}

bool inCapsule(const Capsule& capsule, const Vec3& p) {
  const Vec3 way = capsule.end - capsule.start;
  const double t = std::clamp((p - capsule.start).dot(way) / way.squaredNorm(), 0.0, 1.0);
  return (p - capsule.start - t * way).norm() < capsule.radiusMm;
}

/// The cells of a region, one by one in double precision.
int countPlainly(const Region& region, int cells) {
  const Vec3 step = region.box.sizes() / cells;
  int count = 0;
  for (int k = 0; k < cells; ++k)
    for (int j = 0; j < cells; ++j)
      for (int i = 0; i < cells; ++i) {
        const Vec3 p = region.box.min() + step.cwiseProduct(Vec3(i + 0.5, j + 0.5, k + 0.5));
        const auto holds = [&](const Capsule& capsule) { return inCapsule(capsule, p); };
        count += region.contains(p) && std::ranges::none_of(region.ancestors, holds) ? 1 : 0;
      }
  return count;
}

TEST(CellGrid, CountsTheCellsThatAPlainLoopCounts) {
  const auto organ = ball(40.0);
  Random random(3);
  for (int trial = 0; trial < 60; ++trial) {
    Region region = anyRegion(*organ, random);
    const int plain = countPlainly(region, 20);
    CellGrid grid(20);
    // Cells within rounding of a wall may differ.
    EXPECT_NEAR(grid.lay(region), plain, 2.0) << trial;
  }
}

TEST(CellGrid, CountsTheSameWithEveryInstructionSet) {
  const auto organ = ball(40.0);
  for (const int cells : {5, 20, 30}) {
    Random random(11);
    for (int trial = 0; trial < 20; ++trial) {
      const Region region = anyRegion(*organ, random);
      const Wedge wedge{WedgeKind::Both, 0.2 * anyPoint(random), anyDirection(random),
                        anyDirection(random)};
      std::vector<std::array<double, 6>> seen;
      for (const InstructionSet set : sets()) {
        const RowKernelChoice choice(set);
        const auto grid = std::make_unique<CellGrid>(cells);
        Region own = region;
        const double count = grid->lay(own);
        RowMasks part;
        const double inWedge = grid->select(wedge, grid->cells(), part);
        const Vec3 middle = inWedge > 0 ? grid->centroidOf(part) : Vec3(Vec3::Zero());
        seen.push_back({count, inWedge, static_cast<double>(grid->countIn(wedge)), middle.x(),
                        middle.y(), middle.z()});
      }
      for (const auto& figures : seen) EXPECT_EQ(figures, seen.front()) << cells << ' ' << trial;
    }
  }
}

TEST(CellGrid, HalvesABoxAtItsMiddle) {
  const auto organ = box({-10, -10, -10}, {10, 10, 10});
  Region region;
  region.organ = organ.get();
  region.box = organ->bounds();
  CellGrid grid(20);
  EXPECT_EQ(grid.lay(region), 8000);
  for (int axis = 0; axis < 3; ++axis) {
    EXPECT_EQ(grid.countIn({WedgeKind::Plane, Vec3::Zero(), Vec3::Unit(axis), Vec3::Zero()}), 4000);
    EXPECT_EQ(grid.countIn({WedgeKind::Plane, Vec3::Zero(), -Vec3::Unit(axis), Vec3::Zero()}),
              4000);
  }
}

TEST(CellGrid, KnowsBoxCentroidAndFarthestCell) {
  const auto organ = box({0, 0, 0}, {20, 20, 20});
  Region region;
  region.organ = organ.get();
  region.box = organ->bounds();
  CellGrid grid(20);
  grid.lay(region);
  RowMasks corner;
  EXPECT_EQ(grid.select({WedgeKind::Both, {4, 6, 0}, -Vec3::UnitX(), -Vec3::UnitY()}, grid.cells(),
                        corner),
            4 * 6 * 20);
  EXPECT_TRUE(grid.centroidOf(corner).isApprox(Vec3(2, 3, 10), 1e-9));
  const Box3 extent = grid.boxOf(corner);  // one cell wider, within the grid
  EXPECT_TRUE(extent.min().isApprox(Vec3(0, 0, 0)));
  EXPECT_TRUE(extent.max().isApprox(Vec3(5, 7, 20)));
  EXPECT_TRUE(grid.farthestCentre(corner, {0, 0, 0}).isApprox(Vec3(3.5, 5.5, 19.5)));
}

TEST(CellGrid, ForgetsWhatHasNothingToDoWithItsBox) {
  const auto organ = ball(100.0);
  Region region;
  region.organ = organ.get();
  region.box = Box3(Vec3(-5, -5, -5), Vec3(5, 5, 5));
  const Wedge far{WedgeKind::Plane, {-50, 0, 0}, Vec3::UnitX(), Vec3::Zero()};
  const Wedge near{WedgeKind::Plane, {1, 0, 0}, Vec3::UnitX(), Vec3::Zero()};
  region.walls = {far, near};
  region.cuts = region.walls;
  region.ancestors = {{{50, 0, 0}, {60, 0, 0}, 2.0}, {{0, 0, -9}, {0, 0, 9}, 1.0}};
  CellGrid(20).lay(region);
  EXPECT_EQ(region.cuts.size(), 1U);
  EXPECT_EQ(region.ancestors.size(), 1U);
  EXPECT_FALSE(region.organCuts);
  EXPECT_EQ(region.walls.size(), 2U);  // tips are still asked of all of them
}

}  // namespace
}  // namespace pneuma
