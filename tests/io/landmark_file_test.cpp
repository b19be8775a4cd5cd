#include "io/landmark_file.h"

#include <filesystem>
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/error.h"
#include "io/atomic_file.h"
#include "io/refusal.h"

namespace pneuma {
namespace {

using ::testing::HasSubstr;

class LandmarkFileTest : public ::testing::Test {
 protected:
  std::vector<LandmarkPair> read(const std::string& content) const {
    writeFile(path_, content);
    return readLandmarkPairs(path_);
  }

  using Files = std::vector<std::string>;

  /// One file or two.
  std::vector<LandmarkPair> readFiles(const Files& contents,
                                      const std::optional<LandmarkVoxels>& voxels) const {
    std::vector<std::filesystem::path> paths = {path_, path_.string() + ".moved"};
    paths.resize(contents.size());
    for (std::size_t n = 0; n < contents.size(); ++n) writeFile(paths[n], contents[n]);
    return readLandmarkPairs(paths, voxels);
  }

  std::string refusalOfFiles(const Files& contents,
                             const std::optional<LandmarkVoxels>& voxels) const {
    return testing::refusalOf([&] { readFiles(contents, voxels); });
  }

  std::string refusal(const std::string& content) const {
    return testing::refusalOf([&] { read(content); });
  }

  void TearDown() override {
    std::filesystem::remove(path_);
    std::filesystem::remove(path_.string() + ".moved");
  }

