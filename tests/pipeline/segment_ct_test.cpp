#include <algorithm>
#include <string>

#include <gtest/gtest.h>

#include "core/parallel.h"
#include "pipeline/orientation_check.h"
#include "pipeline/sample_ct.h"
#include "segmentation/label_agreement.h"
#include "segmentation/label_surface.h"
#include "segmentation/lung_segmentation.h"
#include "support/chest_once.h"
#include "support/stop_watch_sink.h"

// Lungs and airways found in CTs of the sample chest, whose truth is known.
namespace pneuma {
namespace {

struct Case {
  std::string name;
  SampleCtOptions options;
};

void PrintTo(const Case& c, std::ostream* out) { *out << c.name; }

/// A CT of the size of hospitals' would cost a minute here; these keep the slices and coarsen them.
SampleCtOptions usual() {
  SampleCtOptions options;
  options.spacingMm = 1.2;
  return options;
}

template <class Change>
Case with(const std::string& name, const Change& change) {
  Case c{name, usual()};
  change(c.options);
  return c;
}

bool failed(const LungSegmentation& found, const std::string& check) {
  return std::any_of(found.checks.begin(), found.checks.end(), [&](const SegmentationCheck& c) {
    return c.id.find(check) != std::string::npos && !c.ok();
  });
}

class SegmentSample : public ::testing::TestWithParam<Case> {};

TEST_P(SegmentSample, AgreesWithTheTruth) {
  const SampleCtOptions& options = GetParam().options;
  const SampleCt sample = sampleCt(testing::chest(), options);
  const LungSegmentation found = segmentLungs(sample.image);
  const double volumeLimit = options.thickMm <= 2.5 ? 0.01 : 0.03;
  for (const Lobe lung : {Lobe::RightLung, Lobe::LeftLung}) {
    const LabelAgreement same =
        agreement(sample.truth, found.labels, static_cast<std::uint8_t>(lung));
    EXPECT_GE(same.dice, 0.985) << shortName(lung);
    EXPECT_LE(std::abs(same.volumeDifference()), volumeLimit)
        << shortName(lung) << ": " << same.firstMl << " ml, found " << same.secondMl;
  }
  ASSERT_TRUE(found.airways.found);
  ASSERT_TRUE(found.names.carina);
  const Vec3 carina = sample.central[0].distal;
  EXPECT_LE((*found.names.carina - carina).norm(), std::max(5.0, 1.5 * options.thickMm))
      << "found at " << found.names.carina->transpose() << ", is at " << carina.transpose();
  EXPECT_TRUE(found.names.rightMain);
  EXPECT_TRUE(found.names.leftMain);
  EXPECT_LE(found.airways.largestStepMl, 5.0);
  EXPECT_TRUE(found.separated);
}

INSTANTIATE_TEST_SUITE_P(
    , SegmentSample,
    ::testing::Values(with("Seed1", [](auto& o) { o.seed = 1; }),
                      with("Seed2", [](auto& o) { o.seed = 2; }),
                      with("Seed3", [](auto& o) { o.seed = 3; }),
                      with("Seed4", [](auto& o) { o.seed = 4; }),
                      with("Seed5", [](auto& o) { o.seed = 5; }),
                      with("Tilted", [](auto& o) { o.tiltDeg = 12.0; }),
                      with("Thin", [](auto& o) { o.thickMm = 1.25; }),
                      with("Thick5", [](auto& o) { o.thickMm = 5.0; }),
                      with("Thick8", [](auto& o) { o.thickMm = 8.0; }),
                      with("Noisy", [](auto& o) { o.noiseHu = 60.0; }),
                      with("NoNoise", [](auto& o) { o.noiseHu = 0.0; }),
                      with("Touching4", [](auto& o) { o.touchingLungsMm = 4.0; }),
                      with("Touching12", [](auto& o) { o.touchingLungsMm = 12.0; }),
                      with("StomachGas", [](auto& o) { o.stomachGas = true; })),
    [](const auto& test) { return test.param.name; });

TEST(SegmentedSample, TakesTheGasOfTheStomachOutAndSaysSo) {
  SampleCtOptions options = usual();
  options.stomachGas = true;
  const SampleCt sample = sampleCt(testing::chest(), options);
  EXPECT_GT(segmentLungs(sample.image).gasRemovedMl, 20.0);
  LungOptions keep;
  keep.gas = GasPockets::Keep;
  EXPECT_EQ(segmentLungs(sample.image, keep).gasRemovedMl, 0.0);
}

TEST(SegmentedSample, FlagsACollapsedLung) {
  SampleCtOptions options = usual();
  options.collapsed = true;
  const LungSegmentation found = segmentLungs(sampleCt(testing::chest(), options).image);
  EXPECT_TRUE(failed(found, "LUNG-L-DENSE") || failed(found, "LUNG-L-VOLUME") ||
              failed(found, "LUNG-RATIO"));
  EXPECT_FALSE(failed(segmentLungs(sampleCt(testing::chest(), usual()).image), "LUNG"));
}

TEST(OrientationOfACt, IsNotToldWithoutLungs) {
  CtImage water;
  water.geometry.size = {60, 60, 60};
  water.geometry.spacing = {5.0, 5.0, 5.0};
  water.voxels.assign(water.geometry.voxelCount(), 0);
  const OrientationCheck check = checkOrientation(water);
  EXPECT_FALSE(check.hands);
  EXPECT_FALSE(check.maybeSwapped());
  EXPECT_NE(check.sentence.find("no lungs"), std::string::npos) << check.sentence;
}

/// A sample at 2 mm: fast, lobar bronchi still there.
SampleCt coarseSample() {
  SampleCtOptions options;
  options.spacingMm = 1.5;
  options.thickMm = 2.5;
  return sampleCt(testing::chest(), options);
}

/// Sets the density of what is airway in the truth, where `wanted(i, j, k)` holds.
template <class Wanted>
void fillAirways(SampleCt& sample, std::int16_t hu, const Wanted& wanted) {
  const auto [width, height, depth] = sample.image.geometry.size;
  for (int k = 0; k < depth; ++k) {
    for (int j = 0; j < height; ++j) {
      for (int i = 0; i < width; ++i) {
        if (sample.truth.at(i, j, k) == 6 && wanted(i, j, k)) sample.image.at(i, j, k) = hu;
      }
    }
  }
}

/// Slices in which the truth has airways: the highest.
int highestAirway(const SampleCt& sample) {
  int k = sample.image.geometry.size[2] - 1;
  const std::size_t slice = sample.image.geometry.sliceCount();
  const auto& voxels = sample.truth.voxels;
  for (; k > 0; --k) {
    const auto first = voxels.begin() + static_cast<std::ptrdiff_t>(slice) * k;
    if (std::find(first, first + static_cast<std::ptrdiff_t>(slice), 6) !=
        first + static_cast<std::ptrdiff_t>(slice))
      break;
  }
  return k;
}

TEST(SegmentedSample, FollowsTheAirwaysWhateverTheTracheasTopSlicesHold) {
  SampleCt sample = coarseSample();
  const LungSegmentation plain = segmentLungs(sample.image);
  ASSERT_TRUE(plain.names.carina);
  ASSERT_GT(plain.airways.stepsFollowed, 10U);
  EXPECT_EQ(plain.central[0].distal, *plain.names.carina) << "something forks above the carina";
  const int top = highestAirway(sample);
  fillAirways(sample, -700, [&](int, int, int k) { return k > top - 3; });  // a larynx' slime
  const LungSegmentation dense = segmentLungs(sample.image);
  ASSERT_TRUE(dense.names.carina);
  EXPECT_LT((*dense.names.carina - *plain.names.carina).norm(), 3.0);
  EXPECT_EQ(dense.names.lobarCount(), plain.names.lobarCount());
  EXPECT_NEAR(dense.airways.volumeMl / plain.airways.volumeMl, 1.0, 0.1);
}

TEST(SegmentedSample, SaysWhereNoTracheaIs) {
  SampleCt sample = coarseSample();
  fillAirways(sample, 30, [](int, int, int) { return true; });
  const LungSegmentation found = segmentLungs(sample.image);
  EXPECT_FALSE(found.airways.found);
  EXPECT_TRUE(found.central.empty());
  EXPECT_TRUE(failed(found, "AIRWAY-TRACHEA"));
  EXPECT_GE(agreement(sample.truth, found.labels, 10).dice, 0.98);
}

TEST(SegmentedSample, FindsALungThatIsAlone) {
  SampleCt sample = coarseSample();
  for (std::size_t v = 0; v < sample.truth.voxels.size(); ++v) {
    if (sample.truth.voxels[v] == 20) sample.image.voxels[v] = 30;
  }
  const LungSegmentation found = segmentLungs(sample.image);
  EXPECT_GE(agreement(sample.truth, found.labels, 10).dice, 0.98);
  EXPECT_LT(found.left.volumeMl, 50.0);
  EXPECT_TRUE(failed(found, "LUNG-L-VOLUME"));
}

TEST(SegmentedSample, SaysThatAPartOfALungHangsTogetherWithNeither) {
  SampleCt sample = coarseSample();
  const LungSegmentation whole = segmentLungs(sample.image);
  EXPECT_LT(whole.airElsewhereMl, 5.0);
  // The foam of the table is one space at such a threshold, and no part of a lung.
  EXPECT_LT(segmentLungs(sample.image, {.thresholdHu = -750.0}).airElsewhereMl, 20.0);
  // A band of fluid cuts the right lung's apex off.
  const auto [width, height, depth] = sample.image.geometry.size;
  const int cut = 3 * depth / 4;
  for (int k = cut; k < cut + 14; ++k) {
    for (int j = 0; j < height; ++j) {
      for (int i = 0; i < width; ++i) {
        if (sample.truth.at(i, j, k) == 10) sample.image.at(i, j, k) = 20;
      }
    }
  }
  const LungSegmentation found = segmentLungs(sample.image);
  EXPECT_GT(found.airElsewhereMl, 50.0);
  EXPECT_TRUE(failed(found, "LUNG-PARTED"));
}

TEST(SegmentedSample, CanBeStoppedAtAnyMoment) {
  const SampleCt sample = sampleCt(testing::chest(), usual());
  testing::StopWatchSink watch;
  const LungSegmentation found = segmentLungs(sample.image, {}, Progress(watch));
  labelSurface(found.labels, static_cast<std::uint8_t>(Lobe::RightLung), {}, Progress(watch));
  EXPECT_LT(watch.longestSeconds(), 0.2);  // hospitals' CTs have twice as many voxels
}

TEST(SegmentedSample, WarnsOfSwappedSidesAndChangesNothing) {
  SampleCtOptions options = usual();
  options.mirror = true;
  const SampleCt sample = sampleCt(testing::chest(), options);
  const LungSegmentation found = segmentLungs(sample.image);
  EXPECT_TRUE(failed(found, "HANDEDNESS")) << found.hands.votes();
  EXPECT_GE(agreement(sample.truth, found.labels, 10).dice, 0.985);
  EXPECT_GE(agreement(sample.truth, found.labels, 20).dice, 0.985);
  EXPECT_TRUE(checkOrientation(sample.image).maybeSwapped());
  EXPECT_FALSE(checkOrientation(sampleCt(testing::chest(), usual()).image).maybeSwapped());
  EXPECT_FALSE(failed(segmentLungs(sampleCt(testing::chest(), usual()).image), "HANDEDNESS"));
}

TEST(SegmentedSample, IsTheSameForAnyOrderOfTheAxesAndAnyNumberOfThreads) {
  SampleCtOptions options = usual();
  options.spacingMm = 2.0;
  options.thickMm = 4.0;
  const CtImage image = sampleCt(testing::chest(), options).image;
  const LungSegmentation found = segmentLungs(image);
  const AxisOrder order{{2, 0, 1}, {true, false, true}};
  const LungSegmentation other = segmentLungs(turned(image, order));
  EXPECT_EQ(turned(other.labels, inverse(order)).voxels, found.labels.voxels);
  const ThreadLimit one(1);
  const LungSegmentation alone = segmentLungs(image);
  EXPECT_EQ(alone.labels.voxels, found.labels.voxels);
  ASSERT_EQ(alone.central.size(), found.central.size());
  for (std::size_t b = 0; b < found.central.size(); ++b) {
    EXPECT_EQ(alone.central[b].distal, found.central[b].distal);
    EXPECT_EQ(alone.central[b].radiusMm, found.central[b].radiusMm);
  }
  EXPECT_EQ(alone.right.denseShare, found.right.denseShare);
  EXPECT_EQ(alone.left.meanHu, found.left.meanHu);
}

TEST(SegmentLungs, RefusesWhatHoldsNoLungs) {
  CtImage water;
  water.geometry.size = {64, 64, 32};
  water.geometry.spacing = {4.0, 4.0, 5.0};
  water.voxels.assign(water.geometry.voxelCount(), 0);
  EXPECT_THROW(segmentLungs(water), InvalidInput);
}

}  // namespace
}  // namespace pneuma
