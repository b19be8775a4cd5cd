#include <array>

#include <gtest/gtest.h>

#include "io/volume_file.h"
#include "temp_folder.h"
#include "volume_samples.h"

/// Where the voxels of a volume stand must survive every format, whatever way its axes run.
namespace pneuma {
namespace {

using testing::TempFolder;

constexpr double ToleranceMm = 1e-4;

/// A ball to the left, a beam to the back and a pyramid on top, in patient coordinates: no flip or
/// exchange of axes maps them onto themselves.
std::int16_t phantomHu(const Vec3& p) {
  if ((p - Vec3(8, 0, 0)).norm() < 3.5) return 100;
  if (std::abs(p.x()) < 2 && p.y() > 4 && p.y() < 12 && std::abs(p.z()) < 3) return 200;
  const double height = p.z() - 4;
  if (height > 0 && height < 10 && std::max(std::abs(p.x()), std::abs(p.y())) < 5 - height / 2) {
    return 300;
  }
  return -1000;
}

Vec3 centreOf(const CtImage& image, std::int16_t hu) {
  Vec3 sum = Vec3::Zero();
  double count = 0.0;
  const auto& size = image.geometry.size;
  for (int k = 0; k < size[2]; ++k) {
    for (int j = 0; j < size[1]; ++j) {
      for (int i = 0; i < size[0]; ++i) {
        if (image.at(i, j, k) != hu) continue;
        sum += image.geometry.worldFromVoxel(Vec3(i, j, k));
        count += 1.0;
      }
    }
  }
  return sum / count;
}

/// The phantom around the origin, its slices sheared by `tiltDeg` as of a tilted gantry and the
/// whole turned by `turnDeg` about an oblique axis.
CtImage phantom(const std::array<int, 3>& size, double tiltDeg, double turnDeg) {
  CtImage image;
  ImageGeometry& geometry = image.geometry;
  geometry.size = size;
  for (int a = 0; a < 3; ++a) geometry.spacing[a] = 33.0 / size[static_cast<std::size_t>(a)];
  const double tilt = radians(tiltDeg);
  geometry.direction.col(2) = Vec3(0, std::sin(tilt), std::cos(tilt));
  const Eigen::AngleAxisd turn(radians(turnDeg), Vec3(1, 2, 3).normalized());
  geometry.direction = turn * geometry.direction;
  const Vec3 middle = Vec3(size[0] - 1, size[1] - 1, size[2] - 1) / 2;
  geometry.origin = Vec3(0.1, 0.2, 0.3) - geometry.steps() * middle;
  for (int k = 0; k < size[2]; ++k) {
    for (int j = 0; j < size[1]; ++j) {
      for (int i = 0; i < size[0]; ++i) {
        image.voxels.push_back(phantomHu(geometry.worldFromVoxel(Vec3(i, j, k))));
      }
    }
  }
  return image;
}

/// All 48 ways to store the axes of a volume.
std::vector<AxisOrder> axisOrders() {
  std::vector<AxisOrder> orders;
  std::array<int, 3> from = {0, 1, 2};
  do {
    for (unsigned flips = 0; flips < 8; ++flips) {
      orders.push_back({from, {(flips & 1) != 0, (flips & 2) != 0, (flips & 4) != 0}});
    }
  } while (std::next_permutation(from.begin(), from.end()));
  return orders;
}

double largestShift(const ImageGeometry& a, const ImageGeometry& b) {
  double largest = 0.0;
  for (unsigned corner = 0; corner < 8; ++corner) {
    Vec3 voxel;
    for (unsigned axis = 0; axis < 3; ++axis) {
      voxel[axis] = (corner >> axis & 1U) * (a.size[axis] - 1);
    }
    largest = std::max(largest, (a.worldFromVoxel(voxel) - b.worldFromVoxel(voxel)).norm());
  }
  return largest;
}

struct Shape {
  std::array<int, 3> size;
  double tiltDeg;
  double turnDeg;
};

class VolumeGeometry : public ::testing::TestWithParam<std::string> {};

TEST_P(VolumeGeometry, SurvivesEveryOrderOfAxesAndTilt) {
  const TempFolder folder;
  const std::filesystem::path path = folder / ("phantom" + GetParam());
  for (const Shape& shape : {Shape{{22, 15, 12}, 0, 0}, Shape{{9, 16, 7}, 12, 0},
                             Shape{{14, 8, 11}, 0, 30}, Shape{{8, 13, 10}, -20, -75}}) {
    const CtImage upright = phantom(shape.size, shape.tiltDeg, shape.turnDeg);
    for (const AxisOrder& order : axisOrders()) {
      const CtImage written = turned(upright, order);
      writeVolume(path, written);
      const CtImage read = readHuVolume(path);
      ASSERT_EQ(read.geometry.size, written.geometry.size);
      EXPECT_EQ(read.voxels, written.voxels);
      EXPECT_LT(largestShift(read.geometry, written.geometry), ToleranceMm);
      // The shapes are where they were before the axes were exchanged, not only where they were
      // written.
      for (const std::int16_t hu : {100, 200, 300}) {
        EXPECT_LT((centreOf(read, hu) - centreOf(upright, hu)).norm(), ToleranceMm) << hu;
      }
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Formats, VolumeGeometry,
                         ::testing::Values(".nii", ".nii.gz", ".nrrd", ".mha"),
                         [](const auto& format) {
                           std::string name = format.param.substr(1);
                           std::erase(name, '.');
                           return name;
                         });

TEST(VolumeGeometryOfText, IsExact) {
  const TempFolder folder;
  CtImage image = testing::sampleCt();
  image.geometry.origin.x() = 1.0 / 3.0;
  for (const char* name : {"a.nrrd", "a.mha"}) {
    writeVolume(folder / name, image);
    const ImageGeometry read = readVolumeHeader(folder / name).geometry;
    EXPECT_EQ(read.origin, image.geometry.origin) << name;
    EXPECT_EQ(read.spacing, image.geometry.spacing) << name;
    EXPECT_EQ(read.direction, image.geometry.direction) << name;
  }
}

}  // namespace
}  // namespace pneuma
