#include "lobes/contact_sampling.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include "core/error.h"
#include "geometry/test_surfaces.h"
#include "lobes/region_splitting.h"

namespace pneuma {
namespace {

constexpr RegionId Below = 1;
constexpr RegionId Above = 2;

/// A ball of 50 mm cut at z = 10.
RegionComplex cutBall() {
  RegionComplex complex = complexOf(testing::sphere(50.0, Vec3::Zero(), 5), 1);
  HeightSurface flat;
  flat.centre = {0.0, 0.0, 10.0};
  splitRegion(complex, flat, {.region = 1, .below = Below, .above = Above}, "fissure");
  return complex;
}

TriangleMesh shifted(TriangleMesh mesh, const Vec3& by) {
  for (Vec3& p : mesh.points) p += by;
  return mesh;
}

double leastApart(const std::vector<Vec3>& points) {
  double least = 1e300;
  for (std::size_t i = 0; i < points.size(); ++i) {
    for (std::size_t k = 0; k < i; ++k) least = std::min(least, (points[i] - points[k]).norm());
  }
  return least;
}

TEST(ContactSampling, FindsTheTrianglesThatLobesShare) {
  const RegionComplex complex = cutBall();
  const FissureContact contact =
      contactBetween(surfaceOf(complex, Below).mesh, surfaceOf(complex, Above).mesh);
  EXPECT_TRUE(contact.shared);
  EXPECT_NEAR(contact.areaMm2, areaMm2(contactOf(complex, Below, Above)), 1e-6);
  EXPECT_EQ(contact.points.size(), contactOf(complex, Below, Above).triangles.size());
  EXPECT_EQ(contact.gapLargestMm, 0.0);
  // At the rim the cut runs through points of the ball.
  for (const Vec3& p : contact.points) EXPECT_NEAR(p.z(), 10.0, 0.3);
}

TEST(ContactSampling, TakesTheMiddleOfAGapWhereNothingIsShared) {
  const RegionComplex complex = cutBall();
  const TriangleMesh below = surfaceOf(complex, Below).mesh;
  const TriangleMesh above = surfaceOf(complex, Above).mesh;
  const double exact = areaMm2(contactOf(complex, Below, Above));
  for (const double gap : {2.0, -2.0}) {  // apart, and one in the other
    const FissureContact contact = contactBetween(below, shifted(above, {0.0, 0.0, gap}));
    EXPECT_FALSE(contact.shared);
    EXPECT_LT(contact.areaMm2, 1.02 * exact);
    EXPECT_GT(contact.areaMm2, 0.85 * exact);  // a rim is nearest to the ball's outside
    EXPECT_NEAR(contact.gapMeanMm, 2.0, 0.05);
    const auto flat = std::ranges::count_if(
        contact.points, [&](const Vec3& p) { return std::abs(p.z() - 10.0 - gap / 2.0) < 1e-6; });
    EXPECT_GT(static_cast<double>(flat), 0.9 * static_cast<double>(contact.points.size()));
  }
  EXPECT_TRUE(contactBetween(below, shifted(above, {0.0, 0.0, 8.0})).points.empty());
}

TEST(ContactSampling, IsOfTwoNeighboursForTheRightObliqueFissure) {
  RegionComplex complex = complexOf(testing::sphere(50.0, Vec3::Zero(), 5), 1);
  HeightSurface oblique;
  HeightSurface upright;
  upright.axes = {Vec3::UnitY(), Vec3::UnitZ(), Vec3::UnitX()};
  splitRegion(complex, oblique, {.region = 1, .below = 3, .above = 1}, "fissure");
  splitRegion(complex, upright, {.region = 1, .below = 2, .above = 1}, "fissure");
  const std::map<Lobe, TriangleMesh> lobes = {
      {Lobe::RightUpper, surfaceOf(complex, 1).mesh},
      {Lobe::RightMiddle, surfaceOf(complex, 2).mesh},
      {Lobe::RightLower, surfaceOf(complex, 3).mesh},
  };
  const double disk = 2500.0 * std::numbers::pi;
  EXPECT_NEAR(fissureContact(Fissure::RightOblique, lobes).areaMm2, disk, 0.01 * disk);
  EXPECT_NEAR(fissureContact(Fissure::RightHorizontal, lobes).areaMm2, disk / 2.0, 0.01 * disk);
  EXPECT_TRUE(fissureContact(Fissure::RightOblique, lobes).shared);
  EXPECT_TRUE(fissureContact(Fissure::LeftOblique, lobes).points.empty());
}

TEST(ContactSampling, SpreadsPointsWiderThanChance) {
  const RegionComplex complex = cutBall();
  const FissureContact contact =
      contactBetween(surfaceOf(complex, Below).mesh, surfaceOf(complex, Above).mesh);
  // Twelve points that fill a disk of radius 49 in hexagons have 24 mm between them.
  const std::vector<Vec3> farthest = farthestPoints(contact, 12);
  EXPECT_GT(leastApart(farthest), 20.0);
  EXPECT_EQ(farthestPoints(contact, 12), farthest);
  Random random(1);
  const std::vector<Vec3> spread = spreadPoints(contact, 12, random);
  EXPECT_GT(leastApart(spread), 12.0);
  Random again(1);
  EXPECT_EQ(spreadPoints(contact, 12, again), spread);
  EXPECT_NE(spreadPoints(contact, 12, again), spread);
  EXPECT_THROW(farthestPoints(contact, contact.points.size() + 1), InvalidInput);
  EXPECT_THROW(spreadPoints(contact, contact.points.size() + 1, random), InvalidInput);
}

TEST(ContactSampling, MovesPointsByNoiseOfTheWantedSize) {
  Random random(3);
  const std::vector<Vec3> noisy = withNoise(std::vector<Vec3>(3000, Vec3::Zero()), 2.0, random);
  double sum = 0.0;
  for (const Vec3& p : noisy) sum += p.squaredNorm();
  EXPECT_NEAR(std::sqrt(sum / 9000.0), 2.0, 0.05);
}

}  // namespace
}  // namespace pneuma
