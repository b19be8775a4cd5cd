#include <cstdlib>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/error.h"
#include "io/tree_file.h"
#include "temp_folder.h"

namespace pneuma {
namespace {

using ::testing::HasSubstr;
using ::testing::IsEmpty;
using testing::TempFolder;

/// A VTP of poly-lines in ASCII, as a person might write it.
std::string vtp(const std::string& points, int pointCount, const std::string& radii,
                const std::vector<std::vector<int>>& lines,
                const std::string& radiusName = "radius", const std::string& field = "") {
  std::string connectivity;
  std::string offsets;
  std::size_t end = 0;
  for (const std::vector<int>& line : lines) {
    for (const int point : line) connectivity += std::to_string(point) + " ";
    offsets += std::to_string(end += line.size()) + " ";
  }
  return "<?xml version=\"1.0\"?>\n<VTKFile type=\"PolyData\" version=\"0.1\" "
         "byte_order=\"LittleEndian\">\n<PolyData>" +
         field + "\n<Piece NumberOfPoints=\"" + std::to_string(pointCount) + "\" NumberOfLines=\"" +
         std::to_string(lines.size()) + "\">\n<PointData><DataArray type=\"Float32\" Name=\"" +
         radiusName + "\" format=\"ascii\">" + radii +
         "</DataArray></PointData>\n<Points><DataArray type=\"Float32\" "
         "NumberOfComponents=\"3\" format=\"ascii\">" +
         points +
         "</DataArray></Points>\n<Lines><DataArray type=\"Int64\" Name=\"connectivity\" "
         "format=\"ascii\">" +
         connectivity + "</DataArray><DataArray type=\"Int64\" Name=\"offsets\" format=\"ascii\">" +
         offsets + "</DataArray></Lines>\n</Piece></PolyData></VTKFile>\n";
}

const std::string YPoints = "0 0 30  0 0 20  0 0 10  8 0 0  -8 0 0";

TreeFile treeIn(const std::string& name, const std::string& content) {
  const TempFolder folder;
  return readTree(folder.put(name, content));
}

void expectTreeRefused(const std::string& name, const std::string& content,
                       const std::string& reason) {
  try {
    treeIn(name, content);
    ADD_FAILURE() << "accepted, though: " << reason;
  } catch (const InvalidInput& error) {
    EXPECT_THAT(error.what(), HasSubstr(reason));
    EXPECT_THAT(error.what(), HasSubstr(name));
  }
}

TEST(ReadForeignVtp, MakesBranchesBetweenBifurcations) {
  for (const char* name : {"radius", "Radius", "MaximumInscribedSphereRadius"}) {
    const TreeFile file =
        treeIn("y.vtp", vtp(YPoints, 5, "4 3 2 1 1", {{0, 1, 2}, {2, 3}, {2, 4}}, name));
    ASSERT_EQ(file.tree.size(), 3U);
    EXPECT_EQ(file.tree[0].proximal, Vec3(0, 0, 30));
    EXPECT_EQ(file.tree[0].distal, Vec3(0, 0, 10));
    ASSERT_EQ(file.tree[0].via.size(), 1U);
    EXPECT_EQ(file.tree[0].via[0].position, Vec3(0, 0, 20));
    EXPECT_EQ(file.tree[0].via[0].radiusMm, 3.0);
    EXPECT_DOUBLE_EQ(file.tree[0].radiusMm, 3.0);  // mean along the way of 4, 3, 2
    EXPECT_DOUBLE_EQ(file.tree[1].radiusMm, 1.5);
    EXPECT_EQ(file.tree[1].parent, 0);
    EXPECT_EQ(file.tree[2].parent, 0);
    EXPECT_EQ(file.tree[2].origin, Origin::Measured);
    EXPECT_THAT(file.notes, IsEmpty());
  }
}

TEST(ReadForeignVtp, BeginsAtTheWidestEndWhateverTheDirectionOfTheLines) {
  const TreeFile file =
      treeIn("y.vtp", vtp(YPoints, 5, "4 3 2 1 1", {{3, 2}, {4, 2}, {1, 2}, {1, 0}}));
  ASSERT_EQ(file.tree.size(), 3U);
  EXPECT_EQ(file.tree[0].proximal, Vec3(0, 0, 30));
}

TEST(ReadForeignVtp, BeginsAtTheHighestOfEquallyWideEnds) {
  const TreeFile file =
      treeIn("y.vtp", vtp(YPoints, 5, "1 1 1 1 1", {{3, 2}, {4, 2}, {1, 2}, {1, 0}}));
  EXPECT_EQ(file.tree[0].proximal, Vec3(0, 0, 30));
}

TEST(ReadForeignVtp, BeginsWhereAllLinesLeadAwayFrom) {
  const TreeFile file = treeIn("y.vtp", vtp(YPoints, 5, "1 1 1 1 9", {{0, 1, 2}, {2, 3}, {2, 4}}));
  EXPECT_EQ(file.tree[0].proximal, Vec3(0, 0, 30));
}

TEST(ReadForeignVtp, JoinsPointsAtTheSamePlaceAndLinesThatRepeat) {
  // Two lines from the root to the ends, each with its own points: as centreline extractors write.
  const std::string points = "0 0 30  0 0 10  8 0 0   0 0 30  0 0 10  -8 0 -0.0";
  const TreeFile file = treeIn("y.vtp", vtp(points, 6, "4 2 1 4 2 1", {{0, 1, 2}, {3, 4, 5}}));
  EXPECT_EQ(file.tree.size(), 3U);
}

TEST(ReadForeignVtp, TurnsRasIntoLps) {
  const std::string field =
      "<FieldData><Array type=\"String\" Name=\"SPACE\" NumberOfTuples=\"1\" format=\"ascii\">"
      "82 65 83 0</Array></FieldData>";
  const TreeFile file =
      treeIn("y.vtp", vtp(YPoints, 5, "4 3 2 1 1", {{0, 1, 2}, {2, 3}, {2, 4}}, "radius", field));
  EXPECT_EQ(file.tree[1].distal, Vec3(-8, 0, 0));
  EXPECT_THAT(file.notes, ::testing::ElementsAre(HasSubstr("RAS")));
}

TEST(ReadForeignVtp, NamesWhatIsWrong) {
  const std::vector<std::vector<int>> y = {{0, 1, 2}, {2, 3}, {2, 4}};
  const std::string radii = "4 3 2 1 1";
  expectTreeRefused("a.vtp", vtp(YPoints, 5, radii, {{0, 1, 2}, {2, 3}, {3, 4}, {4, 2}}), "cycle");
  expectTreeRefused("a.vtp", vtp(YPoints, 5, radii, {{0, 1, 2, 0}}), "cycle");
  expectTreeRefused("a.vtp", vtp(YPoints, 5, radii, {{0, 1, 2}, {3, 4}}), "several pieces");
  expectTreeRefused("a.vtp", vtp(YPoints, 5, radii, y, "width"), "no point array \"radius\"");
  expectTreeRefused("a.vtp", vtp(YPoints, 5, "4 3 0 1 1", y), "radius of 0 mm");
  expectTreeRefused("a.vtp", vtp(YPoints, 5, "4 3 -2 1 1", y), "radius of -2 mm");
  expectTreeRefused("a.vtp", vtp(YPoints, 5, "4 3 nan 1 1", y), "a.vtp");
  expectTreeRefused("a.vtp", vtp("0 0 30 0 0 nan 0 0 10 8 0 0 -8 0 0", 5, radii, y), "a.vtp");
  expectTreeRefused("a.vtp", vtp(YPoints, 5, radii, {{0, 1, 2}, {2, 3}, {2, 5}}), "point 5 of 5");
  expectTreeRefused("a.vtp", vtp(YPoints, 5, radii, {{0, 1, 2}, {2, -3}}), "point -3 of 5");
  expectTreeRefused("a.vtp", vtp(YPoints, 5, radii, {}), "no line");
  expectTreeRefused("a.vtp", vtp(YPoints, 2000000, radii, y), "too short");
}

TEST(ReadRealCentrelines, FindsTheTreeOfTheSubject) {
  const char* data = std::getenv("PNEUMA_TEST_DATA");
  if (data == nullptr || *data == '\0') GTEST_SKIP() << "PNEUMA_TEST_DATA is not set";
  const TreeFile file =
      readTree(std::string(data) + "/lobes_airways_chaste/TestSubject002MajorAirways.vtu");
  EXPECT_EQ(file.format, "VTU");
  EXPECT_EQ(terminalCount(file.tree), 83U);
  EXPECT_EQ(file.tree.size(), 165U);
  std::size_t points = 1;
  double highest = -1e9;
  for (const Branch& branch : file.tree) {
    points += 1 + branch.via.size();
    highest = std::max(highest, branch.distal.z());
    EXPECT_EQ(branch.origin, Origin::Measured);
  }
  EXPECT_EQ(points, 12065U);
  EXPECT_GT(file.tree[0].proximal.z(), highest);
  EXPECT_THAT(file.notes, IsEmpty());
}

constexpr const char* Swc =
    "# from elsewhere\n1 1 0 0 30 4 -1\n2 1 0 0 20 3 1\n3 1 0 0 10 2 2\n4 1 8 0 0 1 3\n"
    "5 1 -8 0 0 1 3\n";

TEST(ReadForeignSwc, MakesBranchesBetweenBifurcations) {
  const TreeFile file = treeIn("y.swc", Swc);
  ASSERT_EQ(file.tree.size(), 3U);
  EXPECT_EQ(file.tree[0].via.size(), 1U);
  EXPECT_DOUBLE_EQ(file.tree[0].radiusMm, 3.0);
  EXPECT_EQ(file.tree[2].distal, Vec3(-8, 0, 0));
  EXPECT_EQ(file.tree[2].lobe, Lobe::Whole);
}

TEST(ReadForeignSwc, TakesChildrenBeforeTheirParents) {
  const TreeFile file = treeIn("y.swc",
                               "5 1 -8 0 0 1 3\n4 1 8 0 0 1 3\n3 1 0 0 10 2 2\n2 1 0 0 20 3 1\n"
                               "1 1 0 0 30 4 -1\n");
  ASSERT_EQ(file.tree.size(), 3U);
  EXPECT_EQ(file.tree[0].proximal, Vec3(0, 0, 30));
}

TEST(ReadForeignSwc, NamesWhatIsWrongAndWhere) {
  expectTreeRefused("a.swc", "1 5 0 0 1 9 -1\n2 5 0 0 0\n", "line 2 has 5 columns");
  expectTreeRefused("a.swc", "1 5 0 0 1 9 -1\n2 5 0 x 0 1 1\n", "line 2, column 4 (y): \"x\"");
  expectTreeRefused("a.swc", "1 5 0 0 1 9 -1\n2 5 0 nan 0 1 1\n", "line 2, column 4 (y)");
  expectTreeRefused("a.swc", "1 5 0 0 1 9 -1\n2 5 0 0 0 0 1\n", "line 2: the radius is 0");
  expectTreeRefused("a.swc", "1 5 0 0 1 9 -1\n2.5 5 0 0 0 1 1\n", "not a whole number");
  expectTreeRefused("a.swc", "1 5 0 0 1 9 -1\n2 5 0 0 0 1 7\n", "line 2: the parent 7");
  expectTreeRefused("a.swc", "1 5 0 0 1 9 -1\n2 5 0 0 0 1 2\n",
                    "line 2: point 2 is its own parent");
  expectTreeRefused("a.swc", "1 5 0 0 1 9 -1\n1 5 0 0 0 1 1\n", "line 2: the id 1");
  expectTreeRefused("a.swc", "1 5 0 0 1 9 -1\n2 5 0 0 0 1 -1\n", "two roots");
  expectTreeRefused("a.swc", "1 5 0 0 1 9 2\n2 5 0 0 0 1 1\n", "cycle");
  expectTreeRefused("a.swc", "1 5 0 0 2 9 -1\n2 5 0 0 0 1 1\n3 5 0 0 5 1 4\n4 5 0 0 6 1 3\n",
                    "cycle");
  expectTreeRefused("a.swc", "1 5 0 0 1 9 -1\n", "fewer than two");
  expectTreeRefused("a.swc", "1 5 0 0 2 9 -1\n2 5 0 0 0 1 1\n3 5 0 0 5 1 1\n",
                    "divides at its very first");
  expectTreeRefused("a.swc", "just words\n", "line 1 has 2 columns");
  expectTreeRefused("a.swc", "# only comments\n", "fewer than two");
}

const std::string CsvHead = "id,parent,x0,y0,z0,x1,y1,z1,diameter_mm\n";

TEST(ReadForeignCsv, TakesAnyIdsDelimiterAndLineEnds) {
  const TreeFile file = treeIn("a.csv",
                               "\xEF\xBB\xBFparent;\"id\";x0;y0;z0;x1;y1;z1;Diameter_mm;mood\r\n"
                               "-1;70;0;0;0;1;0;-1;1.5;good\r\n70;5;1;0;-1;1;0;-2;1;bad");
  ASSERT_EQ(file.tree.size(), 2U);
  EXPECT_EQ(file.tree[1].parent, 0);
  EXPECT_EQ(file.tree[1].radiusMm, 0.5);
  EXPECT_THAT(file.notes, ::testing::ElementsAre(HasSubstr("\"mood\"")));
}

TEST(ReadForeignCsv, PutsChildrenAfterTheirParents) {
  const TreeFile file = treeIn(
      "a.csv", CsvHead + "5,70,0,0,0,1,0,-1,1.5\n70,-1,0,0,9,0,0,0,3\n6,70,0,0,0,2,0,-1,1.5\n");
  ASSERT_EQ(file.tree.size(), 3U);
  EXPECT_EQ(file.tree[0].radiusMm, 1.5);
  EXPECT_EQ(file.tree[1].distal, Vec3(1, 0, -1));
  EXPECT_EQ(file.tree[1].parent, 0);
  EXPECT_EQ(file.tree[1].origin, Origin::Measured);
  EXPECT_THAT(file.notes, ::testing::ElementsAre(HasSubstr("put in order")));
}

TEST(ReadForeignCsv, NamesWhatIsWrongAndWhere) {
  const std::string root = "0,-1,0,0,9,0,0,0,3\n";
  expectTreeRefused("a.csv", "id,parent,x0\n", "no column \"y0\"");
  expectTreeRefused("a.csv", "id,id,parent,x0\n", "two columns \"id\"");
  expectTreeRefused("a.csv", CsvHead, "no branch");
  expectTreeRefused("a.csv", CsvHead + root + "1,0,0,0,0,1,0\n", "line 3 has 7 columns");
  expectTreeRefused("a.csv", CsvHead + root + "1,0,0,0,zero,1,0,-1,1\n",
                    "line 3, column z0: \"zero\"");
  expectTreeRefused("a.csv", CsvHead + root + "1,0,0,0,inf,1,0,-1,1\n", "line 3, column z0");
  expectTreeRefused("a.csv", CsvHead + root + "1.5,0,0,0,0,1,0,-1,1\n", "line 3, column id");
  expectTreeRefused("a.csv", CsvHead + root + "1,0,0,0,0,1,0,-1,0\n", "line 3, column diameter_mm");
  expectTreeRefused("a.csv", CsvHead + root + "1,1,0,0,0,1,0,-1,1\n", "own parent");
  expectTreeRefused("a.csv", CsvHead + root + "1,8,0,0,0,1,0,-1,1\n", "names branch 8");
  expectTreeRefused("a.csv", CsvHead + root + root, "id 0");
  expectTreeRefused("a.csv", CsvHead + root + "1,-1,0,0,0,1,0,-1,1\n", "two roots");
  expectTreeRefused("a.csv", CsvHead + root + "1,2,0,0,0,1,0,-1,1\n2,1,0,0,0,1,0,-1,1\n", "cycle");
  expectTreeRefused("a.csv", CsvHead + "1,2,0,0,0,1,0,-1,1\n2,1,0,0,0,1,0,-1,1\n", "cycle");
}

TEST(ReadForeignJson, NamesWhatIsWrongAndWhere) {
  const auto json = [](const std::string& branches) {
    return "{\"schema\":\"pneuma/tree/1\",\"branches\":" + branches + "}";
  };
  const std::string root =
      "{\"id\":0,\"parent\":-1,\"proximal\":[0,0,1],\"distal\":[0,0,0],\"diameter_mm\":2}";
  EXPECT_EQ(treeIn("a.json", json("[" + root + "]")).tree.size(), 1U);
  expectTreeRefused("a.json", "{\"schema\":\"pneuma/growth/1\"}", "\"schema\" is not");
  expectTreeRefused("a.json", "{\"schema\":\"pneuma/tree/1\"}", "no list \"branches\"");
  expectTreeRefused("a.json", json("[]"), "no branch");
  expectTreeRefused("a.json", json("[1]"), "entry 0 of \"branches\" is not an object");
  expectTreeRefused("a.json", json("[[]]"), "entry 0 of \"branches\" is a list");
  expectTreeRefused("a.json", json("[{}]"), "has no \"id\"");
  expectTreeRefused("a.json", json("[" + root + "," + root + "]"), "id 0");
  const auto changed = [&](const std::string& from, const std::string& to) {
    std::string text = root;
    text.replace(text.find(from), from.size(), to);
    return json("[" + text + "]");
  };
  expectTreeRefused("a.json", changed("[0,0,1]", "[0,1]"), "\"proximal\"");
  expectTreeRefused("a.json", changed("[0,0,1]", "[0,\"a\",1]"), "\"proximal\"");
  expectTreeRefused("a.json", changed("[0,0,1]", "[[0,0,1]]"), "\"proximal\"");
  expectTreeRefused("a.json", changed("[0,0,1]", "5"), "\"proximal\"");
  expectTreeRefused("a.json", changed("\"id\":0", "\"id\":[0]"), "\"id\"");
  expectTreeRefused("a.json", changed("\"id\":0", "\"id\":0.5"), "\"id\"");
  expectTreeRefused("a.json", changed("\"id\":0", "\"id\":null"), "\"id\"");
  expectTreeRefused("a.json", changed("\"id\":0", "\"lobe\":7,\"id\":0"), "no lobe");
  expectTreeRefused("a.json", changed("\"id\":0", "\"via\":[[1,2,3]],\"id\":0"), "\"via\"");
  expectTreeRefused("a.json", changed(":2}", ":1e999}"), "a.json");
  expectTreeRefused("a.json", json("[" + root), "damaged or cut off");
}

}  // namespace
}  // namespace pneuma
