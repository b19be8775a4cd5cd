#include "io/fissure_file.h"

#include <cmath>
#include <filesystem>

#include <gtest/gtest.h>

#include "core/error.h"
#include "io/atomic_file.h"
#include "io/surface_file.h"

namespace pneuma {
namespace {

class FissureFileTest : public ::testing::Test {
 protected:
  std::filesystem::path file(const std::string& name, const std::string& content) const {
    const auto path = folder_ / name;
    writeFile(path, content);
    return path;
  }

  std::string refusal(const std::string& name, const std::string& content) const {
    try {
      readFissures(file(name, content));
    } catch (const Error& error) {
      return error.what();
    }
    return "";
  }

  void SetUp() override { std::filesystem::create_directories(folder_); }

  void TearDown() override { std::filesystem::remove_all(folder_); }

  std::filesystem::path folder_ = std::filesystem::path(::testing::TempDir()) /
                                  ::testing::UnitTest::GetInstance()->current_test_info()->name();
};

TEST_F(FissureFileTest, IsReadAsItWasWritten) {
  GivenFissures sets;
  sets[Fissure::RightOblique].points = {{1.5, -2.25, 3.0}, {0.1, 1e-17, -1e9}, {4.0, 5.0, 6.0}};
  sets[Fissure::LeftOblique].points = {{7.0, 8.0, 9.0}};
  sets[Fissure::LeftOblique].weights = {0.5};
  writeFissures(folder_ / "f.json", sets);
  const GivenFissures back = readFissures(folder_ / "f.json");
  ASSERT_EQ(back.size(), 2U);
  EXPECT_EQ(back.at(Fissure::RightOblique).points, sets[Fissure::RightOblique].points);
  EXPECT_TRUE(back.at(Fissure::RightOblique).weights.empty());
  EXPECT_EQ(back.at(Fissure::LeftOblique).weights, sets[Fissure::LeftOblique].weights);
}

TEST_F(FissureFileTest, ReadsPlanes) {
  GivenFissures given;
  given[Fissure::RightHorizontal].plane = FissurePlane{{1.0, 2.0, 3.0}, {0.0, -0.5, 2.0}};
  writeFissures(folder_ / "p.json", given);
  const GivenFissures back = readFissures(folder_ / "p.json");
  ASSERT_TRUE(back.at(Fissure::RightHorizontal).plane);
  EXPECT_EQ(back.at(Fissure::RightHorizontal).plane->point, Vec3(1.0, 2.0, 3.0));
  EXPECT_EQ(back.at(Fissure::RightHorizontal).plane->normal, Vec3(0.0, -0.5, 2.0));
  EXPECT_NE(refusal("flat.json",
                    R"({"schema":"pneuma/fissures/1","fissures":{"left-oblique":{"plane":
                       {"point":[0,0,0],"normal":[0,0,0]}}}})")
                .find("normal without length for \"left-oblique\""),
            std::string::npos);
}

TEST_F(FissureFileTest, ReadsPlanesByHandlesAndByAngles) {
  const auto normal = [&](const std::string& plane) {
    const GivenFissures given = readPlanes(file(
        "p.json",
        R"({"schema":"pneuma/fissures/1","fissures":{"left-oblique":{"plane":)" + plane + "}}}"));
    return given.at(Fissure::LeftOblique).plane->normal;
  };
  EXPECT_NEAR(
      (normal(R"({"handles": [[0,0,0],[10,0,0],[0,10,10]]})") - Vec3(0.0, -1.0, 1.0).normalized())
          .norm(),
      0.0, 1e-12);
  const double half = std::sqrt(0.5);
  const auto expect = [&](const std::string& angles, const Vec3& wanted) {
    EXPECT_NEAR((normal(R"({"point": [1, 2, 3], )" + angles + "}") - wanted).norm(), 0.0, 1e-12)
        << angles;
  };
  expect(R"("tilt_deg": 0)", Vec3::UnitZ());
  expect(R"("tilt_deg": 45)", {0.0, -half, half});                // its back edge is raised
  expect(R"("tilt_deg": 0, "turn_deg": 45)", {half, 0.0, half});  // its left edge sinks
  expect(R"("tilt_deg": 90, "turn_deg": 45)", {0.0, -1.0, 0.0});  // tilted first
}

