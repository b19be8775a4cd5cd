#include "segmentation/label_surface.h"

#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include "core/error.h"
#include "core/random.h"
#include "geometry/mesh_topology.h"

namespace pneuma {
namespace {

/// A ball of `radius` mm about `centre`, with a tube of airway that enters it.
LabelImage ball(const Mat3& direction, const Vec3& spacing, double radius) {
  LabelImage image;
  image.geometry.direction = direction;
  image.geometry.spacing = spacing;
  image.geometry.origin = {-30.0, 40.0, 12.0};
  for (int axis = 0; axis < 3; ++axis) {
    image.geometry.size[static_cast<std::size_t>(axis)] =
        static_cast<int>(std::ceil(2.4 * radius / spacing[axis]));
  }
  image.voxels.assign(image.geometry.voxelCount(), 0);
  const auto& size = image.geometry.size;
  const Vec3 centre =
      image.geometry.worldFromVoxel(Vec3(size[0] - 1, size[1] - 1, size[2] - 1) / 2.0);
  for (int k = 0; k < size[2]; ++k) {
    for (int j = 0; j < size[1]; ++j) {
      for (int i = 0; i < size[0]; ++i) {
        const Vec3 p = image.geometry.worldFromVoxel(Vec3(i, j, k)) - centre;
        if (p.norm() >= radius) continue;
        const bool airway = p.x() > 0.0 && std::hypot(p.y(), p.z()) < 3.0;
        image.at(i, j, k) = airway ? 6 : 10;
      }
    }
  }
  return image;
}

void expectClosed(const TriangleMesh& mesh) {
  const MeshTopology health = topology(mesh);
  EXPECT_EQ(health.openEdges, 0U);
  EXPECT_EQ(health.nonManifoldEdges, 0U);
  EXPECT_EQ(health.nonManifoldVertices, 0U);
  EXPECT_EQ(health.misorientedEdges, 0U);
  EXPECT_EQ(health.components, 1U);
}

TEST(LabelSurface, OfABallIsABallAndKeepsItsVolume) {
  const LabelImage image = ball(Mat3::Identity(), {0.7, 0.7, 2.5}, 25.0);
  const TriangleMesh mesh = labelSurface(image, 10);
  expectClosed(mesh);
  const double voxels = labelVolumeMm3(image, 10);
  EXPECT_NEAR(signedVolumeMm3(mesh) / voxels, 1.0, 1e-6);
  EXPECT_NEAR(voxels, 4.0 / 3.0 * std::numbers::pi * std::pow(25.0, 3), 600.0);
  const auto& size = image.geometry.size;
  const Vec3 centre =
      image.geometry.worldFromVoxel(Vec3(size[0] - 1, size[1] - 1, size[2] - 1) / 2.0);
  const double halfDiagonal = 0.5 * image.geometry.spacing.norm();
  for (const Vec3& p : mesh.points) {
    ASSERT_NEAR((p - centre).norm(), 25.0, halfDiagonal);  // the airway leaves no channel
  }
}

/// Distance from a point to the faces between voxels of the label and others, mm.
double fromFacesMm(const LabelImage& image, std::uint8_t label, const Vec3& p) {
  const ImageGeometry& geometry = image.geometry;
  const Vec3 at = geometry.voxelFromWorld(p);
  const auto is = [&](const Eigen::Vector3i& v) {
    for (int axis = 0; axis < 3; ++axis) {
      if (v[axis] < 0 || v[axis] >= geometry.size[static_cast<std::size_t>(axis)]) return false;
    }
    return image.at(v.x(), v.y(), v.z()) == label;
  };
  double nearest = 1e9;
  const Eigen::Vector3i centre = at.array().round().cast<int>();
  for (int n = 0; n < 125; ++n) {
    const Eigen::Vector3i v = centre + Eigen::Vector3i(n % 5 - 2, n / 5 % 5 - 2, n / 25 - 2);
    if (!is(v)) continue;
    for (int face = 0; face < 6; ++face) {
      const int axis = face / 2;
      const int step = face % 2 == 0 ? -1 : 1;
      Eigen::Vector3i beyond = v;
      beyond[axis] += step;
      if (is(beyond)) continue;
      Vec3 low = v.cast<double>().array() - 0.5;
      Vec3 high = v.cast<double>().array() + 0.5;
      low[axis] = high[axis] = v[axis] + 0.5 * step;
      const Vec3 away = (at - at.cwiseMax(low).cwiseMin(high)).cwiseProduct(geometry.spacing);
      nearest = std::min(nearest, away.norm());
    }
  }
  return nearest;
}

TEST(LabelSurface, StaysWithinHalfAVoxelOfARaggedWall) {
  LabelImage image;
  image.geometry.size = {81, 81, 81};
  image.geometry.spacing = Vec3::Constant(0.7);
  image.voxels.assign(image.geometry.voxelCount(), 0);
  Random random(3);
  for (int k = 0; k < 81; ++k) {
    for (int j = 0; j < 81; ++j) {
      for (int i = 0; i < 81; ++i) {
        const double wall = 25.0 + (random.uniform(0.0, 1.0) < 0.5 ? 3.0 : -3.0);
        image.at(i, j, k) = Vec3(i - 40, j - 40, k - 40).norm() < wall ? 10 : 0;
      }
    }
  }
  const TriangleMesh mesh = labelSurface(image, 10);
  double farthest = 0.0;
  for (const Vec3& p : mesh.points) farthest = std::max(farthest, fromFacesMm(image, 10, p));
  EXPECT_LE(farthest, 0.5 * image.geometry.spacing.norm());
}

TEST(LabelSurface, LooksOutwardsForEveryOrderOfTheAxes) {
  for (int signs = 0; signs < 8; ++signs) {
    Mat3 direction = Mat3::Zero();
    direction(1, 0) = (signs & 1) != 0 ? -1.0 : 1.0;
    direction(2, 1) = (signs & 2) != 0 ? -1.0 : 1.0;
    direction(0, 2) = (signs & 4) != 0 ? -1.0 : 1.0;
    const LabelImage image = ball(direction, {1.0, 1.5, 2.0}, 12.0);
    const TriangleMesh mesh = labelSurface(image, 10);
    expectClosed(mesh);
    EXPECT_NEAR(signedVolumeMm3(mesh) / labelVolumeMm3(image, 10), 1.0, 1e-6);
    EXPECT_TRUE(image.geometry.bounds().contains(bounds(mesh)));
  }
}

TEST(LabelSurface, OfFewTrianglesIsClosedAndKeepsTheVolume) {
  const LabelImage image = ball(Mat3::Identity(), {0.8, 0.8, 1.0}, 20.0);
  SurfaceOptions options;
  options.triangles = 3000;
  const TriangleMesh mesh = labelSurface(image, 10, options);
  expectClosed(mesh);
  EXPECT_LT(mesh.triangles.size(), 4500U);
  EXPECT_NEAR(signedVolumeMm3(mesh) / labelVolumeMm3(image, 10), 1.0, 1e-6);
}

TEST(LabelSurface, IsClosedWhereALungEndsWithTheSlices) {
  LabelImage image = ball(Mat3::Identity(), {1.0, 1.0, 1.0}, 15.0);
  image.geometry.size[2] /= 2;
  image.voxels.resize(image.geometry.voxelCount());
  expectClosed(labelSurface(image, 10));
}

TEST(LabelSurface, NeedsTheLabel) {
  EXPECT_THROW(labelSurface(ball(Mat3::Identity(), Vec3::Ones(), 10.0), 20), InvalidInput);
}

}  // namespace
}  // namespace pneuma
