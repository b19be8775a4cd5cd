#include "pipeline/measure_report.h"

#include <array>
#include <cmath>
#include <fstream>
#include <set>
#include <sstream>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "support/json_schema.h"
#include "support/sample_trees.h"
#include "support/simple_domains.h"
#include "support/text_lines.h"

namespace pneuma {
namespace {

using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Not;
using ::testing::StartsWith;

/// Trachea with a symmetric tree on either side.
AirwayTree twoLobes() {
  AirwayTree tree = testing::SymmetricTree{
      .generations = 7,
      .lengthMm = [](int z) { return 30.0 * std::pow(0.8, z); },
      .diameterMm = [](int z) { return 6.0 * std::pow(0.75, z); },
  }
                        .tree();
  for (std::size_t i = 0; i < tree.size(); ++i) {
    const int parent = tree[i].parent;
    const Lobe above = parent < 0 ? Lobe::Central : tree[static_cast<std::size_t>(parent)].lobe;
    tree.setLobe(i, i == 1 ? Lobe::RightUpper : i == 2 ? Lobe::LeftLower : above);
  }
  return tree;
}

const std::array<LobeRegion, 2>& regions() {
  static const std::array<LobeRegion, 2> lobes = {
      {{Lobe::RightUpper, testing::ball(80.0, Vec3(-40, 0, -70))},
       {Lobe::LeftLower, testing::ball(80.0, Vec3(40, 0, -70))}}};
  return lobes;
}

MorphometryInput input() { return {.lobes = regions(), .seed = 1, .gapPoints = 2000}; }

TEST(MorphometryJson, HasTheKeysThatOthersRelyOn) {
  const Json json = toJson(measure(twoLobes(), input()));
  for (const char* key : {"gap_mean", "gap_p95", "gap_max", "dead_space_ml", "crossings"}) {
    ASSERT_TRUE(json.contains(key)) << key;
    EXPECT_TRUE(json.at(key).is_number()) << key;
  }
  for (const char* key : {"branching_angle_deg", "rotation_angle_deg", "length_to_diameter",
                          "terminal_generation", "path_length_mm"}) {
    for (const char* part : {"count", "mean", "sd", "min", "max"}) {
      EXPECT_TRUE(json.at(key).at(part).is_number()) << key << " " << part;
    }
  }
  for (const char* order : {"strahler", "horsfield"}) {
    for (const char* part : {"Rb", "Rl", "Rd", "r2", "r2_length", "r2_diameter"}) {
      EXPECT_TRUE(json.at(order).at(part).is_number()) << order << " " << part;
    }
  }
}

TEST(MorphometryJson, HasTheValuesMeasured) {
  const Morphometry m = measure(twoLobes(), input());
  const Json json = toJson(m);
  EXPECT_EQ(json.at("branches"), 127);
  EXPECT_EQ(json.at("terminals"), 64);
  EXPECT_EQ(json.at("branching_angle_deg").at("mean"), m.branchingAngleDeg.mean);
  EXPECT_NEAR(json.at("branching_angle_deg").at("mean").get<double>(), 35.0, 1e-9);
  EXPECT_NEAR(json.at("strahler").at("Rb").get<double>(), 2.0, 1e-9);
  EXPECT_NEAR(json.at("horsfield").at("Rd").get<double>(), 4.0 / 3.0, 1e-9);
  EXPECT_EQ(json.at("gap_mean"), m.gap->mean);
  EXPECT_EQ(json.at("box_dimension").at(4).at("box_mm"), 32.0);
  EXPECT_EQ(json.at("strahler").at("counts").at(0), 64);
}

TEST(MorphometryJson, WhatIsNotKnownIsNullAndWhatWasNotMeasuredIsAbsent) {
  AirwayTree tree;
  testing::addBranch(tree, -1, Vec3(0, 0, -12), 2.0);
  const Json json = toJson(measure(tree));
  EXPECT_FALSE(json.contains("gap_mean"));
  EXPECT_TRUE(json.at("branching_angle_deg").at("mean").is_null());
  EXPECT_EQ(json.at("branching_angle_deg").at("count"), 0);
  EXPECT_TRUE(json.at("strahler").at("Rb").is_null());
  EXPECT_TRUE(json.at("length_to_parent_below_one").is_null());
}

/// A measure report as the command writes it.
Json measureReport(const AirwayTree& tree, const MorphometryInput& what) {
  const Morphometry whole = measure(tree, what);
  Json report = {{"schema", "pneuma/measure/1"},
                 {"app", {{"name", "pneuma"}, {"version", "0.1.0"}, {"commit", "unknown"}}},
                 {"inputs", Json::array()},
                 {"parameters", Json::object()},
                 {"seed", 1},
                 {"frame", "LPS"},
                 {"units", {{"length", "mm"}, {"volume", "mL"}}},
                 {"checks", Json::array()},
                 {"warnings", Json::array()},
                 {"branches", tree.size()},
                 {"terminals", whole.terminals},
                 {"morphometry", toJson(whole)},
                 {"published", publishedJson(whole)},
                 {"lobes", Json::object()}};
  for (const auto& [lobe, morphometry] : measureByLobe(tree, what)) {
    report["lobes"][std::string(shortName(lobe))] = toJson(morphometry);
  }
  return report;
}

class MeasureSchema : public ::testing::Test {
 protected:
  static std::vector<std::string> faults(const Json& report) {
    std::ifstream file(PNEUMA_SCHEMAS "/measure.schema.json");
    return test::JsonSchema(nlohmann::json::parse(file)).faults(nlohmann::json(report));
  }
};

TEST_F(MeasureSchema, DescribesTheReport) {
  EXPECT_THAT(faults(measureReport(twoLobes(), input())), IsEmpty());
}

TEST_F(MeasureSchema, DescribesTheReportOfASingleBranch) {
  AirwayTree tree;
  testing::addBranch(tree, -1, Vec3(0, 0, -12), 2.0);
  EXPECT_THAT(faults(measureReport(tree, {})), IsEmpty());
}

TEST_F(MeasureSchema, NoticesWhatIsMissingAddedOrOfAnotherType) {
  const Json good = measureReport(twoLobes(), input());
  Json missing = good;
  missing["morphometry"].erase("strahler");
  EXPECT_THAT(faults(missing), Not(IsEmpty()));
  Json added = good;
  added["morphometry"]["angle"] = 1.0;
  EXPECT_THAT(faults(added), Not(IsEmpty()));
  Json text = good;
  text["lobes"]["RUL"]["dead_space_ml"] = "12 ml";
  EXPECT_THAT(faults(text), Not(IsEmpty()));
  Json lobe = good;
  lobe["lobes"]["XYZ"] = lobe["lobes"]["RUL"];
  EXPECT_THAT(faults(lobe), Not(IsEmpty()));
}

TEST(PublishedJson, NamesFiguresOfTheReport) {
  // The diameter classes of the tree are all taken, so that every band finds its figure.
  const AirwayTree tree =
      testing::SymmetricTree{
          .generations = 9,
          .diameterMm = [](int z) { return 6.0 * std::pow(0.75, z); },
      }
          .tree();
  const std::array<LobeRegion, 1> lobes = {{{Lobe::Whole, testing::ball(100.0)}}};
  const Json published = publishedJson(measure(tree, {.lobes = lobes, .gapPoints = 100}));
  std::set<std::string> named;
  for (const Json& item : published) named.insert(item.at("quantity"));
  for (const PublishedBand& band : publishedBands()) {
    EXPECT_TRUE(named.contains(std::string(band.quantity))) << band.quantity;
  }
}

TEST(PublishedJson, PutsTheMeasuredValueBesideTheBand) {
  const Json published = publishedJson(measure(twoLobes()));
  bool found = false;
  for (const Json& item : published) {
    if (item.at("quantity") != "strahler.Rb") continue;
    found = true;
    EXPECT_NEAR(item.at("value").get<double>(), 2.0, 1e-9);
    EXPECT_EQ(item.at("low"), 2.51);
    EXPECT_EQ(item.at("high"), 2.81);
    EXPECT_THAT(item.at("source").get<std::string>(), HasSubstr("recalled"));
  }
  EXPECT_TRUE(found);
}

TEST(MeasureText, PutsMeasuredPublishedAndSourceBesideEachOther) {
  const AirwayTree tree = twoLobes();
  const std::string text = measureText(measure(tree, input()), measureByLobe(tree, input()));
  const std::string angle = testing::lineWith(text, "branching angle, deg");
  EXPECT_THAT(angle, HasSubstr("35.0 +- 0.0 (35.0 to 35.0)"));
  EXPECT_THAT(angle, HasSubstr("37 to 43"));
  EXPECT_THAT(angle, HasSubstr("Tawhai (recalled)"));
  EXPECT_THAT(testing::lineWith(text, "- mother 2-1 mm wide"), HasSubstr("Subject002"));
  EXPECT_THAT(testing::lineWith(text, "- mother 1-0.7 mm wide"),
              IsEmpty());  // there is none that narrow
  EXPECT_THAT(testing::lineWith(text, "box dimension, 2 to 4 mm"), Not(IsEmpty()));
  EXPECT_THAT(testing::lineWith(text, "gap to the nearest terminal"), HasSubstr("0.48 to 0.55"));
}

TEST(MeasureText, ListsTheLobesBesideEachOther) {
  const AirwayTree tree = twoLobes();
  const std::string text = measureText(measure(tree), measureByLobe(tree));
  const std::string header = testing::lineWith(text, "mean by lobe");
  EXPECT_THAT(header, HasSubstr("RUL"));
  EXPECT_THAT(header, HasSubstr("LLL"));
  EXPECT_THAT(header, HasSubstr("central"));
  EXPECT_THAT(text, Not(HasSubstr("gap")));  // there was no region to measure it in
}

TEST(MeasureText, LeavesOutTheLobesWhereThereIsOne) {
  const AirwayTree tree = testing::SymmetricTree{}.tree();
  EXPECT_THAT(measureText(measure(tree), measureByLobe(tree)), Not(HasSubstr("mean by lobe")));
}

std::vector<std::string> csvFields(const std::string& line) {
  std::vector<std::string> fields(1);
  bool quoted = false;
  for (const char c : line) {
    if (c == '"') quoted = !quoted;
    if (c == ',' && !quoted) {
      fields.emplace_back();
    } else {
      fields.back() += c;
    }
  }
  return fields;
}

TEST(MeasureCsv, HasSixColumnsInEveryLine) {
  const AirwayTree tree = twoLobes();
  std::istringstream csv(measureCsv(measure(tree, input()), measureByLobe(tree, input())));
  std::string line;
  std::getline(csv, line);
  EXPECT_EQ(line, "region,quantity,value,published_low,published_high,source");
  std::set<std::string> seenRegions;
  std::set<std::string> seen;
  while (std::getline(csv, line)) {
    const std::vector<std::string> fields = csvFields(line);
    ASSERT_EQ(fields.size(), 6U) << line;
    seenRegions.insert(fields[0]);
    EXPECT_TRUE(seen.insert(fields[0] + fields[1]).second) << line;
    EXPECT_NO_THROW(std::stod(fields[2])) << line;
  }
  EXPECT_THAT(seenRegions, ::testing::ElementsAre("LLL", "RUL", "all", "central"));
}

TEST(MeasureCsv, WritesValuesThatReadBackExactly) {
  const Morphometry m = measure(twoLobes());
  const std::string line = testing::lineWith(measureCsv(m, {}), "all,dead_space_ml,");
  EXPECT_EQ(std::stod(csvFields(line)[2]), m.deadSpaceMl);
  EXPECT_EQ(csvFields(line)[3], "130");
  EXPECT_THAT(csvFields(line)[5], StartsWith("\"adult"));
}

}  // namespace
}  // namespace pneuma