TEST_F(FissureFileTest, ReadsEquationsAsTheyWereWritten) {
  GivenFissures given;
  given[Fissure::RightOblique].equation =
      FissureEquation{{1.0, 2.0, 3.0}, {-44.719, 0.125, 1.15, 1e-4, 0.0, -0.0009}};
  writeFissures(folder_ / "e.json", given);
  const auto back = readFissures(folder_ / "e.json").at(Fissure::RightOblique).equation;
  ASSERT_TRUE(back);
  EXPECT_EQ(back->origin, Vec3(1.0, 2.0, 3.0));
  EXPECT_EQ(back->coefficients, given[Fissure::RightOblique].equation->coefficients);
  const auto some = readFissures(file(
      "s.json",
      R"({"schema":"pneuma/fissures/1","fissures":{"left-oblique":{"equation":{"1":-4,"yy":2}}}})"));
  EXPECT_EQ(some.at(Fissure::LeftOblique).equation->coefficients,
            (std::array<double, 6>{-4.0, 0.0, 0.0, 0.0, 0.0, 2.0}));
  EXPECT_THROW(readPlanes(folder_ / "s.json"), InvalidInput);
  EXPECT_THROW(writeFissures(folder_ / "e.csv", given), Unsupported);
}

TEST_F(FissureFileTest, ReadsSurfacesFromFilesBesideIt) {
  const TriangleMesh mesh{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0.5}}, {{0, 1, 2}}};
  std::filesystem::create_directories(folder_ / "patches");
  writeSurface(folder_ / "patches" / "lo.vtp", mesh);
  const std::string text =
      R"({"schema":"pneuma/fissures/1","fissures":{"left-oblique":{"surface":"patches/lo.vtp"}}})";
  const GivenFissures given = readFissures(file("s.json", text));
  ASSERT_TRUE(given.at(Fissure::LeftOblique).patch);
  EXPECT_EQ(given.at(Fissure::LeftOblique).patch->mesh->points, mesh.points);
  EXPECT_EQ(patchFiles({given, {}}).size(), 1U);
  // Written into another folder it names the same file.
  std::filesystem::create_directories(folder_ / "out");
  writeFissures(folder_ / "out" / "s.json", given);
  EXPECT_EQ(readFissures(folder_ / "out" / "s.json").at(Fissure::LeftOblique).patch->mesh->points,
            mesh.points);
  EXPECT_THROW(writeFissures(folder_ / "s.mrk.json", given), Unsupported);
  EXPECT_THROW(readFissures(file("out/t.json", text)), InputMissing);
}

TEST_F(FissureFileTest, ReadsAccessoryFissuresAsTheyWereWritten) {
  GivenFissure plane;
  plane.plane = FissurePlane{{1.0, 2.0, 3.0}, {0.0, 0.0, 1.0}};
  const std::vector<AccessoryFissure> accessory = {
      {"left-horizontal", Lobe::LeftUpper, plane},
      {"azygos", Lobe::RightUpper, {{{1.0, 2.0, 3.0}}, {}, {}, {}, {}}}};
  writeFissures(folder_ / "a.json", {}, accessory);
  const FissureFile back = readFissureFile(folder_ / "a.json");
  EXPECT_TRUE(back.fissures.empty());
  ASSERT_EQ(back.accessory.size(), 2U);
  EXPECT_EQ(back.accessory[0].name, "left-horizontal");
  EXPECT_EQ(back.accessory[0].lobe, Lobe::LeftUpper);
  EXPECT_TRUE(back.accessory[0].fissure.plane);
  EXPECT_EQ(back.accessory[1].fissure.points, accessory[1].fissure.points);
  EXPECT_THROW(readPlanes(folder_ / "a.json"), InvalidInput);
  EXPECT_THROW(writeFissures(folder_ / "a.fcsv", {}, accessory), Unsupported);
}

TEST_F(FissureFileTest, ReadsTheChestImagingPlatformsCsv) {
  const GivenFissures sets =
      readFissures(file("points.csv",
                        "Region, Type, X Location, Y Location, Z Location\r\n"
                        "RIGHTLUNG,OBLIQUEFISSURE,-126.178,-249.783,-548\r\n"
                        "RIGHTLUNG, HORIZONTALFISSURE, 1, 2, 3\r\n"
                        "LEFTLUNG,OBLIQUEFISSURE,4,5,6\r\n"
                        "UNDEFINEDREGION,VESSEL,0,0,0\r\n"
                        "\r\n"));
  ASSERT_EQ(sets.size(), 3U);
  EXPECT_EQ(sets.at(Fissure::RightOblique).points[0], Vec3(-126.178, -249.783, -548.0));
  EXPECT_EQ(sets.at(Fissure::RightHorizontal).points[0], Vec3(1.0, 2.0, 3.0));
  EXPECT_EQ(sets.at(Fissure::LeftOblique).points[0], Vec3(4.0, 5.0, 6.0));
}

