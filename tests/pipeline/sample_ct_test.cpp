#include "pipeline/sample_ct.h"

#include <algorithm>
#include <cmath>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/parallel.h"
#include "core/units.h"
#include "support/chest_once.h"
#include "support/progress_recorder.h"

namespace pneuma {
namespace {

using ::testing::HasSubstr;

/// Coarse and without noise, so that a CT takes about a second.
SampleCtOptions coarse() {
  SampleCtOptions options;
  options.spacingMm = 2.5;
  options.thickMm = 3.0;
  options.noiseHu = 0.0;
  return options;
}

const SampleCt& plain() {
  static const SampleCt made = sampleCt(testing::chest(), coarse());
  return made;
}

constexpr std::uint8_t Right = 10;
constexpr std::uint8_t Left = 20;
constexpr std::uint8_t Airways = 6;

bool inLung(Side lung, const Vec3& p) {
  return std::ranges::any_of(testing::chest().truth, [&](const LobeRegion& region) {
    return side(region.lobe) == lung && region.domain->contains(p);
  });
}

double formulaMl(Side lung) {
  double ml = 0.0;
  for (const LobeRegion& region : testing::chest().truth) {
    if (side(region.lobe) == lung) ml += millilitres(region.domain->volumeMm3());
  }
  return ml;
}

/// Calls f(i, j, k) for every voxel.
template <class F>
void forEachVoxel(const ImageGeometry& geometry, const F& f) {
  for (int k = 0; k < geometry.size[2]; ++k) {
    for (int j = 0; j < geometry.size[1]; ++j) {
      for (int i = 0; i < geometry.size[0]; ++i) f(i, j, k);
    }
  }
}

/// Of a label with the airways inside that lung, ml.
double pleuraMl(const SampleCt& ct, Side lung) {
  double ml = labelMl(ct.truth, lung == Side::Right ? Lobe::RightLung : Lobe::LeftLung);
  forEachVoxel(ct.truth.geometry, [&](int i, int j, int k) {
    if (ct.truth.at(i, j, k) != Airways) return;
    if (inLung(lung, ct.truth.geometry.worldFromVoxel(Vec3(i, j, k)))) {
      ml += millilitres(ct.truth.geometry.voxelMm3());
    }
  });
  return ml;
}

double meanHu(const SampleCt& ct, std::uint8_t label) {
  double sum = 0.0;
  double n = 0.0;
  for (std::size_t v = 0; v < ct.truth.voxels.size(); ++v) {
    if (ct.truth.voxels[v] != label) continue;
    sum += ct.image.voxels[v];
    n += 1.0;
  }
  return sum / n;
}

std::int16_t huAt(const SampleCt& ct, const Vec3& p) {
  const Vec3 voxel = ct.image.geometry.voxelFromWorld(p);
  return ct.image.at(static_cast<int>(std::lround(voxel.x())),
                     static_cast<int>(std::lround(voxel.y())),
                     static_cast<int>(std::lround(voxel.z())));
}

TEST(SampleCt, LabelsHaveTheVolumesOfTheFormulas) {
  for (const Side lung : {Side::Right, Side::Left}) {
    const double wanted = formulaMl(lung);
    EXPECT_NEAR(pleuraMl(plain(), lung), wanted, 0.005 * wanted) << name(lung);
  }
}

TEST(SampleCt, LabelsSayWhichVoxelsLieInThePleura) {
  const LabelImage& truth = plain().truth;
  std::size_t wrong = 0;
  forEachVoxel(truth.geometry, [&](int i, int j, int k) {
    const std::uint8_t label = truth.at(i, j, k);
    if (label == Airways || (i + j + k) % 7 != 0) return;
    const Vec3 p = truth.geometry.worldFromVoxel(Vec3(i, j, k));
    const std::uint8_t wanted = inLung(Side::Right, p) ? Right : inLung(Side::Left, p) ? Left : 0;
    if (label != wanted) ++wrong;
  });
  EXPECT_EQ(wrong, 0U);
}

TEST(SampleCt, LooksLikeAChest) {
  EXPECT_NEAR(meanHu(plain(), Right), -845.0, 25.0);
  EXPECT_NEAR(meanHu(plain(), Left), -845.0, 25.0);
  EXPECT_EQ(huAt(plain(), {-200.0, -180.0, 0.0}), PaddingHu);
  EXPECT_EQ(huAt(plain(), {0.0, -160.0, 0.0}), -1000);
  EXPECT_NEAR(huAt(plain(), {0.0, -45.0, -80.0}), 42, 3);     // heart
  EXPECT_NEAR(huAt(plain(), {-80.0, -20.0, -140.0}), 58, 3);  // liver
  EXPECT_NEAR(huAt(plain(), {0.0, 77.0, -12.0}), 220, 10);    // vertebra
  const auto bone = std::ranges::count_if(plain().image.voxels, [](int hu) { return hu > 300; });
  EXPECT_GT(static_cast<double>(bone) * plain().image.geometry.voxelMm3(), 250e3);
}

TEST(SampleCt, FissuresAreThinSheets) {
  for (const SampleFissure& fissure : testing::chest().fissures) {
    std::vector<int> on;
    std::vector<int> beside;
    for (const Vec3& p : fissure.points) {
      const Vec3 off(0.0, 0.0, 6.0 * fissure.steepness(p.x(), p.y()));
      on.push_back(huAt(plain(), p));
      beside.push_back(huAt(plain(), p + off));
      beside.push_back(huAt(plain(), p - off));
    }
    const auto middle = [](std::vector<int> values) {
      std::ranges::nth_element(values, values.begin() + std::ssize(values) / 2);
      return values[values.size() / 2];
    };
    // 0.6 mm of tissue in voxels of 2.5 x 2.5 x 3 mm.
    EXPECT_GT(middle(on), middle(beside) + 100) << fissure.name;
    EXPECT_LT(middle(on), middle(beside) + 250) << fissure.name;
    EXPECT_NEAR(middle(beside), -868, 20) << fissure.name;
  }
}

TEST(SampleCt, AirwaysOfTheTreeAreLumen) {
  EXPECT_EQ(plain().central.size(), testing::chest().central.size());
  EXPECT_GT(plain().airways.size(), 60U);
  for (std::size_t b = 0; b < plain().central.size(); ++b) {
    const Branch& branch = plain().airways[b];
    EXPECT_EQ(branch.distal, plain().central[b].distal);
    const Vec3 middle = (branch.proximal + branch.distal) / 2.0;
    EXPECT_LT(huAt(plain(), middle), -750) << b;
  }
  EXPECT_LT(huAt(plain(), {0.0, 0.0, 60.0}), -975);
  EXPECT_GT(labelMl(plain().truth, Lobe::Central), 50.0);
}

TEST(SampleCt, TheSameSeedGivesTheSameBytesForAnyNumberOfThreads) {
  SampleCtOptions options = coarse();
  options.spacingMm = 4.0;
  options.thickMm = 6.0;
  options.noiseHu = 20.0;
  const auto made = [&](unsigned threads) {
    const ThreadLimit limit(threads);
    return sampleCt(testing::chest(), options);
  };
  const SampleCt one = made(1);
  const SampleCt two = made(2);
  EXPECT_EQ(one.image.voxels, two.image.voxels);
  EXPECT_EQ(one.truth.voxels, two.truth.voxels);
  options.seed = 2;
  const SampleCt other = made(2);
  EXPECT_NE(one.image.voxels, other.image.voxels);
  EXPECT_NE(one.airways[one.airways.size() - 1].distal,
            other.airways[other.airways.size() - 1].distal);
}

TEST(SampleCt, TiltedSlicesLeanAndShowTheSameChest) {
  SampleCtOptions options = coarse();
  options.tiltDeg = 15.0;
  const SampleCt ct = sampleCt(testing::chest(), options);
  const ImageGeometry& geometry = ct.image.geometry;
  const Vec3 normal = geometry.direction.col(0).cross(geometry.direction.col(1));
  EXPECT_NEAR(degrees(angleBetween(normal, geometry.direction.col(2))), 15.0, 1e-9);
  EXPECT_EQ(geometry.direction.col(2), Vec3::UnitZ());
  EXPECT_EQ(geometry.spacing.z(), 3.0);
  for (const Side lung : {Side::Right, Side::Left}) {
    const double wanted = formulaMl(lung);
    EXPECT_NEAR(pleuraMl(ct, lung), wanted, 0.005 * wanted);
  }
  EXPECT_LT(huAt(ct, {0.0, 0.0, 60.0}), -975);
}

TEST(SampleCt, TheMirrorSwapsAnatomyAndKeepsTheHeader) {
  SampleCtOptions options = coarse();
  options.mirror = true;
  const SampleCt ct = sampleCt(testing::chest(), options);
  EXPECT_EQ(ct.image.geometry, plain().image.geometry);
  std::size_t wrong = 0;
  const int last = ct.image.geometry.size[0] - 1;
  forEachVoxel(ct.image.geometry, [&](int i, int j, int k) {
    if (std::abs(ct.image.at(i, j, k) - plain().image.at(last - i, j, k)) > 1) ++wrong;
    const std::uint8_t label = plain().truth.at(last - i, j, k);
    const std::uint8_t wanted = label == Right ? Left : label == Left ? Right : label;
    if (ct.truth.at(i, j, k) != wanted) ++wrong;
  });
  EXPECT_LT(wrong, 20U);  // rounding at walls
  EXPECT_EQ(ct.central[1].distal.x(), -plain().central[1].distal.x());
  EXPECT_NEAR(huAt(ct, {80.0, -20.0, -140.0}), 58, 3);  // the liver
}

TEST(SampleCt, TheMirroredChestKeepsItsSurfacesOutward) {
  const SampleChest turned = mirrored(testing::chest());
  for (std::size_t i = 0; i < 5; ++i) {
    EXPECT_NEAR(signedVolumeMm3(*turned.lobes[i].mesh),
                signedVolumeMm3(*testing::chest().lobes[i].mesh), 1.0);
  }
  EXPECT_EQ(turned.lobes[0].mesh->points[0].x(), -testing::chest().lobes[0].mesh->points[0].x());
}

TEST(SampleCt, ACollapsedLungIsDenseBelowAndTheTruthStays) {
  SampleCtOptions options = coarse();
  options.collapsed = true;
  const SampleCt ct = sampleCt(testing::chest(), options);
  EXPECT_EQ(ct.truth.voxels, plain().truth.voxels);
  EXPECT_EQ(meanHu(ct, Right), meanHu(plain(), Right));
  EXPECT_GT(meanHu(ct, Left), meanHu(plain(), Left) + 100.0);
  EXPECT_GT(huAt(ct, {90.0, 80.0, -90.0}), 0);
  EXPECT_LT(huAt(ct, {60.0, 0.0, 40.0}), -750);
}

/// Gas outside lungs and airways, below the lungs' middle, ml.
double abdominalGasMl(const SampleCt& ct) {
  double voxels = 0.0;
  const ImageGeometry& geometry = ct.image.geometry;
  forEachVoxel(geometry, [&](int i, int j, int k) {
    const Vec3 p = geometry.worldFromVoxel(Vec3(i, j, k));
    if (std::abs(p.y() + 25.0) > 60.0 || p.x() < 25.0 || p.x() > 142.0 || p.z() > -80.0) return;
    if (ct.truth.at(i, j, k) == 0 && ct.image.at(i, j, k) < -900) voxels += 1.0;
  });
  return millilitres(voxels * geometry.voxelMm3());
}

TEST(SampleCt, StomachGasLiesUnderASheetOfTheLeftDome) {
  SampleCtOptions options = coarse();
  options.stomachGas = true;
  const SampleCt ct = sampleCt(testing::chest(), options);
  EXPECT_EQ(ct.truth.voxels, plain().truth.voxels);
  EXPECT_GT(abdominalGasMl(ct), 120.0);
  EXPECT_LT(abdominalGasMl(plain()), 25.0);
  EXPECT_GT(abdominalGasMl(plain()), 5.0);
  // Straight down through the dome no voxel is as dense as tissue.
  std::int16_t densest = -1024;
  for (double z = -90.0; z > -120.0; z -= 0.5) {
    densest = std::max(densest, huAt(ct, {100.0, -22.0, z}));
  }
  EXPECT_LT(densest, -500);
}

/// Voxels of the right lung directly beside one of the left.
int touchingVoxels(const LabelImage& truth) {
  int touching = 0;
  forEachVoxel(truth.geometry, [&](int i, int j, int k) {
    if (i == 0) return;
    if (truth.at(i - 1, j, k) == Right && truth.at(i, j, k) == Left) ++touching;
  });
  return touching;
}

TEST(SampleCt, TouchingLungsArePartedByLessThanAVoxel) {
  EXPECT_EQ(touchingVoxels(plain().truth), 0);
  SampleCtOptions options = coarse();
  options.touchingLungsMm = 10.0;
  const SampleCt ct = sampleCt(testing::chest(), options);
  const double mm2 = touchingVoxels(ct.truth) * 2.5 * 3.0;
  EXPECT_NEAR(mm2, 10.0 * 56.0 + 7.0 * 30.0, 200.0);
  EXPECT_LT(huAt(ct, {0.0, 30.5, 70.0}), -700);
}

TEST(SampleCt, GapsAreInsideAndApart) {
  SampleCtOptions options = coarse();
  options.spacingMm = 5.0;
  options.thickMm = 5.0;
  options.gaps = 4;
  const SampleCt ct = sampleCt(testing::chest(), options);
  ASSERT_EQ(ct.missing.size(), 4U);
  EXPECT_GT(ct.missing.front(), 1);
  EXPECT_LT(ct.missing.back(), ct.image.geometry.size[2] - 2);
  for (std::size_t i = 1; i < 4; ++i) EXPECT_GT(ct.missing[i], ct.missing[i - 1] + 2);
  EXPECT_TRUE(plain().missing.empty());
}

TEST(SampleCt, RefusesOptionsOutOfRangeAndStopsOnRequest) {
  SampleCtOptions options = coarse();
  options.tiltDeg = 45.0;
  try {
    sampleCt(testing::chest(), options);
    FAIL() << "a tilt of 45 degrees was taken";
  } catch (const InvalidOption& error) {
    EXPECT_THAT(error.what(), HasSubstr("tilt"));
  }
  testing::ProgressRecorder recorder(0.5);
  EXPECT_THROW(sampleCt(testing::chest(), coarse(), Progress(recorder)), Cancelled);
  EXPECT_TRUE(std::ranges::is_sorted(recorder.fractions()));
}

}  // namespace
}  // namespace pneuma
