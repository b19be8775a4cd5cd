#include "pipeline/compare_methods.h"

#include <algorithm>
#include <mutex>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/error.h"
#include "growth/centroid_splitting.h"
#include "growth/dla.h"
#include "growth/kitaoka.h"
#include "io/temp_folder.h"
#include "io/tree_file.h"
#include "pipeline/organs.h"
#include "pipeline/report.h"
#include "support/progress_recorder.h"

namespace pneuma {
namespace {

using ::testing::HasSubstr;

std::vector<GrowthOptions> smallTrees() {
  KitaokaOptions kitaoka;
  kitaoka.terminals = 150;
  CentroidSplittingOptions centroid;
  centroid.terminals = 200;
  DlaOptions dla;
  dla.particles = 3000;
  return {kitaoka, centroid, dla};
}

/// Every name of a step once, in their order.
class Names : public ProgressSink {
 public:
  void report(double /*fraction*/, std::string_view what) override {
    const std::lock_guard lock(mutex_);
    if (names.empty() || names.back() != what) names.emplace_back(what);
  }

  bool stopRequested() const override { return false; }

  std::vector<std::string> names;

 private:
  std::mutex mutex_;
};

TEST(CompareMethods, GrowsEachAsItGrowsAlone) {
  const LungModel organ = openOrgan("sphere");
  const std::vector<GrowthOptions> methods = smallTrees();
  const MethodComparison comparison = compareMethods(organ, methods);
  ASSERT_EQ(comparison.growths.size(), 3U);
  EXPECT_EQ(comparison.organ.growth, nullptr);
  for (std::size_t i = 0; i < methods.size(); ++i) {
    const LungModel alone = grow(organ, methods[i]);
    const AirwayTree& tree = comparison.growths[i]->result.tree;
    ASSERT_EQ(tree.size(), alone.growth->result.tree.size());
    for (std::size_t n = 0; n < tree.size(); ++n) {
      ASSERT_EQ(tree[n].distal, alone.growth->result.tree[n].distal);
    }
    EXPECT_TRUE(comparison.growths[i]->options == methods[i]);
    EXPECT_EQ(comparison.measured.trees[i].opened.tree.get(), &tree);
  }
}

TEST(CompareMethods, MeasuresWhatTheFilesOfTheTreesGive) {
  const testing::TempFolder folder;
  const LungModel organ = openOrgan("sphere");
  const MethodComparison comparison = compareMethods(organ, smallTrees());
  std::vector<std::filesystem::path> paths;
  for (std::size_t i = 0; i < comparison.growths.size(); ++i) {
    const LungModel grown = withGrowthOf(organ, comparison, i);
    paths.push_back(folder.path() / (comparison.measured.trees[i].opened.label + ".vtp"));
    writeTree(paths.back(), *treeOf(grown), treeMetadata(grown));
  }
  const TreeComparison read = compareTrees(openTrees(paths), organ);
  EXPECT_EQ(compareCsv(comparison.measured), compareCsv(read));
  EXPECT_EQ(compareText(comparison.measured), compareText(read));
}

TEST(CompareMethods, AKeptTreeLeavesTheRestOfTheModel) {
  LungModel organ = openOrgan("sphere");
  const MethodComparison comparison = compareMethods(organ, smallTrees());
  organ.warnings = {"said since"};
  const LungModel kept = withGrowthOf(organ, comparison, 1);
  EXPECT_EQ(kept.growth, comparison.growths[1]);
  EXPECT_EQ(kept.warnings, organ.warnings);
  EXPECT_EQ(kept.organ, "sphere");
}

TEST(CompareMethods, SaysWhichMethodIsAtWork) {
  Names sink;
  compareMethods(openOrgan("sphere"), smallTrees(), Progress(sink));
  const std::string all = ::testing::PrintToString(sink.names);
  EXPECT_THAT(all, HasSubstr("Kitaoka's rules, 1 of 3: growing"));
  EXPECT_THAT(all, HasSubstr("Diffusion-limited aggregation, 3 of 3"));
  EXPECT_THAT(all, HasSubstr("measuring"));
}

TEST(CompareMethods, OnlyRisesTellsNoPointsAndStopsOnRequest) {
  testing::ProgressRecorder recorder;
  compareMethods(openOrgan("sphere"), smallTrees(), Progress(recorder));
  EXPECT_TRUE(std::ranges::is_sorted(recorder.fractions()));
  EXPECT_EQ(recorder.fractions().back(), 1.0);
  EXPECT_TRUE(recorder.points().empty());
  for (const double stopAt : {0.0, 0.1, 0.5, 0.9}) {
    testing::ProgressRecorder stopped(stopAt);
    EXPECT_THROW(compareMethods(openOrgan("sphere"), smallTrees(), Progress(stopped)), Cancelled);
  }
}

TEST(CompareMethods, NeedsLobes) { EXPECT_THROW(compareMethods({}, smallTrees()), InvalidInput); }

TEST(ComparisonRows, TellWhereAFigureLiesByItsBand) {
  const MethodComparison comparison = compareMethods(openOrgan("sphere"), smallTrees());
  const std::vector<ComparisonRow> rows = comparisonRows(comparison.measured);
  const auto terminals = std::ranges::find(rows, "terminals", &ComparisonRow::key);
  ASSERT_NE(terminals, rows.end());
  EXPECT_EQ(terminals->sides, std::vector(3, BandSide::Below));  // of a few hundred by 26,000
  const auto length = std::ranges::find(rows, "length_m", &ComparisonRow::key);
  ASSERT_NE(length, rows.end());
  EXPECT_EQ(length->sides, std::vector(3, BandSide::NoBand));
  double mm = 0.0;
  const AirwayTree& tree = comparison.growths[0]->result.tree;
  for (std::size_t i = 0; i < tree.size(); ++i) mm += lengthMm(tree[i]);
  EXPECT_NEAR(std::stod(length->values[0]), mm / 1000.0, 0.005);
}

}  // namespace
}  // namespace pneuma
