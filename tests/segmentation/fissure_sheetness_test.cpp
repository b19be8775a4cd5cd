#include "segmentation/fissure_sheetness.h"

#include <cmath>

#include <gtest/gtest.h>

#include "core/error.h"
#include "core/parallel.h"
#include "segmentation/sheet_peak.h"

namespace pneuma {
namespace {

constexpr std::uint8_t Lung = 10;
constexpr double ContrastHu = 200.0;
constexpr double WidthMm = 0.8;  ///< standard deviation of the sheet's profile

struct Phantom {
  CtImage ct;
  LabelImage labels;
};

/// A lung in a box, oblique in the patient, of slices thicker than its pixels are wide.
template <class Density>
Phantom phantom(const Density& density) {
  ImageGeometry geometry;
  geometry.size = {60, 56, 36};
  geometry.spacing = Vec3(0.7, 0.7, 1.25);
  geometry.direction = Eigen::AngleAxisd(0.5, Vec3(1.0, 2.0, 3.0).normalized()).toRotationMatrix();
  geometry.direction.col(0) *= -1.0;  // left-handed
  geometry.origin = -geometry.direction * Vec3(21.0, 19.6, 22.5);
  Phantom made{{geometry, std::vector<std::int16_t>(geometry.voxelCount(), 40)},
               {geometry, std::vector<std::uint8_t>(geometry.voxelCount(), 0)}};
  for (int k = 2; k < 34; ++k) {
    for (int j = 4; j < 52; ++j) {
      for (int i = 4; i < 56; ++i) {
        const Vec3 p = geometry.worldFromVoxel(Vec3(i, j, k));
        made.ct.at(i, j, k) = static_cast<std::int16_t>(std::lround(density(p)));
        made.labels.at(i, j, k) = Lung;
      }
    }
  }
  return made;
}

const Vec3 Normal = Vec3(0.3, -0.6, 1.0).normalized();

double sheet(const Vec3& p) {
  const double d = p.dot(Normal);
  return -850.0 + ContrastHu * std::exp(-0.5 * d * d / (WidthMm * WidthMm));
}

TEST(FissureSheetness, IsTheCurvatureOfASheet) {
  const Phantom made = phantom(sheet);
  const SheetnessImage sheets = fissureSheetness(made.ct, made.labels, Lung);
  const SheetSampler sampler(sheets);
  // Blurred by 1 mm a Gaussian is a Gaussian; here its second derivative in the middle.
  const double expected = ContrastHu * WidthMm / std::pow(WidthMm * WidthMm + 1.0, 1.5);
  std::size_t looked = 0;
  for (int k = 0; k < sheets.geometry.size[2]; ++k) {
    for (int j = 0; j < sheets.geometry.size[1]; ++j) {
      for (int i = 0; i < sheets.geometry.size[0]; ++i) {
        const SheetVoxel& voxel = sheets.at(i, j, k);
        const double away = sheets.geometry.worldFromVoxel(Vec3(i, j, k)).dot(Normal);
        if (voxel.strength == SheetVoxel::NotMeasured || std::abs(away) > 0.1) continue;
        ++looked;
        // Slices of 1.25 mm are coarse for a Gaussian of 1 mm.
        EXPECT_NEAR(voxel.strength * SheetVoxel::Step / expected, 0.95, 0.15);
        const Vec3 normal = Vec3(voxel.normal[0], voxel.normal[1], voxel.normal[2]).normalized();
        EXPECT_GT(std::abs(normal.dot(Normal)), 0.995);
      }
    }
  }
  EXPECT_GT(looked, 100U);
  const Vec3 u = Normal.unitOrthogonal();
  for (const double along : {-8.0, -3.0, 0.0, 5.0, 9.0}) {
    // Between voxels some of the top is cut off.
    EXPECT_NEAR(sampler.strength(along * u, Normal, 0.9) / expected, 0.85, 0.15);
    EXPECT_LT(sampler.strength(along * u + 4.0 * Normal, Normal, 0.9), 0.05 * expected);
  }
  EXPECT_EQ(sampler.strength(Vec3::Zero(), u, 0.9), 0.0);  // lies the other way
}

TEST(FissureSheetness, MeasuresNothingAtTheEdgeOfTheLung) {
  const Phantom made = phantom(sheet);
  const SheetnessImage sheets = fissureSheetness(made.ct, made.labels, Lung);
  const SheetSampler sampler(sheets);
  const ImageGeometry& geometry = made.ct.geometry;
  EXPECT_TRUE(sampler.isMeasured(geometry.worldFromVoxel(Vec3(30, 28, 18))));
  EXPECT_TRUE(sampler.isMeasured(geometry.worldFromVoxel(Vec3(8, 28, 18))));
  EXPECT_FALSE(sampler.isMeasured(geometry.worldFromVoxel(Vec3(5, 28, 18))));
  EXPECT_FALSE(sampler.isMeasured(geometry.worldFromVoxel(Vec3(30, 28, 3))));
  EXPECT_FALSE(sampler.isMeasured(Vec3(1e4, 0.0, 0.0)));
}

TEST(FissureSheetness, IsFaintForATube) {
  const Phantom made = phantom([](const Vec3& p) {
    const double d2 = (p - p.dot(Normal) * Normal).squaredNorm();
    return -850.0 + ContrastHu * std::exp(-0.5 * d2 / (WidthMm * WidthMm));
  });
  const SheetnessImage sheets = fissureSheetness(made.ct, made.labels, Lung);
  const SheetSampler sampler(sheets);
  EXPECT_LT(sampler.strength(Vec3::Zero(), Normal.unitOrthogonal(), 0.0), 5.0);
}

TEST(FissureSheetness, IsTheSameForAnyNumberOfThreads) {
  const Phantom made = phantom(sheet);
  const SheetnessImage many = fissureSheetness(made.ct, made.labels, Lung);
  const ThreadLimit one(1);
  EXPECT_EQ(many.voxels, fissureSheetness(made.ct, made.labels, Lung).voxels);
}

TEST(FissureSheetness, RefusesALungThatIsNotThere) {
  const Phantom made = phantom(sheet);
  EXPECT_THROW(fissureSheetness(made.ct, made.labels, 20), InvalidInput);
}

TEST(CoherentSheet, TellsHowFarTheSheetIs) {
  const Phantom made = phantom(sheet);
  const SheetnessImage sheets = fissureSheetness(made.ct, made.labels, Lung);
  const SheetSampler sampler(sheets);
  const Vec3 tilted = (Normal + 0.2 * Normal.unitOrthogonal()).normalized();
  for (const double away : {-2.5, -1.0, 0.0, 0.3, 2.0}) {
    const auto found = coherentSheet(sampler, away * Normal, Normal, {});
    ASSERT_TRUE(found) << away;
    EXPECT_NEAR(*found, -away, 0.1);
    EXPECT_TRUE(coherentSheet(sampler, away * Normal, tilted, {})) << away;
  }
  EXPECT_FALSE(coherentSheet(sampler, 5.0 * Normal, Normal, {}));
  EXPECT_FALSE(coherentSheet(sampler, Vec3::Zero(), Normal.unitOrthogonal(), {}));
}

}  // namespace
}  // namespace pneuma
