#include "io/airway_table.h"

#include <filesystem>
#include <fstream>
#include <functional>
#include <map>
#include <ostream>
#include <set>
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "anatomy/segment.h"
#include "core/error.h"
#include "core/units.h"
#include "io/json.h"

namespace pneuma {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::TestParamInfo;
using ::testing::Values;

/// The smallest table: one bifurcation into two segments.
Json smallTable() {
  return Json::parse(R"({
    "schema": "pneuma/airway-table/1", "frame": "LPS",
    "root": {"name": "TRACHEA", "start_mm": [0, 3, 25], "direction": [0, 0, -2],
             "diameter_mm": 18, "length_mm": 105},
    "bifurcations": [{"parent": "TRACHEA", "hint": [-1, 0, 0], "azimuth_deg": 5,
                      "a": {"name": "RB1", "angle_deg": 30, "length_to_diameter": 3},
                      "b": {"name": "LB3", "angle_deg": 45, "length_to_diameter": 2.5}}]})");
}

Json bifurcation(const std::string& parent, const std::string& a, const std::string& b) {
  Json json = smallTable()["bifurcations"][0];
  json["parent"] = parent;
  json["a"]["name"] = a;
  json["b"]["name"] = b;
  return json;
}

void expectEqual(const PredefinedAirways& a, const PredefinedAirways& b) {
  EXPECT_EQ(a.root, b.root);
  EXPECT_EQ(a.start, b.start);
  EXPECT_NEAR((a.direction - b.direction).norm(), 0.0, 1e-15);
  EXPECT_EQ(a.diameterMm, b.diameterMm);
  EXPECT_EQ(a.lengthMm, b.lengthMm);
  ASSERT_EQ(a.bifurcations.size(), b.bifurcations.size());
  for (std::size_t i = 0; i < a.bifurcations.size(); ++i) {
    const PredefinedBifurcation& p = a.bifurcations[i];
    const PredefinedBifurcation& q = b.bifurcations[i];
    EXPECT_EQ(p.parent, q.parent);
    EXPECT_EQ(p.hint, q.hint);
    EXPECT_EQ(p.azimuthDeg, q.azimuthDeg);
    EXPECT_EQ(p.a.name, q.a.name);
    EXPECT_EQ(p.b.angleDeg, q.b.angleDeg);
    EXPECT_EQ(p.b.lengthToDiameter, q.b.lengthToDiameter);
  }
}

TEST(AirwayTable, IsReadAsItStands) {
  const PredefinedAirways table = airwayTableOf(smallTable().dump(), "t.json");
  EXPECT_EQ(table.root, "TRACHEA");
  EXPECT_EQ(table.start, Vec3(0.0, 3.0, 25.0));
  EXPECT_EQ(table.direction, Vec3(0.0, 0.0, -1.0));
  EXPECT_EQ(table.diameterMm, 18.0);
  EXPECT_EQ(table.lengthMm, 105.0);
  ASSERT_EQ(table.bifurcations.size(), 1U);
  const PredefinedBifurcation& only = table.bifurcations[0];
  EXPECT_EQ(only.hint, Vec3(-1.0, 0.0, 0.0));
  EXPECT_EQ(only.azimuthDeg, 5.0);
  EXPECT_EQ(only.a.name, "RB1");
  EXPECT_EQ(only.a.angleDeg, 30.0);
  EXPECT_EQ(only.b.name, "LB3");
  EXPECT_EQ(only.b.lengthToDiameter, 2.5);
}

TEST(AirwayTable, OfTheThoraxHas17BifurcationsAnd18Segments) {
  const PredefinedAirways table = thoraxAirways();
  EXPECT_EQ(table.bifurcations.size(), 17U);
  std::set<std::string> known = {table.root};
  std::set<std::string> ends;
  for (const PredefinedBifurcation& b : table.bifurcations) {
    EXPECT_TRUE(known.contains(b.parent)) << b.parent << " comes after its daughters";
    ends.erase(b.parent);
    known.insert({b.a.name, b.b.name});
    ends.insert({b.a.name, b.b.name});
  }
  EXPECT_EQ(ends.size(), 18U);
  for (const Segment& segment : segments()) EXPECT_TRUE(ends.contains(std::string(segment.name)));
}