TEST_F(FissureFileTest, ReadsCsvWhoseRegionsAreLobesInAnyCase) {
  // As in some files of LungLobeAtlasData.
  const GivenFissures sets = readFissures(file("lobes.csv",
                                               "Region,Type,X Location,Y Location, Z Location\n"
                                               "RightInferiorLobe,ObliqueFissure,1,2,3\n"
                                               "RIGHTSUPERIORLOBE,HORIZONTALFISSURE,4,5,6\n"
                                               "LeftSuperiorLobe,ObliqueFissure,7,8,9\n"
                                               "LEFTSUPERIORLOBE,UNDEFINEDTYPE,0,0,0\n"));
  ASSERT_EQ(sets.size(), 3U);
  EXPECT_EQ(sets.at(Fissure::RightOblique).points[0], Vec3(1.0, 2.0, 3.0));
  EXPECT_EQ(sets.at(Fissure::RightHorizontal).points[0], Vec3(4.0, 5.0, 6.0));
  EXPECT_EQ(sets.at(Fissure::LeftOblique).points[0], Vec3(7.0, 8.0, 9.0));
  EXPECT_EQ(sets.at(Fissure::LeftOblique).points.size(), 1U);
}

TEST_F(FissureFileTest, IsReadAsItWasWrittenInEveryFormat) {
  GivenFissures sets;
  sets[Fissure::RightOblique].points = {{1.5, -2.25, 3.0}, {0.1, 1e-17, -1e9}, {4.0, 5.0, 6.0}};
  sets[Fissure::RightHorizontal].points = {{-1.0, 2.0, 0.3}};
  sets[Fissure::LeftOblique].points = {{7.0, 8.0, 9.0}, {1.0 / 3.0, 0.0, 0.0}};
  for (const std::string name : {"f.mrk.json", "f.fcsv", "f.csv"}) {
    writeFissures(folder_ / name, sets);
    const GivenFissures back = readFissures(folder_ / name);
    ASSERT_EQ(back.size(), 3U) << name;
    for (const auto& [fissure, set] : sets) EXPECT_EQ(back.at(fissure).points, set.points) << name;
  }
  // As markups it is known by its content too.
  std::filesystem::copy(folder_ / "f.mrk.json", folder_ / "plain.json");
  EXPECT_EQ(readFissures(folder_ / "plain.json").size(), 3U);
}

TEST_F(FissureFileTest, WritesNothingThatAFormatDoesNotHave) {
  GivenFissures sets;
  sets[Fissure::LeftOblique].points = {{7.0, 8.0, 9.0}};
  EXPECT_THROW(writeFissures(folder_ / "f.txt", sets), Unsupported);
  sets[Fissure::LeftOblique].weights = {0.5};
  EXPECT_THROW(writeFissures(folder_ / "f.fcsv", sets), Unsupported);
  GivenFissures planes;
  planes[Fissure::LeftOblique].plane = FissurePlane{};
  EXPECT_THROW(writeFissures(folder_ / "f.mrk.json", planes), Unsupported);
  EXPECT_TRUE(std::filesystem::is_empty(folder_));
}

TEST_F(FissureFileTest, ReadsMarkupsInTheirFrame) {
  const GivenFissures sets = readFissures(file("m.mrk.json", R"({
    "@schema": "https://raw.githubusercontent.com/slicer/slicer/master/Modules/Loadable/Markups/Resources/Schema/markups-schema-v1.0.0.json#",
    "markups": [
      {"type": "Fiducial", "coordinateSystem": "RAS", "controlPoints": [
        {"label": "right-oblique-3", "position": [1, 2, 3]},
        {"label": "Right Minor Fissure 12", "position": [4, 5, 6], "positionStatus": "defined"},
        {"label": "RO2", "position": null, "positionStatus": "undefined"}]},
      {"type": "Curve", "name": "LO", "coordinateSystem": 1, "coordinateUnits": "mm",
       "controlPoints": [{"label": "F-1", "position": [7, 8, 9]}]},
      {"controlPoints": []}]})"));
  ASSERT_EQ(sets.size(), 3U);
  EXPECT_EQ(sets.at(Fissure::RightOblique).points, std::vector<Vec3>{Vec3(-1.0, -2.0, 3.0)});
  EXPECT_EQ(sets.at(Fissure::RightHorizontal).points, std::vector<Vec3>{Vec3(-4.0, -5.0, 6.0)});
  EXPECT_EQ(sets.at(Fissure::LeftOblique).points, std::vector<Vec3>{Vec3(7.0, 8.0, 9.0)});
  const GivenFissures byFile = readFissures(file(
      "left_oblique.mrk.json", R"({"markups": [{"controlPoints": [{"position": [1, 2, 3]}]}]})"));
  EXPECT_EQ(byFile.begin()->first, Fissure::LeftOblique);
}

