#include "geometry/surface_voxels.h"

#include <numeric>

#include <gtest/gtest.h>

#include "core/error.h"
#include "test_surfaces.h"

namespace pneuma {
namespace {

std::size_t count(const std::vector<std::uint8_t>& voxels) {
  return std::accumulate(voxels.begin(), voxels.end(), std::size_t{0});
}

ImageGeometry grid(int voxels, double spacing, const Vec3& origin) {
  ImageGeometry geometry;
  geometry.size = {voxels, voxels, voxels};
  geometry.spacing = Vec3::Constant(spacing);
  geometry.origin = origin;
  return geometry;
}

TEST(SurfaceVoxels, FillABall) {
  const TriangleMesh ball = testing::sphere(20.0, Vec3(3.0, -4.0, 5.0), 5);
  const ImageGeometry geometry = geometryAround(bounds(ball), 0.5, 3);
  const std::vector<std::uint8_t> inside = voxelsInside(ball, geometry);
  const double volume = static_cast<double>(count(inside)) * geometry.voxelMm3();
  EXPECT_NEAR(volume / signedVolumeMm3(ball), 1.0, 1e-3);
  for (int k = 0; k < geometry.size[2]; ++k) {
    for (int j = 0; j < geometry.size[1]; ++j) {
      for (int i = 0; i < geometry.size[0]; ++i) {
        const double r = (geometry.worldFromVoxel(Vec3(i, j, k)) - Vec3(3.0, -4.0, 5.0)).norm();
        const bool isIn = inside[geometry.index(i, j, k)] != 0;
        ASSERT_FALSE((isIn && r > 20.001) || (!isIn && r < 19.9)) << r;
      }
    }
  }
}

TEST(SurfaceVoxels, AreTheSameInATurnedImage) {
  const TriangleMesh ball = testing::sphere(10.0, Vec3(1.0, 2.0, 3.0), 4);
  ImageGeometry geometry = grid(50, 0.5, Vec3(13.0, -10.0, -9.0));
  geometry.direction = Vec3(-1.0, 1.0, 1.0).asDiagonal();
  EXPECT_NEAR(static_cast<double>(count(voxelsInside(ball, geometry))) * geometry.voxelMm3() /
                  signedVolumeMm3(ball),
              1.0, 5e-3);
}

TEST(SurfaceVoxels, OfNeighboursAreEachInOne) {
  // Faces run through voxel centres exactly, along rows, columns and slices.
  const ImageGeometry geometry = grid(41, 1.0, Vec3::Constant(-20.0));
  std::vector<int> times(geometry.voxelCount(), 0);
  for (int corner = 0; corner < 8; ++corner) {
    const Vec3 low((corner & 1) * 10.0 - 10.0, (corner & 2) * 5.0 - 10.0,
                   (corner & 4) * 2.5 - 10.0);
    const std::vector<std::uint8_t> inside = voxelsInside(testing::cube(10.0, low), geometry);
    EXPECT_EQ(count(inside), 1000U);
    for (std::size_t v = 0; v < inside.size(); ++v) times[v] += inside[v];
  }
  for (const int n : times) ASSERT_LE(n, 1);
  EXPECT_EQ(std::accumulate(times.begin(), times.end(), 0), 8000);
}

TEST(SurfaceVoxels, BeyondTheImageAreLeftOut) {
  const ImageGeometry geometry = grid(10, 1.0, Vec3::Zero());
  EXPECT_EQ(count(voxelsInside(testing::cube(100.0, Vec3::Constant(-50.5)), geometry)), 1000U);
  EXPECT_EQ(count(voxelsInside(testing::cube(5.0, Vec3::Constant(50.0)), geometry)), 0U);
}

TEST(SurfaceVoxels, RefuseWhatIsFarTooLarge) {
  EXPECT_THROW(geometryAround(bounds(testing::cube(1e6)), 1.0, 2), InvalidInput);
}

}  // namespace
}  // namespace pneuma
