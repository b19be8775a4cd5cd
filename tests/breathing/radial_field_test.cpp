#include "breathing/radial_field.h"

#include <random>

#include <Eigen/LU>
#include <gtest/gtest.h>

#include "breathing/breathing_surfaces.h"
#include "core/error.h"

namespace pneuma {
namespace {

struct Sampled {
  std::vector<Vec3> centres;
  std::vector<Vec3> values;
};

template <class Field>
Sampled sampled(const TriangleMesh& lung, std::size_t count, const Field& field) {
  Sampled at;
  for (const std::uint32_t n : farthestPoints(lung.points, count)) {
    at.centres.push_back(lung.points[n]);
    at.values.push_back(field(lung.points[n]));
  }
  return at;
}

Vec3 bent(const Vec3& p) {
  return {3.0 * std::sin(p.y() / 60.0), 2.0 * std::cos(p.z() / 70.0) + 0.02 * p.x(),
          0.0002 * p.z() * p.z()};
}

TEST(RadialField, ReproducesAffineFields) {
  const TriangleMesh lung = testing::lungShaped(4);
  Eigen::Matrix3d map;
  map << 0.1, -0.2, 0.05, 0.3, 0.02, 0.1, -0.1, 0.2, 0.4;
  const auto affine = [&](const Vec3& p) { return Vec3(map * p + Vec3(5.0, -7.0, 2.0)); };
  const Sampled at = sampled(lung, 400, affine);
  const RadialField field(at.centres, at.values);
  std::mt19937 random(1);
  std::uniform_real_distribution<double> any(-1.0, 1.0);
  for (int n = 0; n < 100; ++n) {
    const Vec3 p = Vec3(-70.0, 10.0, 30.0) +
                   Vec3(70.0 * any(random), 100.0 * any(random), 140.0 * any(random));
    EXPECT_LE((field.at(p) - affine(p)).norm(), 1e-9);
    EXPECT_LE((field.gradientAt(p) - map).norm(), 1e-9);
  }
}

TEST(RadialField, TakesItsValuesAndIsCloseToThemBetween) {
  const TriangleMesh lung = testing::lungShaped(4);
  const Sampled at = sampled(lung, 300, bent);
  const RadialField field(at.centres, at.values);
  for (std::size_t n = 0; n < at.centres.size(); ++n) {
    EXPECT_LE((field.at(at.centres[n]) - at.values[n]).norm(), 1e-10);
  }
  for (const Vec3& p : lung.points) EXPECT_LE((field.at(p) - bent(p)).norm(), 0.2);
}

TEST(RadialField, HasTheGradientOfItsValues) {
  const TriangleMesh lung = testing::lungShaped(3);
  const Sampled at = sampled(lung, 200, bent);
  const RadialField field(at.centres, at.values);
  for (std::size_t n = 0; n < lung.points.size(); n += 7) {
    const Vec3 p = Vec3(-70.0, 10.0, 30.0) + 0.7 * (lung.points[n] - Vec3(-70.0, 10.0, 30.0));
    const Eigen::Matrix3d gradient = field.gradientAt(p);
    for (int axis = 0; axis < 3; ++axis) {
      const Vec3 step = 1e-4 * Vec3::Unit(axis);
      const Vec3 slope = (field.at(p + step) - field.at(p - step)) / 2e-4;
      EXPECT_LE((gradient.col(axis) - slope).norm(), 1e-8);
    }
  }
  EXPECT_TRUE(field.gradientAt(at.centres[3]).allFinite());
}

TEST(FarthestPoints, SpreadOverTheSurfaceAndNameNoneTwice) {
  const TriangleMesh lung = testing::lungShaped(4);
  const auto chosen = farthestPoints(lung.points, 100);
  ASSERT_EQ(chosen.size(), 100u);
  double least = 1e9;
  for (std::size_t a = 0; a < chosen.size(); ++a) {
    for (std::size_t b = 0; b < a; ++b) {
      least = std::min(least, (lung.points[chosen[a]] - lung.points[chosen[b]]).norm());
    }
  }
  EXPECT_GT(least, 20.0);
  const std::vector<Vec3> twice = {Vec3::Zero(), Vec3::UnitX(), Vec3::Zero()};
  EXPECT_EQ(farthestPoints(twice, 3).size(), 2u);
}

TEST(RadialField, RefusesPointsOfAPlane) {
  std::vector<Vec3> flat;
  for (int n = 0; n < 9; ++n) flat.emplace_back(n % 3, n / 3, 0.0);
  EXPECT_THROW(RadialField(flat, flat), InvalidInput);
  flat.resize(3);
  EXPECT_THROW(RadialField(flat, flat), InvalidInput);
}

}  // namespace
}  // namespace pneuma