TEST_F(FissureFileTest, ReadsOldMarkupsWithTheirColumns) {
  const GivenFissures sets = readFissures(
      file("m.fcsv",
           "# Markups fiducial file version = 4.13\r\n# CoordinateSystem = 0\r\n"
           "# columns = id,x,y,z,ow,ox,oy,oz,vis,sel,lock,label,desc,associatedNodeID\r\n"
           "1,1,2,3,0,0,0,1,1,1,0,left-oblique-1,\"a, b\",,2,0\r\n"
           "2,9,9,9,0,0,0,1,1,1,0,left-oblique-2,,,0,0\r\n\r\n"
           "3,4,5,6,0,0,0,1,1,1,0,RH,,\r\n"));
  ASSERT_EQ(sets.size(), 2U);
  EXPECT_EQ(sets.at(Fissure::LeftOblique).points, std::vector<Vec3>{Vec3(-1.0, -2.0, 3.0)});
  EXPECT_EQ(sets.at(Fissure::RightHorizontal).points, std::vector<Vec3>{Vec3(-4.0, -5.0, 6.0)});
  const GivenFissures others =
      readFissures(file("m.fcsv", "# CoordinateSystem = LPS\n# columns = label,x,y,z\nRO,1,2,3\n"));
  EXPECT_EQ(others.at(Fissure::RightOblique).points, std::vector<Vec3>{Vec3(1.0, 2.0, 3.0)});
}

TEST_F(FissureFileTest, SaysWhereMarkupsAreWrong) {
  const auto expect = [&](const std::string& name, const std::string& content,
                          const std::string& says) {
    const std::string found = refusal(name, content);
    EXPECT_NE(found.find(says), std::string::npos) << content << ": " << found;
  };
  const auto list = [](const std::string& entry) {
    return R"({"markups": [{"controlPoints": []}, {)" + entry + "}]}";
  };
  const auto point = [&](const std::string& entry) {
    return list(R"("name": "LO", "controlPoints": [{"position": [1, 2, 3]}, {)" + entry + "}]");
  };
  expect("a.mrk.json", "[]", "no array \"markups\"");
  expect("a.mrk.json", R"({"markups": [1]})", "no object as list 1");
  expect("a.mrk.json", R"({"markups": []})", "no defined points");
  expect("a.mrk.json", list(""), "no array \"controlPoints\" in list 2");
  expect("a.mrk.json", list(R"("type": "Plane")"), "of type \"Plane\" as list 2");
  expect("a.mrk.json", list(R"("coordinateUnits": "um")"), "not mm, in list 2");
  expect("a.mrk.json", list(R"("coordinateSystem": "IJK")"), "frame \"IJK\"; there are LPS");
  expect("a.mrk.json", point(R"("position": [1, 2])"), "position of point 2 of list 2");
  expect("a.mrk.json", point(R"("position": [1, 2, "nan"])"), "position of point 2 of list 2");
  expect("a.mrk.json", point(R"("position": [1, 2, NaN])"), "is no JSON near byte");
  expect("a.mrk.json", list(R"("controlPoints": [{"label": "F-7", "position": [1, 2, 3]}])"),
         "which fissure point 1 of list 2 lies (named \"F-7\", \"a\"); call points");
  const std::string head = "# CoordinateSystem = LPS\n# columns = label,x,y,z\n";
  expect("a.fcsv", "RO,1,2,3\n", "frame before line 1");
  expect("a.fcsv", "# CoordinateSystem = 2\n", "frame \"2\"");
  expect("a.fcsv", "# columns = id,x,y,label\n", "no column \"z\"");
  expect("a.fcsv", head + "RO,1,2\n", "3 fields in line 3, not 4");
  expect("a.fcsv", head + "RO,1,2,inf\n", "no number in line 3: 'inf'");
  expect("a.fcsv", head + "middle,1,2,3\n", "fissure the point in line 3 lies (named \"middle\"");
  expect("a.fcsv", head, "holds no points");
}

