#include "pipeline/detail/ct_scan.h"

#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include "core/parallel.h"

namespace pneuma {
namespace {

ImageGeometry grid(std::array<int, 3> size, const Vec3& spacing) {
  ImageGeometry geometry;
  geometry.size = size;
  geometry.spacing = spacing;
  geometry.origin = -0.5 * (Vec3(size[0], size[1], size[2]) - Vec3::Ones()).cwiseProduct(spacing);
  return geometry;
}

CtShape ball(double radius, double hu) {
  CtShape shape = tubeShape({Vec3::Zero(), Vec3::Zero(), radius, radius}, hu);
  shape.label = Lobe::Central;
  return shape;
}

CtShape everywhere(double hu) {
  CtShape shape;
  shape.box = endlessBox();
  shape.level = [](const Vec3&) { return 1e9; };
  shape.hu = hu;
  return shape;
}

/// Sharp and without noise.
ScanSettings exact() {
  ScanSettings settings;
  settings.blurMm = 0.0;
  settings.noiseHu = 0.0;
  return settings;
}

TEST(CtScan, AVoxelIsTheMeanOverItsVolume) {
  CtShape wall = everywhere(200.0);
  wall.level = [](const Vec3& p) { return p.z() - 0.7; };
  const ScannedBody scan = scanned({wall}, grid({4, 4, 5}, {0.8, 0.8, 5.0}), exact());
  EXPECT_EQ(scan.image.at(1, 2, 1), -1000);
  EXPECT_EQ(scan.image.at(1, 2, 3), 200);
  EXPECT_NEAR(scan.image.at(1, 2, 2), -1000.0 + 1200.0 * (2.5 - 0.7) / 5.0,
              12.0);  // 1 % of the step: the part of 1.25 mm at the wall is blended
  EXPECT_EQ(scan.labels.at(1, 2, 2), 0);
}

TEST(CtScan, ABallKeepsItsMassInThickAndTiltedSlices) {
  const double radius = 11.3;
  const double volume = 4.0 / 3.0 * std::numbers::pi * std::pow(radius, 3);
  for (const double thick : {1.0, 2.5, 7.0}) {
    for (const double tilt : {0.0, 0.35}) {
      ImageGeometry geometry = grid({40, 40, static_cast<int>(45.0 / thick)}, {0.9, 0.9, thick});
      geometry.direction.col(1) = Vec3(0.0, std::cos(tilt), std::sin(tilt));
      geometry.origin = -geometry.steps() * Vec3(19.5, 19.5, (geometry.size[2] - 1) / 2.0);
      const ScannedBody scan = scanned({ball(radius, 0.0)}, geometry, exact());
      double mass = 0.0;
      for (const std::int16_t hu : scan.image.voxels) mass += (hu + 1000) / 1000.0;
      EXPECT_NEAR(mass * geometry.voxelMm3(), volume, 0.01 * volume) << thick << " " << tilt;
    }
  }
}

TEST(CtScan, LabelsGoByTheVoxelsCentres) {
  const ImageGeometry geometry = grid({30, 30, 12}, {1.1, 1.1, 2.5});
  const ScannedBody scan = scanned({ball(10.0, 0.0)}, geometry, exact());
  for (int k = 0; k < 12; ++k) {
    for (int j = 0; j < 30; ++j) {
      for (int i = 0; i < 30; ++i) {
        const bool inside = geometry.worldFromVoxel(Vec3(i, j, k)).norm() < 10.0;
        ASSERT_EQ(scan.labels.at(i, j, k), inside ? 6 : 0);
      }
    }
  }
}

TEST(CtScan, TheFirstOfTwoShapesCounts) {
  const ScannedBody scan =
      scanned({ball(5.0, 700.0), ball(9.0, 40.0)}, grid({21, 21, 21}, Vec3::Ones()), exact());
  EXPECT_EQ(scan.image.at(10, 10, 10), 700);
  EXPECT_EQ(scan.image.at(10, 10, 17), 40);
  EXPECT_EQ(scan.image.at(10, 10, 20), -1000);
}

TEST(CtScan, NoiseHasTheStandardDeviationAskedForAndTheGrainOfTheBlur) {
  for (const double spacing : {0.7, 2.2}) {
    const ImageGeometry geometry = grid({200, 200, 3}, {spacing, spacing, 2.0});
    ScanSettings settings;
    settings.noiseHu = 25.0;
    const ScannedBody scan = scanned({everywhere(50.0)}, geometry, settings);
    double sum = 0.0;
    double squares = 0.0;
    double neighbours = 0.0;
    double n = 0.0;
    for (int j = 5; j < 195; ++j) {
      for (int i = 5; i < 195; ++i) {
        const double hu = scan.image.at(i, j, 1) - 50.0;
        sum += hu;
        squares += hu * hu;
        neighbours += hu * (scan.image.at(i + 1, j, 1) - 50.0);
        n += 1.0;
      }
    }
    EXPECT_NEAR(sum / n, 0.0, 1.0);
    EXPECT_NEAR(std::sqrt(squares / n), 25.0, 1.0) << spacing;
    EXPECT_NEAR(neighbours / squares, spacing < 1.0 ? 0.71 : 0.03, 0.08) << spacing;
  }
}

TEST(CtScan, WhatTheScannerDoesNotSeeIsPadding) {
  ScanSettings settings;
  settings.circleMm = 10.0;
  const ScannedBody scan =
      scanned({everywhere(50.0)}, grid({31, 31, 1}, {1.0, 1.0, 5.0}), settings);
  EXPECT_EQ(scan.image.at(0, 0, 0), PaddingHu);
  EXPECT_EQ(scan.image.at(15, 4, 0), PaddingHu);
  EXPECT_GT(scan.image.at(15, 6, 0), -200);
}

}  // namespace
}  // namespace pneuma
