#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/error.h"
#include "geometry/mesh_topology.h"
#include "io/temp_folder.h"
#include "io/tree_file.h"
#include "io/volume_file.h"
#include "pipeline/ct_model.h"
#include "pipeline/run_recipe.h"
#include "pipeline/split_lobes.h"
#include "segmentation/label_agreement.h"
#include "support/stop_watch_sink.h"

// Lungs and airways of real people, from PNEUMA_TEST_DATA.
namespace pneuma {
namespace {

std::filesystem::path dataPath(const std::string& name) {
  const char* folder = std::getenv("PNEUMA_TEST_DATA");
  return folder == nullptr || *folder == '\0' ? std::filesystem::path()
                                              : std::filesystem::path(folder) / name;
}

#define NEED_DATA(path) \
  if ((path).empty()) GTEST_SKIP() << "PNEUMA_TEST_DATA is not set"

void expectGood(const LungSegmentation& lungs, double rightMl, double leftMl, double share) {
  EXPECT_NEAR(lungs.right.volumeMl / rightMl, 1.0, share);
  EXPECT_NEAR(lungs.left.volumeMl / leftMl, 1.0, share);
  EXPECT_TRUE(lungs.separated);
  EXPECT_EQ(lungs.gasRemovedMl, 0.0);
  EXPECT_GE(lungs.hands.votes(), -1);
  ASSERT_TRUE(lungs.names.carina);
  EXPECT_TRUE(lungs.names.rightMain);
  EXPECT_TRUE(lungs.names.leftMain);
  EXPECT_GE(lungs.names.lobarCount(), 4);
  EXPECT_LE(lungs.airways.largestStepMl, 5.0);
}

TEST(RealCt, LungsOfLidc0001) {
  const auto path = dataPath("ct_lidc_idri_0001/lidc_idri_0001.mha");
  NEED_DATA(path);
  const LungModel model = withSurfaces(withLungs(openCt(path)));
  expectGood(*model.lungs, 1966.0, 1745.0, 0.03);
  // Surfaces: volume within 0.2 % of the voxels', closed, manifold.
  for (const LobeSurface& surface : *model.surfaces) {
    const MeshTopology health = topology(*surface.mesh);
    EXPECT_EQ(health.openEdges + health.nonManifoldEdges + health.nonManifoldVertices, 0U);
    const double voxels = labelVolumeMm3(*model.labels, static_cast<std::uint8_t>(surface.lobe));
    EXPECT_NEAR(signedVolumeMm3(*surface.mesh) / voxels, 1.0, 0.002);
  }
}

TEST(RealCt, FindingLungsInLidc0002CanBeStoppedAtAnyMoment) {
  const auto path = dataPath("ct_lidc_idri_0002_lungs/lidc_idri_0002_lungs.mha");
  NEED_DATA(path);
  testing::StopWatchSink watch;
  const Progress progress(watch);
  withSurfaces(withLungs(openCt(path, {}, progress), {}, progress), {}, progress);
  EXPECT_LT(watch.longestSeconds(), 0.5);
}

TEST(RealCt, FissuresOfLidc0002AreFoundFromTheProposal) {
  const auto path = dataPath("ct_lidc_idri_0002_lungs/lidc_idri_0002_lungs.mha");
  NEED_DATA(path);
  const LungModel model = withSurfaces(withLungs(openCt(path)));
  LobeInputs inputs;
  const LobesOfLungs proposed = splitLobes(model, inputs);
  inputs.snap = SnapOptions{};
  testing::StopWatchSink watch;
  for (const Side side : {Side::Right, Side::Left}) {
    fissureSheets(model, side, Progress(watch));
    Progress(watch).throwIfStopped();  // the last look
  }
  EXPECT_LT(watch.longestSeconds(), 0.2);
  const LobesOfLungs snapped = splitLobes(model, inputs);
  const std::map<Fissure, double> least = {{Fissure::RightOblique, 0.65},
                                           {Fissure::RightHorizontal, 0.35},
                                           {Fissure::LeftOblique, 0.65}};
  for (const auto& [fissure, share] : least) {
    EXPECT_GE(snapped.complete.at(fissure).share, share) << shortName(fissure);
    EXPECT_LE(proposed.complete.at(fissure).share, 0.5 * share) << shortName(fissure);
  }
  for (const SplitLung& lung : snapped.lungs) EXPECT_LT(partitionError(snapped, lung.side), 1e-12);
}

TEST(RealCt, FissuresOfLidc0001AreNotLookedFor) {
  const auto path = dataPath("ct_lidc_idri_0001/lidc_idri_0001.mha");
  NEED_DATA(path);
  EXPECT_THROW(requireThinSlices(*openCt(path).ct), Unsupported);
}

TEST(RealCt, LungsOfLungDxA0001) {
  const auto path = dataPath("ct_lung_dx_a0001_dicom/series");
  NEED_DATA(path);
  expectGood(*withLungs(openCt(path)).lungs, 3169.0, 2279.0, 0.04);
}

TEST(RealCt, LungDxA0001GoesFromCtToTreeThoughItsAirwaysEndBeforeThreeLobes) {
  const auto path = dataPath("ct_lung_dx_a0001_dicom/series");
  NEED_DATA(path);
  const testing::TempFolder folder;
  Recipe recipe;
  recipe.ct = path;
  RunOptions options;
  options.folder = folder / "case";
  const std::vector<StageResult> results = runRecipe(recipe, options);
  const auto airways = std::ranges::find(results, Stage::Airways, &StageResult::stage);
  ASSERT_NE(airways, results.end());
  EXPECT_EQ(airways->state, StageState::Done);
  EXPECT_THAT(airways->warnings, ::testing::Contains(::testing::HasSubstr(
                                     "right upper lobe, right middle lobe and left upper lobe")));
  const AirwayTree tree = readTree(options.folder / run_files::Tree).tree;
  for (const Lobe lobe : FiveLobes) {
    EXPECT_GT(std::ranges::count(tree, lobe, &Branch::lobe), 1000) << longName(lobe);
  }
}

TEST(RealCt, LungsOfCip64AgreeWithItsLabels) {
  const auto path = dataPath("ct_cip64/ct-64.nrrd");
  NEED_DATA(path);
  const LungModel model = withLungs(openCt(path));
  // Its labels: region + 256 * type; regions 9 to 11 are thirds of the left lung, 12 to 14 of the
  // right one. Type 2 is airway, which Pneuma labels by itself.
  const CtImage raw = readHuVolume(dataPath("ct_cip64/lm-64.nrrd"));
  LabelImage truth{raw.geometry, {}};
  for (const std::int16_t value : raw.voxels) {
    const int region = value & 255;
    truth.voxels.push_back(region >= 12 && region <= 14  ? 10
                           : region >= 9 && region <= 11 ? 20
                                                         : 0);
  }
  LabelImage found = *model.labels;
  found.geometry = truth.geometry;  // the same grid; its origin is rounded in the files
  for (const std::uint8_t lung : {10, 20}) {
    const LabelAgreement same = agreement(truth, found, lung);
    EXPECT_GE(same.dice, 0.97) << int{lung};
    EXPECT_LE(std::abs(same.volumeDifference()), 0.02) << int{lung};
  }
  EXPECT_GE(agreement(truth, found, std::vector<std::uint8_t>{10, 20}).dice, 0.975);
}

}  // namespace
}  // namespace pneuma
