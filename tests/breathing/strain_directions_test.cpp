#include "breathing/strain_directions.h"

#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

#include "breathing/shot_unshot.h"
#include "breathing/strained_surfaces.h"
#include "breathing/surface_points.h"
#include "core/error.h"
#include "core/parallel.h"
#include "core/units.h"
#include "geometry/test_surfaces.h"

namespace pneuma {
namespace {

/// Root mean square, deg.
double angleBetween(const std::vector<Vec3>& a, const std::vector<Vec3>& b) {
  double sum = 0.0;
  for (std::size_t n = 0; n < a.size(); ++n) {
    sum += std::pow(std::asin(std::min(1.0, a[n].cross(b[n]).norm())), 2.0);
  }
  return degrees(std::sqrt(sum / static_cast<double>(a.size())));
}

TEST(StrainDirections, OfEqualStrainsOnABallStayRadial) {
  const TriangleMesh ball = testing::sphere(50.0, Vec3::Zero(), 3);
  const VertexNeighbours neighbours(ball);
  std::vector<Vec3> radial;
  for (const Vec3& p : ball.points) radial.push_back(p.normalized());
  const std::vector<double> equal(ball.points.size(), 0.3);
  double edges = 0.0;  // mean angle of an edge, seen from the centre
  double count = 0.0;
  for (std::size_t n = 0; n < radial.size(); ++n) {
    for (const std::uint32_t k : neighbours.of(n)) {
      edges += degrees(std::acos(radial[n].dot(radial[k])));
      count += 1.0;
    }
  }
  const std::vector<Vec3> found = strainDirections(neighbours, equal, radial);
  EXPECT_LT(angleBetween(found, radial), 0.1 * edges / count);
  EXPECT_GT(angleBetween(found, radial), 0.0);
}

TEST(StrainDirections, AreTheNormalsWhereAllMoveAlike) {
  TriangleMesh flat;
  for (int n = 0; n < 9; ++n) flat.points.emplace_back(n % 3, n / 3, 0.0);
  for (std::uint32_t n : {0U, 1U, 3U, 4U}) {
    flat.triangles.push_back({n, n + 1, n + 4});
    flat.triangles.push_back({n, n + 4, n + 3});
  }
  const VertexNeighbours neighbours(flat);
  const std::vector<double> equal(9, 0.2);
  for (const Vec3& direction : strainDirections(neighbours, equal, pointNormals(flat))) {
    EXPECT_TRUE(direction.isApprox(Vec3::UnitZ(), 1e-15));
  }
}

TEST(StrainDirections, AreTheSameForAnyNumberOfThreads) {
  const TriangleMesh lung = testing::irregularLung();
  const VertexNeighbours neighbours(lung);
  const auto find = [&] {
    return strainDirections(neighbours, testing::publishedStrainOf(lung), pointNormals(lung));
  };
  const std::vector<Vec3> all = find();
  const ThreadLimit one(1);
  EXPECT_EQ(find(), all);
  EXPECT_GT(angleBetween(all, pointNormals(lung)), 0.1);
  for (const Vec3& direction : all) EXPECT_NEAR(direction.norm(), 1.0, 1e-12);
}

VolumeSteps stepsOf(const TriangleMesh& lung) {
  const VertexNeighbours neighbours(lung);
  const std::vector<double> strain = testing::publishedStrainOf(lung);
  const std::vector<double> shot = sharedForce(neighbours, strain, strain, ForceSharing::Receiver);
  return {lung, shot, strainDirections(neighbours, shot, pointNormals(lung))};
}

/// Share by which a step misses the volume.
double missed(const TriangleMesh& lung, double ml) {
  VolumeSteps steps = stepsOf(lung);
  steps.step(1000.0 * ml);
  return std::abs((signedVolumeMm3(steps.surface()) - signedVolumeMm3(lung)) / (1000.0 * ml) - 1.0);
}

TEST(VolumeSteps, AreTrueForSmallVolumes) {
  const TriangleMesh lung = testing::regularLung();  // 1.6 l
  EXPECT_LT(missed(lung, 1.5), 0.0006);
  EXPECT_LT(missed(lung, 50.0), 0.02);
  EXPECT_GT(missed(lung, 500.0), 0.05);
  EXPECT_LT(missed(lung, 500.0), 0.2);
}

TEST(VolumeSteps, LeadBackToWhereTheyBegan) {
  const TriangleMesh lung = testing::regularLung();
  VolumeSteps steps = stepsOf(lung);
  for (int n = 0; n < 333; ++n) steps.step(1500.0);
  EXPECT_GT((steps.surface().points[0] - lung.points[0]).norm(), 1.0);
  for (int n = 0; n < 333; ++n) steps.step(-1500.0);
  for (std::size_t n = 0; n < lung.points.size(); ++n) {
    EXPECT_NEAR((steps.surface().points[n] - lung.points[n]).norm(), 0.0, 1e-11) << n;
  }
}

TEST(VolumeSteps, RefuseWhatDoesNotEnlarge) {
  const TriangleMesh lung = testing::regularLung();
  const std::vector<double> shot(lung.points.size(), 0.2);
  std::vector<Vec3> inwards = pointNormals(lung);
  for (Vec3& direction : inwards) direction = -direction;
  EXPECT_THROW(VolumeSteps(lung, shot, inwards), InvalidInput);
  EXPECT_THROW(VolumeSteps(lung, {}, inwards), InvalidInput);
}

}  // namespace
}  // namespace pneuma