TEST_F(FissureFileTest, SaysWhereAFileIsWrong) {
  const auto json = [](const std::string& entry) {
    return R"({"schema": "pneuma/fissures/1", "fissures": {"left-oblique": )" + entry + "}}";
  };
  const auto expect = [&](const std::string& name, const std::string& content,
                          const std::string& says) {
    const std::string found = refusal(name, content);
    EXPECT_NE(found.find(says), std::string::npos) << content << ": " << found;
  };
  expect("a.json", "[]", "holds no fissures");
  expect("a.json", R"({"schema": "pneuma/fissures/2"})", "holds no fissures");
  expect("a.json", R"({"schema": "pneuma/fissures/1", "space": "RAS"})", "not in the frame LPS");
  expect("a.json", R"({"schema": "pneuma/fissures/1"})", "no object under");
  expect("a.json", json("{}"), "no array");
  expect("a.json", json(R"({"points": [[1, 2, "3"]]})"), "point 1 of \"left-oblique\"");
  expect("a.json", json(R"({"points": [[1, 2, 3], [1, 2]]})"), "point 2");
  expect("a.json", json(R"({"points": [[1, 2, 1e999]]})"), "too large");
  expect("a.json", json(R"({"points": [[1, 2, 3]], "weights": []})"), "one weight for each point");
  expect("a.json", json(R"({"points": [[1, 2, 3]], "weights": [0]})"), "no positive number");
  expect("a.json", json(R"({"points": [], "plane": {}})"), "in two ways");
  expect("a.json", json(R"({"plane": {"point": [1, 2, 3]}})"), "neither \"point\" and");
  expect("a.json", json(R"({"plane": {"handles": [[1, 2, 3], [1, 2, 3]]}})"), "no three handles");
  expect("a.json", json(R"({"plane": {"handles": [[1, 2, 3], [2, 3, 4], [3, 4, 5]]}})"),
         "handles of the plane of \"left-oblique\" that lie on one line");
  expect("a.json", json(R"({"plane": {"point": [1, 2, 3], "tilt_deg": 91}})"), "-90 to 90 as tilt");
  expect("a.json", json(R"({"equation": {"origin": [1, 2, 3]}})"), "no term of the equation");
  const auto accessory = [](const std::string& entry) {
    return R"({"schema": "pneuma/fissures/1", "accessory": [)" + entry + "]}";
  };
  expect("a.json", accessory(R"({"name": "../x", "lobe": "lul"})"), "no name of its own");
  expect("a.json", accessory(R"({"name": "left-oblique", "lobe": "lul"})"), "no name of its own");
  expect("a.json", accessory(R"({"name": "x", "lobe": "left"})"), "no lobe as \"lobe\" of \"x\"");
  expect("a.json", accessory(R"({"name": "x", "lobe": "LUL"})"), "no array \"points\"");
  expect("a.json", json(R"({"surface": 3})"), "no file's name as surface");
  expect("a.json", json(R"({"equation": {"xxx": 3}})"), "a term \"xxx\"");
  expect("a.json", json(R"({"equation": {"x": "3"}})"), "no number as term \"x\"");
  expect("a.csv", "Region,Type,X,Y,Z\nRIGHTLUNG,OBLIQUEFISSURE,1,2\n", "4 fields in line 2");
  expect("a.csv", "Region,Type,X,Y,Z\nRIGHTLUNG,OBLIQUEFISSURE,1,2,nan\n", "no number in line 2");
  expect("a.csv", "Region,Type,X,Y,Z\n", "holds no points");
  expect("a.csv", "Region,Type,X,Y,Z\nRIGHTLUNG,OBLIQUEFISSURE,1,2,1e300\n",
         "right oblique fissure at (1, 2, 1e+300) mm, more than 10,000 km away");
  expect("a.json", json(R"({"plane": {"point": [1, -1e18, 3], "tilt_deg": 9}})"),
         "left oblique fissure at (1, -1e+18, 3) mm, more than 10,000 km away");
  expect("a.txt", "1 2 3", "cannot be read as points");
}

}  // namespace
}  // namespace pneuma
