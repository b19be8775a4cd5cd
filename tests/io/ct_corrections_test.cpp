#include "io/ct_corrections.h"

#include <array>
#include <cmath>

#include <gtest/gtest.h>

#include "core/error.h"
#include "core/units.h"
#include "support/progress_recorder.h"

namespace pneuma {
namespace {

using testing::ProgressRecorder;

template <class Hu>
CtImage filled(const ImageGeometry& geometry, const Hu& hu) {
  CtImage image{geometry, std::vector<std::int16_t>(geometry.voxelCount())};
  for (int k = 0; k < geometry.size[2]; ++k) {
    for (int j = 0; j < geometry.size[1]; ++j) {
      for (int i = 0; i < geometry.size[0]; ++i) {
        image.at(i, j, k) =
            static_cast<std::int16_t>(std::lround(hu(geometry.worldFromVoxel(Vec3(i, j, k)))));
      }
    }
  }
  return image;
}

/// Linear in space: any sound interpolation gives it back.
double ramp(const Vec3& p) { return 10.0 * p.x() - 20.0 * p.y() + 30.0 * p.z(); }

ImageGeometry grid(const std::array<int, 3>& size, const Vec3& spacing) {
  ImageGeometry geometry;
  geometry.size = size;
  geometry.spacing = spacing;
  geometry.origin = Vec3(3.0, -4.0, 5.0);
  return geometry;
}

ImageGeometry tiltedGrid(double deg) {
  ImageGeometry geometry = grid({12, 14, 9}, Vec3(2.0, 2.0, 5.0));
  geometry.direction.col(2) = Vec3(0.0, std::sin(radians(deg)), std::cos(radians(deg)));
  return geometry;
}

TEST(FilledSlices, LieOnTheLineBetweenTheirNeighbours) {
  const CtImage truth = filled(grid({5, 4, 7}, Vec3(1.0, 1.0, 2.0)), ramp);
  CtImage holed = truth;
  const std::vector<std::size_t> missing = {2, 3, 5};
  for (const std::size_t k : missing) {
    for (int i = 0; i < 20; ++i) holed.voxels[k * 20 + static_cast<std::size_t>(i)] = 9999;
  }
  EXPECT_EQ(withSlicesFilled(holed, missing).voxels, truth.voxels);
}

TEST(FilledSlices, DoNotMixPaddingIntoTissue) {
  CtImage image = filled(grid({2, 1, 5}, Vec3::Ones()), [](const Vec3&) { return 100.0; });
  image.at(0, 0, 0) = PaddingHu;
  const std::vector<std::size_t> missing = {1, 2, 3};
  const CtImage result = withSlicesFilled(image, missing);
  EXPECT_EQ(result.at(0, 0, 1), PaddingHu);
  EXPECT_EQ(result.at(0, 0, 3), 100);
  EXPECT_EQ(result.at(1, 0, 2), 100);
}

TEST(FilledSlices, CannotReachBeyondTheStack) {
  const CtImage image = filled(grid({2, 2, 3}, Vec3::Ones()), ramp);
  const std::vector<std::size_t> first = {0};
  EXPECT_THROW(withSlicesFilled(image, first), InvalidInput);
}

TEST(Untilting, KeepsEveryPointWhereItWas) {
  for (const double deg : {12.0, -7.5, 1.0}) {
    const CtImage image = filled(tiltedGrid(deg), ramp);
    ASSERT_NEAR(tiltDeg(image.geometry), std::abs(deg), 1e-9);
    const CtImage straight = untilted(image);
    EXPECT_NEAR(tiltDeg(straight.geometry), 0.0, 1e-9);
    EXPECT_NEAR(straight.geometry.spacing.z(), 5.0 * std::cos(radians(deg)), 1e-12);
    int compared = 0;
    for (int k = 0; k < straight.geometry.size[2]; ++k) {
      for (int j = 0; j < straight.geometry.size[1]; ++j) {
        for (int i = 0; i < straight.geometry.size[0]; ++i) {
          const std::int16_t hu = straight.at(i, j, k);
          const Vec3 p = straight.geometry.worldFromVoxel(Vec3(i, j, k));
          const Vec3 old = image.geometry.voxelFromWorld(p);
          if (old.y() < 1.0 || old.y() > image.geometry.size[1] - 2.0) continue;  // at the rim
          // Both the phantom and the result are rounded.
          ASSERT_NEAR(hu, ramp(p), 1.01) << deg << " at " << i << " " << j << " " << k;
          ++compared;
        }
      }
    }
    EXPECT_GT(compared, 1000);
  }
}

TEST(Untilting, LosesNoVoxelAndMarksTheCornersAsPadding) {
  const CtImage image = filled(tiltedGrid(12.0), [](const Vec3&) { return 40.0; });
  const CtImage straight = untilted(image);
  const auto there = std::ranges::count(straight.voxels, 40);
  const auto padding = std::ranges::count(straight.voxels, PaddingHu);
  EXPECT_EQ(there + padding, static_cast<std::ptrdiff_t>(straight.voxels.size()));
  EXPECT_NEAR(static_cast<double>(there), static_cast<double>(image.voxels.size()), 12.0 * 9);
  const Box3 box = straight.geometry.bounds();
  for (const int k : {0, 8}) {
    for (const int j : {0, 13}) {
      EXPECT_TRUE(box.contains(image.geometry.worldFromVoxel(Vec3(0, j, k))));
    }
  }
}

TEST(Resampling, GivesBackARampAtAnyVoxelSize) {
  const CtImage image = filled(grid({20, 16, 12}, Vec3(0.8, 0.8, 2.5)), ramp);
  for (const double side : {0.5, 0.8, 1.0, 2.0}) {
    const CtImage result = resampled(image, side);
    const ImageGeometry& geometry = result.geometry;
    EXPECT_EQ(geometry.spacing, Vec3::Constant(side));
    // The same box, to half a voxel.
    EXPECT_LT((geometry.bounds().center() - image.geometry.bounds().center()).norm(), 1e-9);
    EXPECT_LE((geometry.bounds().sizes() - image.geometry.bounds().sizes()).cwiseAbs().maxCoeff(),
              side / 2.0 + 1e-9);
    for (int k = 0; k < geometry.size[2]; ++k) {
      for (int i = 0; i < geometry.size[0]; ++i) {
        const Vec3 p = geometry.worldFromVoxel(Vec3(i, geometry.size[1] / 2, k));
        const Vec3 old = image.geometry.voxelFromWorld(p);
        const Vec3 rim = Vec3::Constant(side).cwiseQuotient(image.geometry.spacing);
        if ((old - rim).minCoeff() < 0.0 || old.x() + rim.x() > 19.0 || old.z() + rim.z() > 11.0) {
          continue;  // the tent reaches beyond the image
        }
        // Three passes round to whole HU; a tent over few samples is not quite symmetric.
        EXPECT_NEAR(result.at(i, geometry.size[1] / 2, k), ramp(p), side > 0.8 ? 4.0 : 1.6);
      }
    }
  }
}

TEST(Resampling, PutsUnevenSlicesWhereTheyStand) {
  const std::vector<double> at = {0.0, 5.8, 10.0, 15.8, 20.0, 25.8, 30.0};
  ImageGeometry geometry = grid({4, 4, 7}, Vec3(5.0, 5.0, 5.0));
  CtImage image{geometry, std::vector<std::int16_t>(geometry.voxelCount())};
  for (int k = 0; k < 7; ++k) {
    for (int i = 0; i < 16; ++i) {
      image.voxels[static_cast<std::size_t>(k * 16 + i)] =
          static_cast<std::int16_t>(std::lround(100.0 * at[static_cast<std::size_t>(k)]));
    }
  }
  const CtImage result = resampled(image, 5.0, at);
  for (int k = 0; k < 7; ++k) {
    EXPECT_NEAR(result.at(1, 1, k), 500.0 * k, 1.0);
  }
  EXPECT_EQ(result.geometry.origin, geometry.origin);
}

TEST(Resampling, NeverLeavesTheRangeOfItsSourcesOrMixesPadding) {
  CtImage image = filled(grid({9, 9, 9}, Vec3(1.0, 1.0, 3.0)),
                         [](const Vec3& p) { return p.x() > 7.0 ? 1000.0 : -900.0; });
  for (int k = 0; k < 9; ++k) {
    for (int j = 0; j < 9; ++j) image.at(0, j, k) = PaddingHu;
  }
  for (const double side : {0.6, 2.0}) {
    for (const std::int16_t hu : resampled(image, side).voxels) {
      EXPECT_TRUE(hu == PaddingHu || (hu >= -900 && hu <= 1000)) << hu;
    }
  }
}

TEST(Resampling, IsTheImageItselfAtItsOwnSpacing) {
  const CtImage image = filled(grid({6, 5, 4}, Vec3::Constant(1.5)), ramp);
  const CtImage same = resampled(image, 1.5);
  EXPECT_EQ(same.voxels, image.voxels);
  EXPECT_EQ(same.geometry, image.geometry);
}

TEST(Corrections, StopOnRequest) {
  const CtImage image = filled(tiltedGrid(12.0), ramp);
  ProgressRecorder stop(0.0);
  EXPECT_THROW(untilted(image, Progress(stop)), Cancelled);
  EXPECT_THROW(resampled(image, 1.0, {}, Progress(stop)), Cancelled);
}

TEST(Corrections, SayHowMuchMemoryIsMissing) {
  const CtImage image = filled(grid({300, 300, 2}, Vec3::Constant(400.0)), ramp);
  try {
    resampled(image, 0.01);
    FAIL() << "an image of petabytes was made";
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ExitCode::OutOfMemory);
    EXPECT_NE(std::string(error.what()).find("MB"), std::string::npos);
  }
}

}  // namespace
}  // namespace pneuma
