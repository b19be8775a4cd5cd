#include "core/image.h"

#include <gtest/gtest.h>

namespace pneuma {
namespace {

/// 3 x 4 x 5 voxels, every one different, with axes given by columns.
CtImage numbered(const Mat3& direction) {
  CtImage image;
  image.geometry.size = {3, 4, 5};
  image.geometry.spacing = {0.7, 0.8, 2.5};
  image.geometry.origin = {-166.0, -171.7, -340.0};
  image.geometry.direction = direction;
  for (std::size_t v = 0; v < image.geometry.voxelCount(); ++v) {
    image.voxels.push_back(static_cast<std::int16_t>(v));
  }
  return image;
}

/// Every order and every sense of three axes: 48 matrices.
std::vector<Mat3> axisAlignedDirections() {
  std::vector<Mat3> all;
  std::array<int, 3> order{0, 1, 2};
  do {
    for (int signs = 0; signs < 8; ++signs) {
      Mat3 m = Mat3::Zero();
      for (int a = 0; a < 3; ++a) {
        m(order[static_cast<std::size_t>(a)], a) = ((signs >> a) & 1) != 0 ? -1.0 : 1.0;
      }
      all.push_back(m);
    }
  } while (std::next_permutation(order.begin(), order.end()));
  return all;
}

TEST(ImageGeometry, WorldAndVoxelAreInverse) {
  ImageGeometry geometry = numbered(Mat3::Identity()).geometry;
  geometry.direction.col(2) = Vec3(0.0, 0.2, 1.0).normalized();  // tilted gantry
  const Vec3 voxel(1.25, 2.5, 3.75);
  EXPECT_NEAR((geometry.voxelFromWorld(geometry.worldFromVoxel(voxel)) - voxel).norm(), 0.0, 1e-12);
  EXPECT_EQ(geometry.worldFromVoxel(Vec3::Zero()), geometry.origin);
}

TEST(ImageGeometry, VolumeOfSkewVoxelsIsTheDeterminant) {
  ImageGeometry geometry = numbered(Mat3::Identity()).geometry;
  EXPECT_NEAR(geometry.voxelMm3(), 0.7 * 0.8 * 2.5, 1e-12);
  geometry.direction.col(2) = Vec3(0.0, 0.6, 0.8);
  EXPECT_NEAR(geometry.voxelMm3(), 0.7 * 0.8 * 2.5 * 0.8, 1e-12);
}

TEST(ImageGeometry, BoundsReachHalfAVoxelBeyondTheCentres) {
  const Box3 box = numbered(Mat3::Identity()).geometry.bounds();
  EXPECT_NEAR(box.min().x(), -166.0 - 0.35, 1e-12);
  EXPECT_NEAR(box.max().z(), -340.0 + 4.5 * 2.5, 1e-12);
}

TEST(PatientAxes, EveryOrderIsTurnedToLeftBackAndUp) {
  for (const Mat3& direction : axisAlignedDirections()) {
    const CtImage image = numbered(direction);
    const AxisOrder order = patientAxes(image.geometry);
    const CtImage upright = turned(image, order);
    EXPECT_EQ(upright.geometry.direction, Mat3::Identity());
    for (int k = 0; k < upright.geometry.size[2]; ++k) {
      for (int j = 0; j < upright.geometry.size[1]; ++j) {
        for (int i = 0; i < upright.geometry.size[0]; ++i) {
          const Vec3 p = upright.geometry.worldFromVoxel(Vec3(i, j, k));
          const Vec3 at = image.geometry.voxelFromWorld(p);
          ASSERT_EQ(upright.at(i, j, k), image.at(static_cast<int>(std::lround(at.x())),
                                                  static_cast<int>(std::lround(at.y())),
                                                  static_cast<int>(std::lround(at.z()))));
        }
      }
    }
    const CtImage back = turned(upright, inverse(order));
    EXPECT_EQ(back.voxels, image.voxels);
    EXPECT_NEAR((back.geometry.origin - image.geometry.origin).norm(), 0.0, 1e-9);
    EXPECT_EQ(back.geometry.direction, image.geometry.direction);
  }
}

TEST(PatientAxes, ObliqueAxesGoToTheNearestAndKeepTheirDirections) {
  const Mat3 direction = Eigen::AngleAxisd(0.4, Vec3(0.3, 0.2, 0.9).normalized()).matrix() *
                         Vec3(-1.0, -1.0, 1.0).asDiagonal();
  const AxisOrder order = patientAxes(numbered(direction).geometry);
  EXPECT_EQ(order.from, (std::array{0, 1, 2}));
  EXPECT_EQ(order.flip, (std::array{true, true, false}));
}

}  // namespace
}  // namespace pneuma
