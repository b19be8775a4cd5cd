#include "breathing/volume_polynomial.h"

#include <cmath>
#include <random>

#include <gtest/gtest.h>

#include "geometry/test_surfaces.h"

namespace pneuma {
namespace {

TEST(VolumePolynomial, OfAGrowingSphereIsTheCube) {
  const TriangleMesh ball = testing::sphere(50.0, Vec3::Zero(), 3);
  const VolumePolynomial volume = volumePolynomial(ball, ball.points);
  for (const double s : {-0.5, 0.0, 0.2, 1.0}) {
    EXPECT_NEAR(volume.at(s) / (signedVolumeMm3(ball) * std::pow(1.0 + s, 3.0)), 1.0, 1e-13);
  }
}

TEST(VolumePolynomial, IsTheVolumeOfTheMovedSurface) {
  TriangleMesh mesh = testing::sphere(60.0, Vec3::Zero(), 3);
  std::mt19937 random(7);
  std::uniform_real_distribution<double> any(-4.0, 4.0);
  std::vector<Vec3> u;
  for (Vec3& p : mesh.points) {
    p += Vec3(300.0, -200.0, 900.0);
    u.emplace_back(any(random), any(random), any(random));
  }
  const VolumePolynomial volume = volumePolynomial(mesh, u);
  for (const double s : {-0.5, 0.3, 1.0, 3.0}) {
    TriangleMesh moved = mesh;
    for (std::size_t n = 0; n < u.size(); ++n) moved.points[n] += s * u[n];
    EXPECT_NEAR(volume.at(s) / signedVolumeMm3(moved), 1.0, 1e-12) << s;
    EXPECT_EQ(movedVolumeMm3(mesh, u, s), signedVolumeMm3(moved)) << s;
  }
}

TEST(VolumePolynomial, ScaleReachesTheVolumeExactly) {
  const TriangleMesh ball = testing::sphere(50.0, Vec3::Zero(), 3);
  const VolumePolynomial volume = volumePolynomial(ball, ball.points);
  for (const double wanted : {0.3, 0.9, 1.0, 1.7, 4.0}) {
    const auto s = scaleForVolume(volume, wanted * volume.a[0]);
    ASSERT_TRUE(s);
    EXPECT_NEAR(*s, std::cbrt(wanted) - 1.0, 1e-13);
  }
  EXPECT_FALSE(scaleForVolume(volume, -1.0));
}

TEST(FoldLimit, OfAShrinkingBallIsItsCentre) {
  const TriangleMesh ball = testing::sphere(50.0, Vec3::Zero(), 2);
  EXPECT_FALSE(foldLimit(ball, ball.points));
  std::vector<Vec3> inwards;
  for (const Vec3& p : ball.points) inwards.push_back(-p);
  // Every edge shrinks to nothing at s = 1.
  ASSERT_TRUE(foldLimit(ball, inwards));
  EXPECT_NEAR(*foldLimit(ball, inwards), 1.0, 1e-6);
  ASSERT_TRUE(foldLimit(ball, ball.points, -1.0));
  EXPECT_NEAR(*foldLimit(ball, ball.points, -1.0), -1.0, 1e-6);
}

TEST(FoldLimit, IsWhereTheFirstTriangleTurnsOver) {
  const TriangleMesh ball = testing::sphere(50.0, Vec3::Zero(), 2);
  std::vector<Vec3> u(ball.points.size(), Vec3::Zero());
  u[0] = -ball.points[0];  // pushed through
  const auto limit = foldLimit(ball, u);
  ASSERT_TRUE(limit);
  const auto turned = [&](double s) {
    TriangleMesh moved = ball;
    for (std::size_t n = 0; n < u.size(); ++n) moved.points[n] += s * u[n];
    for (const auto& [i, j, k] : ball.triangles) {
      const auto area = [&](const TriangleMesh& m) {
        return Vec3((m.points[j] - m.points[i]).cross(m.points[k] - m.points[i]));
      };
      if (area(ball).dot(area(moved)) <= 0.0) return true;
    }
    return false;
  };
  EXPECT_FALSE(turned(0.999 * *limit));
  EXPECT_TRUE(turned(1.001 * *limit));
}

}  // namespace
}  // namespace pneuma
