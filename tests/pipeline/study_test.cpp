#include "pipeline/study.h"

#include <algorithm>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/error.h"
#include "core/parallel.h"
#include "io/atomic_file.h"
#include "pipeline/efficiency_report.h"
#include "support/json_schema.h"
#include "support/progress_recorder.h"
#include "support/simple_domains.h"

namespace pneuma {
namespace {

LungModel oneBall() {
  LungModel model;
  model.regions = std::make_shared<const std::vector<LobeRegion>>(
      std::vector<LobeRegion>{{Lobe::Whole, testing::ball(60.0)}});
  return model;
}

CentroidSplittingOptions fewPoints() { return {.points = 1500, .jitter = 0.5}; }

double figure(const StudyRow& row, const std::string& name) {
  for (const auto& [key, value] : row.figures) {
    if (key == name) return value;
  }
  ADD_FAILURE() << "no figure " << name;
  return 0.0;
}

TEST(Study, RowsAreTheGrowthsOfTheirSeeds) {
  const Study result = study(oneBall(), fewPoints(), {}, {4, 7});
  ASSERT_EQ(result.rows.size(), 2U);
  EXPECT_EQ(result.rows[1].seed, 7U);
  const LungModel grown = grow(oneBall(), withSeed(fewPoints(), 7));
  const Efficiency& e = grown.growth->efficiency;
  EXPECT_EQ(figure(result.rows[1], "N"), static_cast<double>(grown.growth->result.tree.size()));
  EXPECT_EQ(figure(result.rows[1], "T"), static_cast<double>(e.terminals));
  EXPECT_EQ(figure(result.rows[1], "C_a"), *e.ca);
  EXPECT_EQ(figure(result.rows[1], "EL"), e.paper.el);
  EXPECT_EQ(figure(result.rows[1], "V_r_today"), e.today.vr);
  EXPECT_EQ(figure(result.rows[1], "points"), 1500.0);
  EXPECT_NE(figure(result.rows[0], "C_a"), figure(result.rows[1], "C_a"));
}

TEST(Study, QuantitiesAreMeanAndSpreadOfTheRows) {
  const Study result = study(oneBall(), fewPoints(), {}, {1, 2, 3});
  const auto found = std::ranges::find(result.quantities, "EL", &StudyQuantity::name);
  ASSERT_NE(found, result.quantities.end());
  std::vector<double> values;
  for (const StudyRow& row : result.rows) values.push_back(figure(row, "EL"));
  EXPECT_EQ(found->summary.mean, summary(values).mean);
  EXPECT_EQ(found->summary.sd, summary(values).sd);
  EXPECT_GT(found->summary.sd, 0.0);
}

TEST(Study, VariesTheOrganWithTheSeed) {
  CentroidSplittingOptions options = fewPoints();
  options.jitter = 0.0;
  const Study alike = study(oneBall(), options, {}, {1, 2});
  EXPECT_EQ(figure(alike.rows[0], "path_length_mm"), figure(alike.rows[1], "path_length_mm"));
  const Study different = study(oneBall(), options, {.organScale = 0.1}, {1, 2});
  EXPECT_NE(figure(different.rows[0], "path_length_mm"),
            figure(different.rows[1], "path_length_mm"));
}

TEST(Study, IsTheSameForAnyNumberOfThreads) {
  const VariationOptions variation{.organScale = 0.05};
  const auto table = [&] {
    return studyCsv(study(oneBall(), fewPoints(), variation, {1, 2, 3, 4}));
  };
  const std::string all = table();
  const ThreadLimit one(1);
  EXPECT_EQ(table(), all);
}

TEST(Study, OnlyRisesAndStopsOnRequest) {
  testing::ProgressRecorder recorder;
  study(oneBall(), fewPoints(), {}, {1, 2, 3}, Progress(recorder));
  EXPECT_TRUE(std::ranges::is_sorted(recorder.fractions()));
  EXPECT_EQ(recorder.fractions().back(), 1.0);
  testing::ProgressRecorder stopped(0.5);
  EXPECT_THROW(study(oneBall(), fewPoints(), {}, {1, 2, 3}, Progress(stopped)), Cancelled);
}

TEST(Study, RefusesNoSeedAndTooMany) {
  EXPECT_THROW(study(oneBall(), fewPoints(), {}, {}), InvalidOption);
  EXPECT_THROW(study(oneBall(), fewPoints(), {}, std::vector<std::uint64_t>(10001)), InvalidOption);
}

TEST(Study, JsonIsAsItsSchemaSays) {
  const Study result = study(oneBall(), fewPoints(), {.organScale = 0.05}, {1, 2});
  const test::JsonSchema schema(
      nlohmann::json::parse(readFile(std::string(PNEUMA_SCHEMAS) + "/study.schema.json")));
  const auto json = nlohmann::json::parse(toJson(result, oneBall()).dump());
  EXPECT_THAT(schema.faults(json), ::testing::IsEmpty());
  EXPECT_EQ(json["rows"][1]["figures"]["N"], figure(result.rows[1], "N"));
  EXPECT_FALSE(json["options"].contains("seed"));
}

TEST(Study, CsvHasALineForEverySeed) {
  Study result;
  result.rows = {{3, {{"N", 5.0}, {"C_n", 0.25}}}, {4, {{"N", 7.0}}}};
  result.quantities = {{"N", {}}, {"C_n", {}}};
  EXPECT_EQ(studyCsv(result), "seed,N,C_n\n3,5,0.25\n4,7,\n");
}

TEST(EfficiencyReport, SaysNullForWhatIsNotKnown) {
  Efficiency e;
  e.qf = 0.25;
  e.paper.cn = 0.5;
  const Json json = toJson(e);
  EXPECT_EQ(json["paper"]["Q_f"], 0.25);
  EXPECT_EQ(json["paper"]["C_n"], 0.5);
  EXPECT_TRUE(json["paper"]["C_a"].is_null());
  EXPECT_TRUE(json["today"]["PI"].is_null());
  EXPECT_THAT(efficiencyText(e), ::testing::HasSubstr("C_n 0.500, C_a -"));
}

}  // namespace
}  // namespace pneuma
