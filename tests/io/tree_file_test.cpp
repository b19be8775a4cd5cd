#include "io/tree_file.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "anatomy/branch_order.h"
#include "core/error.h"
#include "io/atomic_file.h"
#include "io_samples.h"
#include "support/json_schema.h"
#include "temp_folder.h"

namespace pneuma {
namespace {

using ::testing::HasSubstr;
using testing::sampleTree;
using testing::TempFolder;

const std::map<std::string, std::string> SampleMetadata = {
    {"method", "centroid"},
    {"options", "{\"length-fraction\": 0.4,\n \"path\": \"C:\\temp\"}"},
    {"seed", "1"},
    {"empty", ""}};

void expectEqualGeometry(const AirwayTree& a, const AirwayTree& b, bool withVia = true) {
  ASSERT_EQ(a.size(), b.size());
  for (std::size_t i = 0; i < a.size(); ++i) {
    SCOPED_TRACE(i);
    EXPECT_EQ(a[i].parent, b[i].parent);
    EXPECT_EQ(a[i].proximal, b[i].proximal);
    EXPECT_EQ(a[i].distal, b[i].distal);
    EXPECT_EQ(a[i].radiusMm, b[i].radiusMm);
    EXPECT_EQ(a[i].lobe, b[i].lobe);
    EXPECT_EQ(a[i].origin, b[i].origin);
    if (!withVia) continue;
    ASSERT_EQ(a[i].via.size(), b[i].via.size());
    for (std::size_t j = 0; j < a[i].via.size(); ++j) {
      EXPECT_EQ(a[i].via[j].position, b[i].via[j].position);
      EXPECT_EQ(a[i].via[j].radiusMm, b[i].via[j].radiusMm);
    }
  }
}

void expectEqualLabels(const AirwayTree& a, const AirwayTree& b) {
  for (std::size_t i = 0; i < a.size(); ++i) {
    EXPECT_EQ(a[i].segment, b[i].segment) << i;
    EXPECT_EQ(a[i].ending, b[i].ending) << i;
    EXPECT_EQ(a[i].suppliedMl, b[i].suppliedMl) << i;
  }
}

class TreeFormat : public ::testing::TestWithParam<const char*> {};

TEST_P(TreeFormat, ReadsBackEqualToWhatItPromises) {
  const TempFolder folder;
  const std::string format = GetParam();
  const AirwayTree tree = sampleTree();
  writeTree(folder / ("tree." + format), tree, SampleMetadata);
  const TreeFile file = readTree(folder / ("tree." + format));
  expectEqualGeometry(file.tree, tree, format != "csv");
  if (format != "swc") expectEqualLabels(file.tree, tree);
  EXPECT_EQ(file.metadata, SampleMetadata);
  EXPECT_THAT(file.notes, ::testing::IsEmpty());
  EXPECT_TRUE(isTreeFile(folder / ("tree." + format)));
}

TEST_P(TreeFormat, IsTheSameEveryTime) {
  EXPECT_EQ(treeText(sampleTree(), GetParam()), treeText(sampleTree(), GetParam()));
}

TEST_P(TreeFormat, IsKnownByItsContent) {
  const TempFolder folder;
  const auto path = folder.put("tree.dat", treeText(sampleTree(), GetParam()));
  const TreeFile file = readTree(path);
  EXPECT_EQ(file.tree.size(), sampleTree().size());
  EXPECT_THAT(file.notes, ::testing::ElementsAre(HasSubstr("tree.dat")));
  EXPECT_TRUE(isTreeFile(path));
}

TEST_P(TreeFormat, HoldsATreeOfASingleBranch) {
  const TempFolder folder;
  AirwayTree tree;
  tree.add({-1, Vec3(0, 0, 0), Vec3(0, 0, -1), 0.1});
  writeTree(folder / "tree.x.VTP", tree);
  expectEqualGeometry(readTree(folder.put("t", treeText(tree, GetParam()))).tree, tree);
}

INSTANTIATE_TEST_SUITE_P(Formats, TreeFormat, ::testing::Values("vtp", "swc", "csv", "json"),
                         [](const auto& parameter) { return std::string(parameter.param); });

TEST(WriteTree, RefusesWhatCouldNotBeReadBack) {
  const auto refused = [](const AirwayTree& tree, const char* reason) {
    for (const char* format : {"vtp", "swc", "csv", "json"}) {
      try {
        treeText(tree, format);
        ADD_FAILURE() << format << ": " << reason;
      } catch (const InvalidInput& error) {
        EXPECT_THAT(error.what(), HasSubstr(reason));
      }
    }
  };
  AirwayTree tree;
  refused(tree, "no branch");
  tree.add({-1, Vec3(0, 0, 0), Vec3(0, 0, -1), 0.1});
  AirwayTree twoRoots = tree;
  twoRoots.add({-1, Vec3(5, 0, 0), Vec3(5, 0, -1), 0.1});
  refused(twoRoots, "two roots");
  AirwayTree noRadius = tree;
  noRadius.setRadiusMm(0, 0.0);
  refused(noRadius, "radius of 0 mm");
  AirwayTree noNumber = tree;
  noNumber.add({0, Vec3(0, 0, -1), Vec3(0, std::nan(""), -2), 0.1});
  refused(noNumber, "branch 1 has a coordinate that is not a number");
  EXPECT_THROW(treeText(tree, "csv", {{"two words", ""}}), InvalidInput);
}

TEST(WriteTree, RefusesOtherExtensions) {
  const TempFolder folder;
  EXPECT_THROW(writeTree(folder / "tree.stl", sampleTree()), Unsupported);
  EXPECT_THROW(writeTree(folder / "tree", sampleTree()), Unsupported);
  EXPECT_EQ(folder.fileCount(), 0U);
}

TEST(TreeCsv, HasTheColumnsOfTheArrays) {
  const AirwayTree tree = sampleTree();
  const std::string text = treeText(tree, "csv");
  EXPECT_THAT(
      text, HasSubstr("\nid,parent,lobe,side,segment,generation,horsfield_order,"
                      "strahler_order,x0,y0,z0,x1,y1,z1,length_mm,diameter_mm,"
                      "flow_fraction,region_ml,terminal,origin,ending,supplied_ml\n0,-1,6,0,0,0,"));
}

TEST(TreeJson, TellsOrdersAndLengthsOfEveryBranch) {
  const AirwayTree tree = sampleTree();
  const auto json = nlohmann::json::parse(treeText(tree, "json"));
  ASSERT_EQ(json["branches"].size(), tree.size());
  const std::vector<int> order = strahlerOrders(tree);
  const std::vector<double> flow = flowFractions(tree);
  const std::vector<double> served = servedMl(tree);
  for (std::size_t i = 0; i < tree.size(); ++i) {
    const auto& branch = json["branches"][i];
    EXPECT_EQ(branch["strahler_order"], order[i]);
    EXPECT_EQ(branch["flow_fraction"], flow[i]);
    EXPECT_EQ(branch["region_ml"], served[i]);
    EXPECT_EQ(branch["ending"], static_cast<int>(tree[i].ending));
    EXPECT_EQ(branch["length_mm"], lengthMm(tree[i]));
    EXPECT_EQ(branch["diameter_mm"], 2.0 * tree[i].radiusMm);
  }
}

TEST(TreeJson, IsAsItsSchemaSays) {
  const test::JsonSchema schema(
      nlohmann::json::parse(readFile(std::string(PNEUMA_SCHEMAS) + "/tree.schema.json")));
  auto json = nlohmann::json::parse(treeText(sampleTree(), "json", SampleMetadata));
  EXPECT_THAT(schema.faults(json), ::testing::IsEmpty());
  json["branches"][1].erase("parent");
  EXPECT_THAT(schema.faults(json), ::testing::SizeIs(1));
}

/// `text` with every occurrence of `from` replaced.
std::string replaced(std::string text, const std::string& from, const std::string& to) {
  for (std::size_t at = text.find(from); at != std::string::npos; at = text.find(from, at)) {
    text.replace(at, from.size(), to);
    at += to.size();
  }
  return text;
}

TEST(ReadTree, TakesFilesFromBeforeEndingsWereWritten) {
  const TempFolder folder;
  AirwayTree tree;
  tree.add({-1, Vec3(0, 0, 0), Vec3(0, 0, -1), 0.1});
  const std::vector<std::pair<std::string, std::pair<std::string, std::string>>> changes = {
      {"vtp", {"Name=\"ending\"", "Name=\"unused\""}},
      {"csv", {",region_ml,terminal,origin,ending,", ",flow_fraction2,terminal,origin,unused,"}},
      {"json", {",\"ending\":0", ""}}};
  for (const auto& [format, change] : changes) {
    const std::string text = replaced(treeText(tree, format), change.first, change.second);
    EXPECT_THAT(text, ::testing::Not(HasSubstr("ending")));
    EXPECT_EQ(readTree(folder.put("old." + format, text)).tree[0].ending, Ending::None) << format;
  }
}

TEST(ReadTree, RefusesAnEndingThatIsNone) {
  const TempFolder folder;
  AirwayTree tree;
  tree.add({-1, Vec3(0, 0, 0), Vec3(0, 0, -1), 0.1});
  const std::string text = replaced(treeText(tree, "json"), "\"ending\":0", "\"ending\":4");
  try {
    readTree(folder.put("tree.json", text));
    ADD_FAILURE() << "an ending of 4 was read";
  } catch (const InvalidInput& error) {
    EXPECT_THAT(error.what(), HasSubstr("4 is no ending"));
  }
}

TEST(TreeVtp, NamesItsArraysAsDocumented) {
  const std::string text = treeText(sampleTree(), "vtp", {{"method", "centroid"}});
  for (const char* name : {"id",
                           "parent",
                           "lobe",
                           "side",
                           "segment",
                           "generation",
                           "horsfield_order",
                           "strahler_order",
                           "length_mm",
                           "diameter_mm",
                           "flow_fraction",
                           "region_ml",
                           "terminal",
                           "origin",
                           "ending",
                           "supplied_ml",
                           "radius",
                           "method",
                           "SPACE",
                           "units"}) {
    EXPECT_THAT(text, HasSubstr("Name=\"" + std::string(name) + "\""));
  }
}

TEST(TreeSwc, HoldsTheLobeInItsType) {
  AirwayTree tree;
  tree.add({-1, Vec3(1, 2, 3), Vec3(1, 2, -4), 2.5, Lobe::Central});
  tree.add({0, Vec3(1, 2, -4), Vec3(1, 5, -4), 1.5, Lobe::LeftUpper});
  const std::string text = treeText(tree, "swc");
  EXPECT_THAT(text, HasSubstr("\n1 11 1 2 3 2.5 -1\n2 11 1 2 -4 2.5 1\n3 9 1 5 -4 1.5 2\n"));
}

TEST(ReadTree, TurnsRasIntoLps) {
  const TempFolder folder;
  const AirwayTree tree = sampleTree();
  const std::vector<std::pair<std::string, std::pair<std::string, std::string>>> changes = {
      {"csv", {"SPACE: LPS", "SPACE: RAS"}},
      {"swc", {"SPACE: LPS", "SPACE: RAS"}},
      {"json", {"\"LPS\"", "\"RAS\""}}};
  for (const auto& [format, change] : changes) {
    std::string text = treeText(tree, format);
    text.replace(text.find(change.first), change.first.size(), change.second);
    const TreeFile file = readTree(folder.put("tree." + format, text));
    EXPECT_EQ(file.tree[1].distal,
              Vec3(-tree[1].distal.x(), -tree[1].distal.y(), tree[1].distal.z()));
    EXPECT_THAT(file.notes, ::testing::ElementsAre(HasSubstr("RAS")));
  }
}

TEST(IsTreeFile, LooksAtTheContentFirst) {
  const TempFolder folder;
  EXPECT_FALSE(isTreeFile(folder.put("report.json", "{\"schema\": \"pneuma/growth/1\"}")));
  EXPECT_FALSE(isTreeFile(folder.put("notes.csv", "name,age\nA,3\n")));
  EXPECT_FALSE(isTreeFile(folder.put("garbage.swc", std::string(100, '\0'))));
  EXPECT_TRUE(isTreeFile(folder.put("a.txt", "# neuron\n1 2 0 0 0 1 -1\n")));
  EXPECT_THROW(isTreeFile(folder / "none.vtp"), InputMissing);
}

}  // namespace
}  // namespace pneuma
