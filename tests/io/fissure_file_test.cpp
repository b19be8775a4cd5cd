#include "io/fissure_file.h"

#include <filesystem>

#include <gtest/gtest.h>

#include "core/error.h"
#include "io/atomic_file.h"

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
  expect("a.csv", "Region,Type,X,Y,Z\nRIGHTLUNG,OBLIQUEFISSURE,1,2\n", "4 fields in line 2");
  expect("a.csv", "Region,Type,X,Y,Z\nRIGHTLUNG,OBLIQUEFISSURE,1,2,nan\n", "no number in line 2");
  expect("a.csv", "Region,Type,X,Y,Z\n", "holds no points");
  expect("a.txt", "1 2 3", "cannot be read as points");
}

}  // namespace
}  // namespace pneuma
