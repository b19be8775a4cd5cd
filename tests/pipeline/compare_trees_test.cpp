#include "pipeline/compare_trees.h"

#include <algorithm>
#include <numbers>
#include <sstream>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/error.h"
#include "core/parallel.h"
#include "io/atomic_file.h"
#include "pipeline/measure_report.h"
#include "support/json_schema.h"
#include "support/progress_recorder.h"
#include "support/sample_trees.h"
#include "support/simple_domains.h"
#include "support/text_lines.h"

namespace pneuma {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::StartsWith;

OpenedTree opened(std::string label, AirwayTree tree, const std::string& method = "") {
  OpenedTree result;
  result.label = std::move(label);
  result.input = {result.label + ".vtp", std::string(64, '0')};
  result.format = "VTP";
  if (!method.empty()) result.metadata["method"] = method;
  result.tree = std::make_shared<const AirwayTree>(std::move(tree));
  return result;
}

/// 31 branches, each 10 mm long and 2 mm wide: 16 terminals in generation 4, 50 mm from the root.
AirwayTree wideTree() { return testing::SymmetricTree{.generations = 5, .angleDeg = 35.0}.tree(); }

/// 15 branches, each 6 mm long and 2 mm wide: 8 terminals in generation 3, 24 mm from the root.
AirwayTree narrowTree() {
  return testing::SymmetricTree{
      .generations = 4,
      .lengthMm = [](int) { return 6.0; },
      .angleDeg = 20.0,
      .lobe = Lobe::RightUpper,
  }
      .tree();
}

AirwayTree singleBranch() {
  AirwayTree tree;
  testing::addBranch(tree, -1, Vec3(0, 0, -12), 2.0);
  return tree;
}

/// The wide tree, the narrow one and the single branch.
std::vector<OpenedTree> threeTrees() {
  return {opened("wide", wideTree(), "kitaoka"), opened("narrow", narrowTree()),
          opened("one", singleBranch())};
}

/// Two balls that hold the wide and the narrow tree, one inside the other.
LungModel balls() {
  LungModel organ;
  organ.regions = std::make_shared<const std::vector<LobeRegion>>(std::vector<LobeRegion>{
      {Lobe::Whole, testing::ball(60.0)}, {Lobe::RightUpper, testing::ball(40.0)}});
  return organ;
}

/// The cells of a line of the text: two blanks or more stand between them.
std::vector<std::string> cells(const std::string& line) {
  std::vector<std::string> result;
  for (std::size_t from = 0; from < line.size();) {
    const std::size_t to = std::min(line.find("  ", from), line.size());
    result.push_back(line.substr(from, to - from));
    from = std::min(line.find_first_not_of(' ', to), line.size());
  }
  return result;
}

std::vector<std::string> row(const TreeComparison& comparison, const std::string& start) {
  return cells(testing::lineWith(compareText(comparison), start));
}

TEST(ShortNames, AreStemsWhereTheyDiffer) {
  EXPECT_THAT(shortNames(std::array<std::filesystem::path, 2>{"runs/kitaoka.vtp", "huang.swc"}),
              ElementsAre("kitaoka", "huang"));
}

TEST(ShortNames, TakeExtensionThenFoldersWhereStemsAreEqual) {
  using Paths = std::vector<std::filesystem::path>;
  EXPECT_THAT(shortNames(Paths{"/x/tree.vtp", "/x/tree.swc", "/x/other.vtp"}),
              ElementsAre("tree.vtp", "tree.swc", "other"));
  EXPECT_THAT(shortNames(Paths{"/x/a/tree.vtp", "/x/b/tree.vtp"}), ElementsAre("a/tree", "b/tree"));
  EXPECT_THAT(shortNames(Paths{"/a/x/tree.vtp", "/b/x/tree.vtp"}),
              ElementsAre("a/x/tree", "b/x/tree"));
  EXPECT_THAT(shortNames(Paths{"/a/tree.vtp", "/b/tree.vtp", "/b/tree.swc"}),
              ElementsAre("a/tree.vtp", "b/tree.vtp", "b/tree.swc"));
  EXPECT_THAT(shortNames(Paths{"/tree.vtp", "/b/tree.vtp"}), ElementsAre("tree", "b/tree"));
}

TEST(ShortNames, CountThePathsThatComeAgain) {
  using Paths = std::vector<std::filesystem::path>;
  EXPECT_THAT(shortNames(Paths{"/x/t.vtp", "/x/t.vtp", "/x/y/../t.vtp"}),
              ElementsAre("t", "t (2)", "t (3)"));
}

TEST(CompareTrees, MeasuresEachAsItIsMeasuredAlone) {
  const TreeComparison comparison = compareTrees(threeTrees());
  ASSERT_EQ(comparison.trees.size(), 3U);
  const Morphometry& wide = comparison.trees[0].measured.whole;
  EXPECT_EQ(wide.branches, 31U);
  EXPECT_EQ(wide.terminals, 16U);
  EXPECT_NEAR(wide.branchingAngleDeg.mean, 35.0, 1e-9);
  EXPECT_NEAR(wide.pathLengthMm.mean, 50.0, 1e-9);
  EXPECT_NEAR(wide.deadSpaceMl, 0.31 * std::numbers::pi, 1e-9);
  const Morphometry& narrow = comparison.trees[1].measured.whole;
  EXPECT_EQ(narrow.terminals, 8U);
  EXPECT_NEAR(narrow.branchingAngleDeg.mean, 20.0, 1e-9);
  EXPECT_NEAR(narrow.lengthToDiameter.mean, 3.0, 1e-9);
  EXPECT_NEAR(narrow.strahler.branching.ratio, 2.0, 1e-9);
  EXPECT_EQ(toJson(wide).dump(), toJson(measureTree(wideTree(), {}).whole).dump());
}

TEST(CompareTrees, RegionsGiveGapAndEfficiency) {
  const TreeComparison comparison = compareTrees(threeTrees(), balls(), 7);
  EXPECT_EQ(comparison.seed, 7U);
  for (const ComparedTree& tree : comparison.trees) {
    const TreeMeasurement alone = measureTree(*tree.opened.tree, balls(), 7);
    ASSERT_TRUE(tree.measured.whole.gap.has_value());
    EXPECT_EQ(tree.measured.whole.gap->mean, alone.whole.gap->mean);
    EXPECT_EQ(tree.measured.efficiency->paper.el, alone.efficiency->paper.el);
    EXPECT_EQ(tree.measured.outside->ends, 0U);
  }
  EXPECT_FALSE(compareTrees(threeTrees()).trees[0].measured.efficiency.has_value());
}

TEST(CompareTrees, IsTheSameForAnyNumberOfThreads) {
  const std::string all = compareCsv(compareTrees(threeTrees(), balls()));
  const ThreadLimit one(1);
  EXPECT_EQ(compareCsv(compareTrees(threeTrees(), balls())), all);
}

TEST(CompareTrees, OnlyRisesAndStopsOnRequest) {
  testing::ProgressRecorder recorder;
  compareTrees(threeTrees(), balls(), 1, Progress(recorder));
  EXPECT_TRUE(std::ranges::is_sorted(recorder.fractions()));
  EXPECT_EQ(recorder.fractions().back(), 1.0);
  for (const double stopAt : {0.0, 0.5}) {
    testing::ProgressRecorder stopped(stopAt);
    EXPECT_THROW(compareTrees(threeTrees(), balls(), 1, Progress(stopped)), Cancelled);
  }
}

TEST(CompareTrees, NeedsTwoTreesThatHaveBranches) {
  EXPECT_THROW(compareTrees({}), InvalidOption);
  EXPECT_THROW(compareTrees({opened("wide", wideTree())}), InvalidOption);
  EXPECT_THROW(compareTrees({opened("wide", wideTree()), opened("none", {})}), InvalidInput);
}

TEST(CompareText, HasAColumnForEachTreeThenTheBandAndItsSource) {
  const TreeComparison comparison = compareTrees(threeTrees());
  EXPECT_THAT(row(comparison, "quantity"),
              ElementsAre("quantity", "wide", "narrow", "one", "published", "source"));
  EXPECT_THAT(row(comparison, "method"), ElementsAre("method", "kitaoka", "-", "-"));
  EXPECT_THAT(row(comparison, "branching angle, deg"),
              ElementsAre("branching angle, deg", "35.0 +- 0.0", "20.0 +- 0.0", "-", "37 to 43",
                          "Horsfield, Tawhai (recalled)"));
  EXPECT_THAT(row(comparison, "terminals"),
              ElementsAre("terminals", "16", "8", "1", "26000 to 32000", StartsWith("Kitaoka")));
  EXPECT_THAT(row(comparison, "- largest"), IsEmpty());  // there was no region for the gap
  EXPECT_THAT(row(comparison, "- mother 3-2 mm wide"), IsEmpty());  // no tree has such mothers
}

TEST(CompareText, TellsOfTheRegionsWhereTheyAreKnown) {
  const TreeComparison comparison = compareTrees(threeTrees(), balls());
  EXPECT_THAT(row(comparison, "ends outside their lobe"),
              ElementsAre("ends outside their lobe", "0", "0", "0"));
  EXPECT_EQ(row(comparison, "gap to the nearest terminal").size(), 6U);
  EXPECT_EQ(row(comparison, "PI by the definition").size(), 4U);
}

TEST(CompareText, EqualTreesHaveEqualColumns) {
  const TreeComparison comparison =
      compareTrees({opened("a", wideTree()), opened("a (2)", wideTree())}, balls());
  std::istringstream lines(compareText(comparison));
  std::string line;
  std::getline(lines, line);  // the labels differ
  std::size_t rows = 0;
  while (std::getline(lines, line) && !line.starts_with("Summaries")) {
    const std::vector<std::string> row = cells(line);
    ASSERT_GE(row.size(), 3U) << line;
    EXPECT_EQ(row[1], row[2]) << line;
    ++rows;
  }
  EXPECT_GT(rows, 30U);
}

TEST(CompareCsv, IsMeasuresWithAColumnForEachTree) {
  const TreeComparison comparison = compareTrees(threeTrees());
  const std::string csv = compareCsv(comparison);
  EXPECT_THAT(csv, StartsWith("region,quantity,\"wide\",\"narrow\",\"one\",published_low,"
                              "published_high,source\n"));
  EXPECT_EQ(testing::lineWith(csv, "all,terminals,"),
            "all,terminals,16,8,1,26000,32000,\"Kitaoka 1999: 27,306; Haefeli-Bleuer & Weibel 1988 "
            "(recalled); both lungs\"");
  // The single branch has no daughters, and each tree lies in a lobe of its own or in none.
  EXPECT_THAT(testing::lineWith(csv, "all,branching_angle_deg.mean,"), HasSubstr(",,37,43,"));
  EXPECT_EQ(testing::lineWith(csv, "RUL,terminals,"), "RUL,terminals,,8,,,,");
  EXPECT_EQ(testing::lineWith(csv, "whole,terminals,"), "whole,terminals,16,,1,,,");
}

TEST(CompareCsv, KeepsTheOrderOfTheReportWhateverATreeLacks) {
  const TreeComparison comparison =
      compareTrees({opened("one", singleBranch()), opened("wide", wideTree())});
  const std::string csv = compareCsv(comparison);
  const std::size_t angle = csv.find("all,branching_angle_deg.mean");
  EXPECT_LT(csv.find("all,path_length_mm.max"), angle);
  EXPECT_LT(angle, csv.find("all,dead_space_ml"));
}

class CompareJson : public ::testing::Test {
 protected:
  static std::vector<std::string> faults(const Json& report) {
    const test::JsonSchema schema(
        nlohmann::json::parse(readFile(PNEUMA_SCHEMAS "/compare.schema.json")));
    return schema.faults(nlohmann::json(report));
  }
};

TEST_F(CompareJson, IsAsItsSchemaSays) {
  const Json report = toJson(compareTrees(threeTrees(), balls()), balls());
  EXPECT_THAT(faults(report), IsEmpty());
  EXPECT_THAT(faults(toJson(compareTrees(threeTrees()), {})), IsEmpty());
  Json oneTree = report;
  oneTree["trees"].erase(2);
  oneTree["trees"].erase(1);
  EXPECT_THAT(faults(oneTree), ::testing::SizeIs(1));
  Json unlabelled = report;
  unlabelled["trees"][1].erase("label");
  EXPECT_THAT(faults(unlabelled), ::testing::SizeIs(1));
}

TEST_F(CompareJson, TellsWhatWasCompared) {
  std::vector<OpenedTree> trees = threeTrees();
  trees[1].notes = {"It was read as SWC."};
  const Json report = toJson(compareTrees(std::move(trees)), {}, {{"organ", "simple"}});
  EXPECT_EQ(report["inputs"][1]["path"], "narrow.vtp");
  EXPECT_EQ(report["parameters"]["organ"], "simple");
  EXPECT_EQ(report["warnings"], Json::array({"narrow: It was read as SWC."}));
  EXPECT_EQ(report["trees"][0]["metadata"]["method"], "kitaoka");
  EXPECT_EQ(report["trees"][2]["terminals"], 1);
  EXPECT_EQ(report["checks"][2]["tree"], "one");
  EXPECT_EQ(report["checks"][2]["id"], "TREE-PROBLEMS");
}

TEST_F(CompareJson, PutsTheValuesOfAllTreesBesideABand) {
  const Json report = toJson(compareTrees(threeTrees()), {});
  bool found = false;
  for (const Json& item : report["published"]) {
    EXPECT_EQ(item["values"].size(), 3U);
    EXPECT_NE(item["quantity"], "gap_mean");  // no tree has it without a region
    if (item["quantity"] != "branching_angle_deg.mean") continue;
    found = true;
    EXPECT_NEAR(item["values"][0].get<double>(), 35.0, 1e-9);
    EXPECT_NEAR(item["values"][1].get<double>(), 20.0, 1e-9);
    EXPECT_TRUE(item["values"][2].is_null());
    EXPECT_EQ(item["low"], 37.0);
  }
  EXPECT_TRUE(found);
}

}  // namespace
}  // namespace pneuma
