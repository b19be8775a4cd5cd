#include "support/json_schema.h"

#include <filesystem>
#include <fstream>

#include <gtest/gtest.h>

namespace pneuma::test {
namespace {

using nlohmann::json;

std::size_t faultCount(const char* schema, const char* value) {
  return JsonSchema(json::parse(schema)).faults(json::parse(value)).size();
}

TEST(JsonSchema, TypesAreTold) {
  EXPECT_EQ(faultCount(R"({"type":"integer"})", "3"), 0U);
  EXPECT_EQ(faultCount(R"({"type":"integer"})", "3.5"), 1U);
  EXPECT_EQ(faultCount(R"({"type":["number","null"]})", "null"), 0U);
  EXPECT_EQ(faultCount(R"({"type":["number","null"]})", R"("x")"), 1U);
}

TEST(JsonSchema, MembersAreRequiredAndChecked) {
  const char* schema = R"({"required":["a"],"properties":{"a":{"type":"string"}}})";
  EXPECT_EQ(faultCount(schema, R"({"a":"x","b":1})"), 0U);
  EXPECT_EQ(faultCount(schema, R"({"b":1})"), 1U);
  EXPECT_EQ(faultCount(schema, R"({"a":1})"), 1U);
}

TEST(JsonSchema, OtherMembersCanBeForbiddenOrTyped) {
  EXPECT_EQ(faultCount(R"({"properties":{"a":true},"additionalProperties":false})", R"({"b":1})"),
            1U);
  EXPECT_EQ(faultCount(R"({"additionalProperties":{"type":"number"}})", R"({"b":"x"})"), 1U);
}

TEST(JsonSchema, ItemsReferencesAndLimitsAreChecked) {
  const char* schema =
      R"({"$defs":{"n":{"minimum":0}},"type":"array","minItems":1,"items":{"$ref":"#/$defs/n"}})";
  EXPECT_EQ(faultCount(schema, "[1,2]"), 0U);
  EXPECT_EQ(faultCount(schema, "[1,-2]"), 1U);
  EXPECT_EQ(faultCount(schema, "[]"), 1U);
}

TEST(JsonSchema, ConstEnumAndPatternAreChecked) {
  EXPECT_EQ(faultCount(R"({"const":"a"})", R"("b")"), 1U);
  EXPECT_EQ(faultCount(R"({"enum":["a","b"]})", R"("c")"), 1U);
  EXPECT_EQ(faultCount(R"({"pattern":"^[0-9a-f]{4}$"})", R"("12fg")"), 1U);
}

TEST(JsonSchema, AnUnknownKeywordIsAFault) { EXPECT_EQ(faultCount(R"({"maximum":1})", "0"), 1U); }

TEST(Schemas, NameTheirDialectAndTheReportTheyDescribe) {
  std::size_t schemas = 0;
  for (const auto& entry : std::filesystem::directory_iterator(PNEUMA_SCHEMAS)) {
    std::ifstream file(entry.path());
    const json schema = json::parse(file);
    const std::string name = entry.path().filename().string();
    const std::string report = "pneuma/" + name.substr(0, name.find('.')) + "/1";
    EXPECT_EQ(schema.at("$schema"), "https://json-schema.org/draft/2020-12/schema") << name;
    const json& named = schema.at("properties").at("schema");
    EXPECT_EQ(named.contains("enum") ? named.at("enum").at(0) : named.at("const"), report) << name;
    ++schemas;
  }
  EXPECT_GE(schemas, 4U);
}

TEST(Schemas, MeasureAndCompareDescribeTheSameFigures) {
  const auto figures = [](const std::string& report) {
    std::ifstream file(PNEUMA_SCHEMAS "/" + report + ".schema.json");
    return json::parse(file).at("$defs");
  };
  EXPECT_EQ(figures("measure"), figures("compare"));
}

}  // namespace
}  // namespace pneuma::test
