#include "lobes/patch_surface.h"

#include <cmath>
#include <functional>
#include <numbers>

#include <gtest/gtest.h>

#include "core/domain.h"
#include "core/error.h"
#include "geometry/test_surfaces.h"
#include "lobes/point_coverage.h"
#include "lobes/sheet_rim.h"

namespace pneuma {
namespace {

/// A grid of 41 x 41 points bent by `place`, both from -1 to 1.
TriangleMesh sheet(const std::function<Vec3(double, double)>& place) {
  constexpr std::uint32_t N = 41;
  TriangleMesh mesh;
  for (std::uint32_t i = 0; i < N * N; ++i) {
    mesh.points.push_back(place((i % N) / 20.0 - 1.0, (i / N) / 20.0 - 1.0));
  }
  for (std::uint32_t row = 0; row + 1 < N; ++row) {
    for (std::uint32_t i = row * N; i + 1 < (row + 1) * N; ++i) {
      mesh.triangles.push_back({i, i + 1, i + N});
      mesh.triangles.push_back({i + 1, i + N + 1, i + N});
    }
  }
  return mesh;
}

Vec3 bentPatch(double a, double b) {
  return {60.0 * a, 80.0 * b, 10.0 + 20.0 * b + 8.0 * std::cos(2.0 * a) * std::sin(2.0 * b)};
}

std::string refusalOfPatch(const TriangleMesh& mesh) {
  try {
    fitPatch(mesh, "surface of a fissure");
  } catch (const InvalidInput& error) {
    return error.what();
  }
  return "";
}

/// A ball around the origin.
class Ball : public Domain {
 public:
  explicit Ball(double radius) : radius_(radius) {}

  bool contains(const Vec3& p) const override { return p.norm() < radius_; }

  double distanceToWall(const Vec3& p) const override { return std::abs(radius_ - p.norm()); }

  Box3 bounds() const override { return {Vec3::Constant(-radius_), Vec3::Constant(radius_)}; }

  double volumeMm3() const override { return 4.0 / 3.0 * std::numbers::pi * std::pow(radius_, 3); }

 private:
  double radius_;
};

TEST(PatchSurface, BecomesAHeightThatItsPointsLieUpon) {
  const TriangleMesh patch = sheet(bentPatch);
  const PatchFit fit = fitPatch(patch, "surface");
  EXPECT_LE(fit.largestMm, 0.2);
  EXPECT_LE(fit.meanMm, 0.05);
  EXPECT_LE(fit.knots, 800U);
  EXPECT_NEAR(fit.surface.distance(bentPatch(0.123, -0.456)), 0.0, 0.2);
  EXPECT_GT(fit.surface.normal().z(), 0.0);
  EXPECT_FALSE(fit.fold.has_value());
}

TEST(PatchSurface, TellsThatItFoldsAndIsRefusedWhereItIsNoSurface) {
  const auto rolled = [](double a, double b) {
    return Vec3(60.0 * std::sin(2.5 * a), 80.0 * b, 60.0 * std::cos(2.5 * a));
  };
  EXPECT_TRUE(fitPatch(sheet(rolled), "surface").fold.has_value());
  TriangleMesh strip;  // of few points, all of them knots
  for (std::uint32_t i = 0; i < 30; ++i) {
    strip.points.push_back(rolled(i / 15.0 - 1.0, -1.0));
    strip.points.push_back(rolled(i / 15.0 - 1.0, 1.0));
    if (i == 0) continue;
    strip.triangles.push_back({2 * i - 2, 2 * i - 1, 2 * i});
    strip.triangles.push_back({2 * i - 1, 2 * i + 1, 2 * i});
  }
  EXPECT_TRUE(fitPatch(strip, "surface").fold.has_value());
  const auto jagged = [](double a, double b) {
    const double up = std::lround(20.0 * a + 20.0 * b) % 2 == 0 ? 2.5 : -2.5;
    return Vec3(200.0 * a, 200.0 * b, up);
  };
  EXPECT_NE(refusalOfPatch(sheet(jagged)).find("too rough"), std::string::npos);
  EXPECT_NE(refusalOfPatch(testing::sphere(50.0)).find("is closed"), std::string::npos);
}

TEST(PatchSurface, TellsWhereItEndsInsideALung) {
  const TriangleMesh disk = sheet([](double a, double b) {
    // A disk of radius 50, its edge at a = 1 moved in by 12.
    const double r = std::max(std::abs(a), std::abs(b));
    const double angle = std::atan2(b, a);
    const double away = 50.0 - 12.0 * std::exp(-8.0 * angle * angle);
    return Vec3(r * away * std::cos(angle), r * away * std::sin(angle), 0.0);
  });
  const RimPlace place = deepestRim(disk, Ball(51.0));
  EXPECT_NEAR(place.depthMm, 13.0, 0.1);
  EXPECT_NEAR((place.place - Vec3(38.0, 0.0, 0.0)).norm(), 0.0, 2.0);
  EXPECT_EQ(deepestRim(disk, Ball(30.0)).depthMm, 0.0);
  HeightSurface floor;  // x = 36: 2 mm below the place
  floor.centre = {36.0, 0.0, 0.0};
  floor.axes = {Vec3::UnitY(), Vec3::UnitZ(), Vec3::UnitX()};
  EXPECT_NEAR(
      deepestRim(disk, Ball(51.0), [&](const Vec3& p) { return floor.distance(p); }).depthMm, 6.3,
      0.3);  // beside the place
}

TEST(PointCoverage, IsTheShareOfTheContactWithinThePointsHull) {
  const TriangleMesh flat = sheet([](double a, double b) { return Vec3(50.0 * a, 50.0 * b, 0.0); });
  const HeightSurface surface;
  const auto square = [](double side) {
    return std::vector<Vec3>{{-side, -side, 1.0}, {side, -side, 0.0}, {side, side, -1.0},
                             {-side, side, 0.0},  {0.0, 0.0, 3.0},    {side, 0.0, 0.0}};
  };
  EXPECT_NEAR(pointCoverage(square(60.0), surface, flat), 1.0, 1e-12);
  EXPECT_NEAR(pointCoverage(square(25.0), surface, flat), 0.25, 0.01);
  const std::vector<Vec3> corner = {{-50.0, -50.0, 0.0}, {50.0, -50.0, 0.0}, {-50.0, 50.0, 0.0}};
  EXPECT_NEAR(pointCoverage(corner, surface, flat), 0.5, 0.02);
  EXPECT_EQ(pointCoverage(std::vector<Vec3>(4, Vec3::Zero()), surface, flat), 0.0);
}

}  // namespace
}  // namespace pneuma