/// Where every airway of `table` ends, given their diameters, mm.
std::map<std::string, Vec3> endsOf(const PredefinedAirways& table,
                                   const std::map<std::string, double>& diameterMm) {
  std::map<std::string, Vec3> ends = {{table.root, table.start + table.lengthMm * table.direction}};
  std::map<std::string, Vec3> directions = {{table.root, table.direction}};
  for (const PredefinedBifurcation& b : table.bifurcations) {
    const Vec3 u = directions.at(b.parent);
    const Vec3 aside = rotated((b.hint - b.hint.dot(u) * u).normalized(), u, radians(b.azimuthDeg));
    for (const auto& [daughter, sign] : {std::pair{&b.a, 1.0}, std::pair{&b.b, -1.0}}) {
      const auto found = diameterMm.find(daughter->name);
      const double length =
          found == diameterMm.end() ? 0.0 : daughter->lengthToDiameter * found->second;
      const double angle = radians(daughter->angleDeg);
      const Vec3 direction = std::cos(angle) * u + sign * std::sin(angle) * aside;
      directions[daughter->name] = direction;
      ends[daughter->name] = ends.at(b.parent) + length * direction;
    }
  }
  return ends;
}

TEST(AirwayTable, OfTheThoraxLeadsWhereItWasFitted) {
  // Diameters and ends as the table was found with, turned from its frame (z down) to LPS.
  const std::map<std::string, double> diameters = {
      {"RMB", 14.29},  {"LMB", 13.81},    {"BI", 11.73},  {"RLL", 9.82},  {"RBASAL", 8.89},
      {"R8-10", 8.27}, {"R9+10", 6.77},   {"RB10", 5.23}, {"LUL", 10.95}, {"LUPDIV", 9.04},
      {"LB1+2", 7.39}, {"LINGULA", 7.99}, {"LB4", 6.00}};
  const auto ends = endsOf(thoraxAirways(), diameters);
  EXPECT_NEAR((ends.at("TRACHEA") - Vec3(0.0, 17.6, -79.0)).norm(), 0.0, 0.2);
  EXPECT_NEAR((ends.at("RB10") - Vec3(-58.3, 37.7, -223.2)).norm(), 0.0, 0.2);
  EXPECT_NEAR((ends.at("LB1+2") - Vec3(63.1, 11.9, -94.1)).norm(), 0.0, 0.2);
  EXPECT_NEAR((ends.at("LB4") - Vec3(76.0, 8.3, -129.2)).norm(), 0.0, 0.2);
}

TEST(AirwayTable, ComesBackFromItsText) {
  const PredefinedAirways table = thoraxAirways();
  expectEqual(airwayTableOf(airwayTableText(table), "text"), table);
}

TEST(AirwayTable, MayStandInAnyOrder) {
  Json json = smallTable();
  json["bifurcations"] = {bifurcation("LEFT", "LB3", "LB4"), bifurcation("RIGHT", "RB1", "RB2"),
                          bifurcation("TRACHEA", "RIGHT", "LEFT")};
  const PredefinedAirways table = airwayTableOf(json.dump(), "t.json");
  ASSERT_EQ(table.bifurcations.size(), 3U);
  EXPECT_EQ(table.bifurcations[0].parent, "TRACHEA");
  EXPECT_EQ(table.bifurcations[1].parent, "LEFT");
}

TEST(AirwayTable, IsReadFromAFile) {
  const std::filesystem::path path = std::filesystem::path(::testing::TempDir()) / "airways.json";
  std::ofstream(path) << smallTable().dump();
  EXPECT_EQ(readAirwayTable(path).root, "TRACHEA");
  std::filesystem::remove(path);
  EXPECT_THROW(readAirwayTable(path), InputMissing);
}

struct BadTable {
  std::string name;
  std::function<void(Json&)> spoil;
  std::string complaint;
};

void PrintTo(const BadTable& bad, std::ostream* out) { *out << bad.name; }

class BadAirwayTable : public ::testing::TestWithParam<BadTable> {};

TEST_P(BadAirwayTable, IsRefusedWithAReason) {
  Json json = smallTable();
  GetParam().spoil(json);
  try {
    airwayTableOf(json.dump(), "t.json");
    FAIL() << "was read";
  } catch (const InvalidInput& error) {
    EXPECT_THAT(error.what(), AllOf(HasSubstr("t.json"), HasSubstr(GetParam().complaint)));
  }
}

Json& only(Json& json) { return json["bifurcations"][0]; }