  std::filesystem::path path_ =
      std::filesystem::path(::testing::TempDir()) /
      (std::string(::testing::UnitTest::GetInstance()->current_test_info()->name()) + ".csv");
};

TEST_F(LandmarkFileTest, TakesExpirationAndInspiration) {
  const auto pairs =
      read("exp_x,exp_y,exp_z,insp_x,insp_y,insp_z\r\n1, 2,-3,4.5,5,6e1\r\n\r\n7,8,9,1,2,3");
  ASSERT_EQ(pairs.size(), 2U);
  EXPECT_EQ(pairs[0].rest, Vec3(1.0, 2.0, -3.0));
  EXPECT_EQ(pairs[0].moved, Vec3(4.5, 5.0, 60.0));
  EXPECT_EQ(pairs[1].moved, Vec3(1.0, 2.0, 3.0));
  EXPECT_EQ(pairs[0].side, Side::None);
}

TEST_F(LandmarkFileTest, PrefersRefinedMarks) {
  const auto pairs = read(
      "n,ei_x,ei_y,ei_z,ee_x,ee_y,ee_z,ei_refined_x,ei_refined_y,ei_refined_z\n"
      "1,10,10,10,1,2,3,4,5,6\n");
  ASSERT_EQ(pairs.size(), 1U);
  EXPECT_EQ(pairs[0].rest, Vec3(1.0, 2.0, 3.0));
  EXPECT_EQ(pairs[0].moved, Vec3(4.0, 5.0, 6.0));
}

TEST_F(LandmarkFileTest, NamesTheLineThatIsWrong) {
  const std::string head = "exp_x,exp_y,exp_z,insp_x,insp_y,insp_z\n1,2,3,4,5,6\n";
  EXPECT_THAT(refusal(head + "1,2,3\n"), HasSubstr("line 3 has 3 values"));
  EXPECT_THAT(refusal(head + "1,2,3,4,5,6,7\n"), HasSubstr("line 3 has 7 values"));
  EXPECT_THAT(refusal(head + "1,2,3,,,\n"), HasSubstr("line 3 has no number"));
  EXPECT_THAT(refusal(head + "1,2,nan,4,5,6\n"), HasSubstr("'nan'"));
  EXPECT_THAT(refusal(head + "1,2,3,inf,5,6\n"), HasSubstr("'inf'"));
}

TEST_F(LandmarkFileTest, RefusesOtherTables) {
  EXPECT_THAT(refusal("i,j,k\n1,2,3\n"), HasSubstr("must name the columns"));
  EXPECT_THAT(refusal("exp_x,exp_y,exp_z\n1,2,3\n"), HasSubstr("must name the columns"));
  EXPECT_THAT(refusal(""), HasSubstr("must name the columns"));
  EXPECT_THAT(refusal("ee_x,ee_y,ee_z,ei_x,ei_y,ei_z\n"), HasSubstr("holds no landmarks"));
  EXPECT_THROW(readLandmarkPairs(path_.parent_path() / "no such file.csv"), InputMissing);
}

/// Slices are counted downwards, and the patient lies turned by a quarter about the body's axis.
LandmarkVoxels turnedScans(int first) {
  ImageGeometry rest;
  rest.size = {100, 80, 50};
  rest.spacing = Vec3(0.5, 2.0, 3.0);
  rest.origin = Vec3(-10.0, 20.0, 300.0);
  rest.direction << 0.0, 1.0, 0.0, -1.0, 0.0, 0.0, 0.0, 0.0, -1.0;
  ImageGeometry moved = rest;
  moved.spacing = Vec3::Ones();
  moved.origin = Vec3::Zero();
  moved.direction.setIdentity();
  return {rest, moved, first};
}

TEST_F(LandmarkFileTest, TakesVoxelsOfTwoScansFromTwoFiles) {
  // As DIR-Lab writes them: blanks between numbers, the first voxel is 1.
  const auto pairs = readFiles({"1 1 1\n 11\t 3  2\n", "1 2 3\n4 5 6\n"}, turnedScans(1));
  ASSERT_EQ(pairs.size(), 2U);
  EXPECT_EQ(pairs[0].rest, Vec3(-10.0, 20.0, 300.0));
  EXPECT_TRUE(pairs[1].rest.isApprox(Vec3(-10.0 + 4.0, 20.0 - 5.0, 300.0 - 3.0)));
  EXPECT_EQ(pairs[0].moved, Vec3(0.0, 1.0, 2.0));
  EXPECT_EQ(pairs[1].moved, Vec3(3.0, 4.0, 5.0));
  const auto headed = readFiles({"i,j,k\n10,2,1\n", "i,j,k\n3.5,4,5\n"}, turnedScans(0));
  EXPECT_EQ(headed.at(0).rest, pairs[1].rest);
  EXPECT_EQ(headed.at(0).moved, Vec3(3.5, 4.0, 5.0));
}

TEST_F(LandmarkFileTest, TakesSixNumbersInALine) {
  const auto mm = readFiles({"1 2 3 4 5 6\n"}, std::nullopt);
  EXPECT_EQ(mm.at(0).rest, Vec3(1.0, 2.0, 3.0));
  EXPECT_EQ(mm.at(0).moved, Vec3(4.0, 5.0, 6.0));
  const auto voxels = readFiles({"11,3,2,4,5,6\n"}, turnedScans(1));
  EXPECT_TRUE(voxels.at(0).rest.isApprox(Vec3(-6.0, 15.0, 297.0)));
  const auto named =
      readFiles({"exp_i,exp_j,exp_k,insp_i,insp_j,insp_k\n11,3,2,4,5,6\n"}, turnedScans(1));
  EXPECT_EQ(named.at(0).rest, voxels.at(0).rest);
  EXPECT_EQ(named.at(0).moved, Vec3(3.0, 4.0, 5.0));
}

TEST_F(LandmarkFileTest, RefusesVoxelsThatCannotBe) {
  const auto scans = turnedScans(1);
  EXPECT_THAT(refusalOfFiles({"1 1 1\n1 81 1\n", "1 1 1\n1 1 1\n"}, scans),
              HasSubstr("line 2: voxel 81 lies outside of the scan, whose voxels go from 1 to 80"));
  EXPECT_THAT(refusalOfFiles({"1 1 1\n", "1 1 0\n"}, scans),
              HasSubstr(".moved\", line 1: voxel 0"));
  EXPECT_THAT(refusalOfFiles({"1 1 1\n1 2 1\n", "1 1 1\n"}, scans), HasSubstr("holds 2 landmarks"));
  EXPECT_THAT(refusalOfFiles({"1 1\n", "1 1 1\n"}, scans), HasSubstr("line 1 has 2 values"));
  EXPECT_THAT(refusalOfFiles({"x,y,z\n1,1,1\n", "x,y,z\n1,1,1\n"}, scans), HasSubstr("are mm"));
  EXPECT_THAT(refusalOfFiles({"i,j,k\n1,1,1\n", "i,j,k\n1,1,1\n"}, std::nullopt),
              HasSubstr("say of which volume"));
  EXPECT_THAT(refusalOfFiles({"a,b,c\n1,1,1\n", "i,j,k\n1,1,1\n"}, scans),
              HasSubstr("begins with x,y,z or i,j,k"));
  EXPECT_THAT(refusalOfFiles({}, scans), HasSubstr("in one file or in two"));
}

}  // namespace
}  // namespace pneuma
