#include "geometry/surface_domain.h"

#include <atomic>
#include <cmath>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/clearance_grid.h"
#include "core/error.h"
#include "core/parallel.h"
#include "core/random.h"
#include "geometry/test_surfaces.h"

namespace pneuma {
namespace {

using testing::cube;
using testing::dentedBall;
using testing::insideOut;
using testing::subdivided;
using testing::torus;

Vec3 randomPoint(Random& random, const Box3& box) {
  return {random.uniform(box.min().x(), box.max().x()),
          random.uniform(box.min().y(), box.max().y()),
          random.uniform(box.min().z(), box.max().z())};
}

std::string refusal(const TriangleMesh& mesh) {
  try {
    const SurfaceDomain domain(mesh);
  } catch (const InvalidInput& error) {
    return error.what();
  }
  return "";
}

TEST(SurfaceDomain, RefusesWhatEnclosesNothing) {
  TriangleMesh open = cube(50.0);
  open.triangles.pop_back();
  EXPECT_THAT(refusal(open), ::testing::HasSubstr("3 open edges"));
  TriangleMesh turned = cube(50.0);
  std::swap(turned.triangles[0][0], turned.triangles[0][1]);
  EXPECT_THAT(refusal(turned), ::testing::HasSubstr("orientation flips"));
  TriangleMesh flat = cube(50.0);
  for (Vec3& p : flat.points) p.z() = 0.0;
  EXPECT_THAT(refusal(flat), ::testing::HasSubstr("no volume"));
  EXPECT_THAT(refusal(TriangleMesh()), ::testing::HasSubstr("no triangles"));
}

TEST(SurfaceDomain, KnowsTheVolumeBoxAndWallOfACube) {
  for (const TriangleMesh& mesh : {cube(50.0), insideOut(cube(50.0))}) {
    const SurfaceDomain domain(mesh);
    EXPECT_DOUBLE_EQ(domain.volumeMm3(), 125000.0);
    EXPECT_TRUE(domain.bounds().isApprox(Box3(Vec3::Zero(), Vec3::Constant(50.0))));
    EXPECT_NEAR(domain.distanceToWall({20.0, 25.0, 44.0}), 6.0, 1e-12);
    EXPECT_NEAR(domain.distanceToWall({53.0, 54.0, 25.0}), 5.0, 1e-12);
  }
}

TEST(SurfaceDomain, DecidesPointsInLineWithCornersAndEdgesAndNextToTheWall) {
  // Every coordinate is that of a corner, an edge's middle, or a hair's breadth beside one.
  const SurfaceDomain domain(subdivided(cube(64.0)));
  const std::vector<double> levels = {-1e-9, 1e-9, 16.0,        32.0 - 1e-9,
                                      32.0,  48.0, 64.0 - 1e-9, 64.0 + 1e-9};
  const auto inside = [](double v) { return v > 0.0 && v < 64.0; };
  for (const double x : levels) {
    for (const double y : levels) {
      for (const double z : levels) {
        EXPECT_EQ(domain.contains({x, y, z}), inside(x) && inside(y) && inside(z))
            << x << " " << y << " " << z;
      }
    }
  }
}

TEST(SurfaceDomain, MakesADetourWhereTheWayToTheAnchorLeadsThroughACornerOfTheSurface) {
  const TriangleMesh mesh = torus(50.0, 20.0);
  const SurfaceDomain standard(mesh);
  constexpr double OneCellHoldsAll = 200.0;
  const SurfaceDomain domain(mesh, OneCellHoldsAll);
  const Vec3 anchor = ClearanceGrid(bounds(mesh), OneCellHoldsAll).cellCentre(1, 1, 1);
  int inside = 0;
  for (const Vec3& corner : mesh.points) {
    for (const double further : {1.05, 1.25, 1.5}) {
      const Vec3 p = anchor + further * (corner - anchor);
      EXPECT_EQ(domain.contains(p), standard.contains(p)) << p.transpose();
      inside += standard.contains(p) ? 1 : 0;
    }
  }
  EXPECT_GT(inside, 100);
}

TEST(SurfaceDomain, AnswersForPointsThatAreFarOffOrNoNumbers) {
  const SurfaceDomain domain(cube(50.0));
  EXPECT_FALSE(domain.contains(Vec3::Constant(1e300)));
  EXPECT_FALSE(domain.contains(Vec3::Constant(std::nan(""))));
  EXPECT_FALSE(domain.containsSegment(Vec3::Constant(25.0), Vec3::Constant(1e300)));
}

TEST(SurfaceDomain, AnswersAlikeForAnyCellsAndAnySubdivision) {
  const TriangleMesh mesh = dentedBall(60.0);
  const SurfaceDomain standard(mesh);
  const SurfaceDomain fine(mesh, 0.8);
  const SurfaceDomain coarse(mesh, 25.0);
  const SurfaceDomain subdividedTwice(subdivided(subdivided(mesh)));
  Random random(1);
  for (int i = 0; i < 20000; ++i) {
    const Vec3 p = randomPoint(random, standard.bounds());
    const bool inside = standard.contains(p);
    ASSERT_EQ(fine.contains(p), inside) << p.transpose();
    ASSERT_EQ(coarse.contains(p), inside) << p.transpose();
    ASSERT_EQ(subdividedTwice.contains(p), inside) << p.transpose();
  }
}

TEST(SurfaceDomain, ContainsASegmentIfItContainsAllItsPoints) {
  for (const auto& [name, mesh] : testing::manySurfaces()) {
    const SurfaceDomain domain(mesh);
    Random random(2);
    int inside = 0;
    int leaves = 0;
    for (int i = 0; i < 4000; ++i) {
      const Vec3 a = randomPoint(random, domain.bounds());
      if (!domain.contains(a)) continue;
      const double reach = random.uniform(1.0, 40.0);
      const Vec3 b = a + reach * randomPoint(random, Box3(-Vec3::Ones(), Vec3::Ones()));
      bool all = true;
      for (double t = 0.0; t <= 1.0 && all; t += 0.002) all = domain.contains(a + t * (b - a));
      if (domain.containsSegment(a, b)) {
        ASSERT_TRUE(all) << name << ": " << a.transpose() << " to " << b.transpose();
        ++inside;
      } else if (all) {
        ++leaves;  // through an edge, for less than the 0.08 mm between samples
      }
    }
    EXPECT_GT(inside, 200) << name;
    EXPECT_LE(leaves, inside / 100) << name;
  }
}

TEST(SurfaceDomain, NoticesASegmentThatLeavesThroughTheHoleOfATorus) {
  const SurfaceDomain domain(torus(50.0, 20.0));
  EXPECT_FALSE(domain.containsSegment({50.0, 0.0, 0.0}, {-50.0, 0.0, 0.0}));
  EXPECT_TRUE(domain.containsSegment({50.0, 0.0, 0.0}, {48.0, 15.0, 3.0}));
}

TEST(SurfaceDomain, AnswersSeveralThreadsAtOnce) {
  const SurfaceDomain domain(dentedBall(60.0));
  std::atomic<int> wrong = 0;
  parallelFor(64, [&](std::size_t i) {
    Random random(i);
    for (int n = 0; n < 100; ++n) {
      const Vec3 p = randomPoint(random, domain.bounds());
      const double distance = domain.distanceToWall(p);
      const Vec3 near = p + Vec3(0.99 * distance, 0.0, 0.0);
      if (domain.contains(p) != domain.contains(near)) ++wrong;
      if (domain.contains(p) && !domain.containsSegment(p, near)) ++wrong;
    }
  });
  EXPECT_EQ(wrong, 0);
}

}  // namespace
}  // namespace pneuma