INSTANTIATE_TEST_SUITE_P(
    Tables, BadAirwayTable,
    Values(
        BadTable{"List", [](Json& j) { j = Json::array(); }, "no object"},
        BadTable{"OtherSchema", [](Json& j) { j["schema"] = "pneuma/tree/1"; }, "airway-table/1"},
        BadTable{"OtherFrame", [](Json& j) { j["frame"] = "RAS"; }, "LPS"},
        BadTable{"NoRoot", [](Json& j) { j.erase("root"); }, "has no \"root\""},
        BadTable{"NoDirection",
                 [](Json& j) {
                   j["root"]["direction"] = {0, 0, 0};
                 },
                 "no length"},
        BadTable{"Diameter", [](Json& j) { j["root"]["diameter_mm"] = 0; }, "[0.1, 100]"},
        BadTable{"LengthNull", [](Json& j) { j["root"]["length_mm"] = nullptr; }, "not null"},
        BadTable{"TwoCoordinates",
                 [](Json& j) {
                   j["root"]["start_mm"] = {0, 1};
                 },
                 "three numbers"},
        BadTable{"NoBifurcation", [](Json& j) { j["bifurcations"] = Json::array(); },
                 "no bifurcation"},
        BadTable{"NoList", [](Json& j) { j["bifurcations"] = 5; }, "must be a list"},
        BadTable{"Number", [](Json& j) { only(j) = 3; }, "bifurcation 1 is no object"},
        BadTable{"NoAngle", [](Json& j) { only(j)["a"].erase("angle_deg"); },
                 "bifurcation 1, \"a\" has no \"angle_deg\""},
        BadTable{"SteepAngle", [](Json& j) { only(j)["b"]["angle_deg"] = 150; }, "[0, 120]"},
        BadTable{"NegativeAngle", [](Json& j) { only(j)["b"]["angle_deg"] = -1; }, "[0, 120]"},
        BadTable{"TextAngle", [](Json& j) { only(j)["a"]["angle_deg"] = "30"; },
                 "must be a number"},
        BadTable{"Length", [](Json& j) { only(j)["a"]["length_to_diameter"] = 0; }, "[0.1, 20]"},
        BadTable{"NoHint",
                 [](Json& j) {
                   only(j)["hint"] = {0, 0, 0};
                 },
                 "no length"},
        BadTable{"Nameless", [](Json& j) { only(j)["a"]["name"] = ""; }, "must be a name"},
        BadTable{"UnknownSegment", [](Json& j) { only(j)["a"]["name"] = "LB7"; },
                 "'LB7' is not divided, but no segment is called so"},
        BadTable{"Twins", [](Json& j) { only(j)["b"]["name"] = "RB1"; },
                 "two airways are called 'RB1'"},
        BadTable{"RootAgain", [](Json& j) { only(j)["b"]["name"] = "TRACHEA"; },
                 "two airways are called 'TRACHEA'"},
        BadTable{"DividedTwice",
                 [](Json& j) { j["bifurcations"].push_back(bifurcation("TRACHEA", "RB2", "LB4")); },
                 "'TRACHEA' is divided twice"},
        BadTable{"UnknownParent",
                 [](Json& j) { j["bifurcations"].push_back(bifurcation("RUL", "RB2", "RB3")); },
                 "no airway is called 'RUL', the parent of 'RB2' and 'RB3'"},
        BadTable{"Cycle",
                 [](Json& j) {
                   j["bifurcations"].push_back(bifurcation("X", "Y", "RB2"));
                   j["bifurcations"].push_back(bifurcation("Y", "X", "RB3"));
                 },
                 "descends from itself"}),
    [](const TestParamInfo<BadTable>& each) { return each.param.name; });

TEST(AirwayTable, TextThatIsNoJsonIsRefused) {
  std::string notANumber = smallTable().dump();
  notANumber.replace(notANumber.find("105"), 3, "NaN");
  std::string huge = smallTable().dump();
  huge.replace(huge.find("105"), 3, "1e999");
  const std::string whole = smallTable().dump();
  for (const std::string& text : {std::string(), std::string("{"), notANumber, huge,
                                  whole.substr(0, whole.size() - 1), std::string("\x00\xff", 2)}) {
    EXPECT_THROW(airwayTableOf(text, "t.json"), InvalidInput) << text;
  }
}

}  // namespace
}  // namespace pneuma
