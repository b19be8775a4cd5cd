#include "pipeline/reproduce.h"

#include <algorithm>
#include <cmath>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/error.h"
#include "core/parallel.h"
#include "io/atomic_file.h"
#include "support/json_schema.h"
#include "support/progress_recorder.h"

namespace pneuma {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Not;

TEST(Limit, HoldsUpToItsEndsAndNoFurther) {
  EXPECT_TRUE(Limit::relative(0.25).holds(8.0, 10.0));
  EXPECT_TRUE(Limit::relative(0.25).holds(8.0, 6.0));
  EXPECT_FALSE(Limit::relative(0.25).holds(8.0, 10.01));
  EXPECT_FALSE(Limit::relative(0.25).holds(8.0, 5.99));
  EXPECT_TRUE(Limit::difference(0.5).holds(0.0, -0.5));
  EXPECT_FALSE(Limit::difference(0.5).holds(0.0, 0.51));
  EXPECT_TRUE(Limit::range(2.0, 3.0).holds(9.0, 2.0));
  EXPECT_FALSE(Limit::range(2.0, 3.0).holds(9.0, 3.01));
  EXPECT_TRUE(Limit{}.holds(1.0, 1e9));
}

/// One row of every kind of limit; the second one misses.
Reproduction fourRows() {
  Reproduction result;
  result.paper = "nobody-1900";
  result.tables = {{"1",
                    "Table 1: nothing",
                    {{"a", "N", 1000, 1010, Limit::relative(0.02), {}},
                     {"a", "Q_f", 0.1, 0.4, Limit::difference(0.2), "far away"},
                     {"b", "N", 7, 8, Limit::range(7.5, 9.0), "far away"},
                     {"b", "share", 0.0, 0.0003, {}, "near"}}}};
  return result;
}

TEST(Reproduction, IsOkIfEveryRowIs) {
  Reproduction result = fourRows();
  EXPECT_FALSE(result.ok());
  result.tables[0].rows[1].measured = 0.29;
  EXPECT_TRUE(result.ok());
}

TEST(Reproduction, JsonStatesEveryLimit) {
  const auto json = nlohmann::json::parse(toJson(fourRows()).dump());
  const test::JsonSchema schema(
      nlohmann::json::parse(readFile(std::string(PNEUMA_SCHEMAS) + "/reproduce.schema.json")));
  EXPECT_THAT(schema.faults(json), IsEmpty());
  EXPECT_EQ(json["ok"], false);
  EXPECT_EQ(json["tables"][0]["id"], "1");
  const auto& rows = json["tables"][0]["rows"];
  EXPECT_EQ(rows[0]["limit"], 0.02);
  EXPECT_EQ(rows[0]["limit_of"], "relative");
  EXPECT_NEAR(rows[0]["relative"].get<double>(), 0.01, 1e-12);
  EXPECT_EQ(rows[1]["limit_of"], "difference");
  EXPECT_EQ(rows[1]["ok"], false);
  EXPECT_EQ(rows[2]["limit"], nlohmann::json::parse("[7.5, 9.0]"));
  EXPECT_EQ(rows[2]["limit_of"], "range");
  EXPECT_TRUE(rows[3]["limit"].is_null());
  EXPECT_EQ(rows[3]["limit_of"], "nothing");
  EXPECT_FALSE(rows[0].contains("note"));
  EXPECT_EQ(rows[3]["note"], "near");
}

TEST(Reproduction, TextNamesARowOnceAndNumbersItsNotes) {
  const std::string text = textOf(fourRows());
  EXPECT_THAT(text,
              HasSubstr("a    N              1000       1010    +1.0 %  2 %             ok\n"));
  EXPECT_THAT(
      text,
      HasSubstr("\n     Q_f             0.1        0.4      +0.3  0.2             NOT OK [1]"));
  EXPECT_THAT(text, HasSubstr("7.5 to 9        ok [1]\n"));
  EXPECT_THAT(text, HasSubstr("0.0003   +0.0003  not judged       [2]\n"));
  EXPECT_THAT(text, HasSubstr("  [1] far away\n  [2] near\n"));
}

TEST(Reproduction, ShowsScatterAndWhatHasNoPublishedFigure) {
  Reproduction result = fourRows();
  result.tables[0].rows[0].sd = 2.5;
  result.tables[0].rows[3].published = std::nan("");
  const std::string text = textOf(result);
  EXPECT_THAT(text,
              HasSubstr("a    N              1000 1010 +- 2.5    +1.0 %  2 %             ok\n"));
  EXPECT_THAT(text, HasSubstr("share             -      0.0003         -  not judged"));
  const auto json = nlohmann::json::parse(toJson(result).dump());
  const test::JsonSchema schema(
      nlohmann::json::parse(readFile(std::string(PNEUMA_SCHEMAS) + "/reproduce.schema.json")));
  EXPECT_THAT(schema.faults(json), IsEmpty());
  EXPECT_EQ(json["tables"][0]["rows"][0]["sd"], 2.5);
  EXPECT_FALSE(json["tables"][0]["rows"][3].contains("published"));
}

TEST(Reproduce, AsksForDataWhereItNeedsThem) {
  EXPECT_TRUE(needsData("motion"));
  EXPECT_FALSE(needsData("zhang-2003"));
  EXPECT_THROW(needsData("nobody-1900"), InvalidOption);
  EXPECT_THROW(reproduce("motion"), InputMissing);
  EXPECT_THROW(reproduce("motion", {.table = "quiet", .data = "no such folder"}), InputMissing);
}

TEST(Reproduce, NamesPapersAndTables) {
  EXPECT_THAT(reproduciblePapers(), ElementsAre("huang-2004", "kitaoka-1999", "santhanam-2003",
                                                "santhanam-2008", "zhang-2003", "motion"));
  EXPECT_THAT(reproducibleTables("huang-2004"), ElementsAre("1", "right-lung"));
  EXPECT_THAT(reproducibleTables("kitaoka-1999"),
              ElementsAre("1", "2", "3", "4", "5", "thorax", "claims"));
  EXPECT_THAT(reproducibleTables("santhanam-2003"),
              ElementsAre("assignment", "sharing", "strain", "volume", "directions", "missing"));
  EXPECT_THAT(reproducibleTables("santhanam-2008"),
              ElementsAre("pressure-volume", "linearity", "plane", "disc", "modulus",
                          "expandability", "tumour", "steps", "missing"));
  EXPECT_THAT(reproducibleTables("zhang-2003"),
              ElementsAre("outline", "shares", "variations", "free", "lung"));
  EXPECT_THAT(reproducibleTables("motion"), ElementsAre("deep", "fit", "quiet"));
}

TEST(Reproduce, RefusesUnknownPapersAndTables) {
  EXPECT_THROW(reproduce("kitaoka"), InvalidOption);
  EXPECT_THROW(reproduce("kitaoka-1999", {.table = "6"}), InvalidOption);
  EXPECT_THROW(reproduce("huang-2004", {.table = "thorax"}), InvalidOption);
  EXPECT_THROW(requireReproducible("huang-2004", "2"), InvalidOption);
  EXPECT_NO_THROW(requireReproducible("huang-2004", "right-lung"));
}

TEST(Reproduce, KeepsZhangsFiguresWithinTheirLimits) {
  for (const char* table : {"outline", "shares", "free"}) {
    for (const ReproducedTable& found : reproduce("zhang-2003", {.table = table}).tables) {
      EXPECT_GE(found.rows.size(), 2U) << table;
      for (const ReproducedRow& row : found.rows) {
        EXPECT_TRUE(row.ok()) << table << ": " << row.quantity << " is " << row.measured;
      }
    }
  }
}

TEST(Reproduce, KeepsSanthanams2003FiguresWithinTheirLimits) {
  const Reproduction result = reproduce("santhanam-2003", {.table = "", .figures = true});
  EXPECT_TRUE(result.ok()) << textOf(result);
  EXPECT_EQ(result.tables.size(), 6U);
  EXPECT_THAT(result.citation, HasSubstr("Pacific Graphics"));
  ASSERT_EQ(result.figures.size(), 2U);
  EXPECT_EQ(result.figures[1].model.surfaces->size(), 2U);
  const auto json = nlohmann::json::parse(toJson(result).dump());
  const test::JsonSchema schema(
      nlohmann::json::parse(readFile(std::string(PNEUMA_SCHEMAS) + "/reproduce.schema.json")));
  EXPECT_THAT(schema.faults(json), IsEmpty());
  EXPECT_FALSE(json["tables"][1]["rows"][0].contains("published"));
  EXPECT_THAT(textOf(result), HasSubstr("never"));
}

TEST(Reproduce, KeepsSanthanams2008FiguresWithinTheirLimits) {
  const Reproduction result = reproduce("santhanam-2008");
  EXPECT_TRUE(result.ok()) << textOf(result);
  EXPECT_EQ(result.tables.size(), 9U);
}

const ReproducedRow& row(const ReproducedTable& table, const std::string& name,
                         const std::string& quantity) {
  const auto found = std::ranges::find_if(table.rows, [&](const ReproducedRow& candidate) {
    return candidate.row == name && candidate.quantity == quantity;
  });
  if (found == table.rows.end()) throw InvalidInput("no " + quantity + " of " + name);
  return *found;
}

TEST(Reproduce, KitaokaTable5StandsBesideThePaper) {
  const Reproduction result = reproduce("kitaoka-1999", {.table = "5"});
  ASSERT_EQ(result.tables.size(), 1U);
  const ReproducedTable& table = result.tables[0];
  EXPECT_TRUE(result.ok()) << textOf(result);
  EXPECT_THAT(result.citation, HasSubstr("Kitaoka"));
  EXPECT_TRUE(result.figures.empty());
  EXPECT_EQ(row(table, "2.5", "N").published, 56481);
  EXPECT_NEAR(row(table, "2.8", "N").measured, 55627, 0.015 * 55627);
  EXPECT_NEAR(row(table, "3.0", "V_r").measured, 0.040, 0.002);
  EXPECT_EQ(row(table, "EL falls", "order").measured, 1.0);
  for (const std::string name : {"2.5", "2.8", "3.0"}) {
    double sum = 0.0;
    for (const char* part : {"Q_f", "C_n", "C_a", "V_r", "EL"}) {
      sum += row(table, name, part).measured;
    }
    EXPECT_NEAR(row(table, name, "PI").measured, sum, 1e-12);
  }
}

TEST(Reproduce, IsTheSameForAnyNumberOfThreads) {
  const std::string all = textOf(reproduce("kitaoka-1999", {.table = "3"}));
  const ThreadLimit one(1);
  EXPECT_EQ(textOf(reproduce("kitaoka-1999", {.table = "3"})), all);
}

TEST(Reproduce, OnlyRisesAndStopsOnRequest) {
  testing::ProgressRecorder recorder;
  reproduce("kitaoka-1999", {.table = "5"}, Progress(recorder));
  EXPECT_TRUE(std::ranges::is_sorted(recorder.fractions()));
  EXPECT_GT(recorder.fractions().size(), 20U);
  EXPECT_EQ(recorder.fractions().back(), 1.0);
  testing::ProgressRecorder stopped(0.2);
  EXPECT_THROW(reproduce("kitaoka-1999", {.table = "5"}, Progress(stopped)), Cancelled);
}

TEST(Reproduce, HuangKeepsOnlyWhatIsAskedFor) {
  const Reproduction result = reproduce("huang-2004", {.table = "right-lung", .figures = true});
  ASSERT_EQ(result.tables.size(), 1U);
  EXPECT_EQ(result.tables[0].id, "right-lung");
  EXPECT_THAT(result.tables[0].rows, Not(IsEmpty()));
  ASSERT_EQ(result.figures.size(), 1U);
  EXPECT_EQ(result.figures[0].model.surfaces->size(), 3U);
}

}  // namespace
}  // namespace pneuma
