#include "breathing/oriented_forces.h"

#include <random>

#include <gtest/gtest.h>

#include "breathing/breathing_surfaces.h"
#include "breathing/elastic_surface.h"
#include "breathing/field_volume.h"
#include "breathing/posture.h"
#include "breathing/spring_network.h"

namespace pneuma {
namespace {

TEST(OrientedForces, AreThoseOfASolutionForEveryPosture) {
  const TriangleMesh lung = testing::lungShaped(3);
  const LungFrame frame(Side::Right, bounds(lung));
  const SpringNetwork network(lung);
  const ElasticSurface skin(lung);
  const auto ofNetwork = [&](std::span<const double> f) { return network.forces(f, {1e-15}); };
  const auto ofSkin = [&](std::span<const double> f) { return skin.response(f, {1e-15}); };
  std::mt19937 random(1);
  for (const OrientedForces::Operator& solved :
       {OrientedForces::Operator(ofNetwork), OrientedForces::Operator(ofSkin)}) {
    const OrientedForces oriented(lung, frame, solved);
    for (int n = 0; n < 10; ++n) {
      const auto law = forceCoefficients(Side::Right, testing::anyDirection(random));
      std::vector<double> force;
      for (const Vec3& p : lung.points) force.push_back(forceAt(law, frame.shareOf(p)));
      const std::vector<double> direct = solved(force);
      const std::vector<double> summed = oriented.at(law);
      for (std::size_t i = 0; i < direct.size(); ++i) EXPECT_NEAR(summed[i], direct[i], 1e-12);
    }
  }
}

TEST(OrientedForces, AsSphericalHarmonicsAreTheSame) {
  // A force alpha + beta . g: solved for its four harmonics, then summed for a direction.
  const TriangleMesh lung = testing::lungShaped(3);
  const SpringNetwork network(lung);
  std::array<std::vector<double>, 4> kept;
  std::vector<Vec3> beta;
  for (const Vec3& p : lung.points) beta.push_back(p / 100.0);
  for (std::size_t lm = 0; lm < 4; ++lm) {
    std::vector<double> force;
    for (const Vec3& b : beta) force.push_back(harmonicsOf(2.0 + b.x(), b)[lm]);
    kept[lm] = network.forces(force, {1e-15});
  }
  std::mt19937 random(2);
  for (int n = 0; n < 10; ++n) {
    const Vec3 g = testing::anyDirection(random);
    std::vector<double> force;
    for (const Vec3& b : beta) force.push_back(2.0 + b.x() + b.dot(g));
    const std::vector<double> direct = network.forces(force, {1e-15});
    for (std::size_t i = 0; i < direct.size(); ++i) {
      EXPECT_NEAR(harmonicSum({kept[0][i], kept[1][i], kept[2][i], kept[3][i]}, g), direct[i],
                  1e-12);
    }
  }
}

TEST(FieldVolume, IsTheVolumeOfTheMovedSurface) {
  TriangleMesh lung = testing::lungShaped(3);
  for (Vec3& p : lung.points) p += Vec3(200.0, -300.0, 900.0);
  std::mt19937 random(3);
  std::uniform_real_distribution<double> any(-4.0, 4.0);
  std::array<std::vector<Vec3>, 4> fields;
  for (auto& field : fields) {
    for (std::size_t n = 0; n < lung.points.size(); ++n) {
      field.emplace_back(any(random), any(random), any(random));
    }
  }
  const FieldVolume volume(lung, fields);
  EXPECT_NEAR(volume.at({}) / signedVolumeMm3(lung), 1.0, 1e-12);
  for (int step = 0; step < 10; ++step) {
    const std::array<double, 4> w = {any(random), any(random), any(random), any(random)};
    std::vector<Vec3> sum(lung.points.size(), Vec3::Zero());
    TriangleMesh moved = lung;
    for (std::size_t n = 0; n < sum.size(); ++n) {
      for (std::size_t b = 0; b < 4; ++b) sum[n] += w[b] * fields[b][n];
      moved.points[n] += sum[n];
    }
    EXPECT_NEAR(volume.at(w) / signedVolumeMm3(moved), 1.0, 1e-12);
    const VolumePolynomial along = volume.along(w);
    const VolumePolynomial expected = volumePolynomial(lung, sum);
    for (std::size_t k = 0; k < 4; ++k) {
      EXPECT_NEAR(along.a[k] / expected.a[k], 1.0, 1e-9) << k;
    }
  }
}

}  // namespace
}  // namespace pneuma
