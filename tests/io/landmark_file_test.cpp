#include "io/landmark_file.h"

#include <filesystem>
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/error.h"
#include "io/atomic_file.h"

namespace pneuma {
namespace {

using ::testing::HasSubstr;

class LandmarkFileTest : public ::testing::Test {
 protected:
  std::vector<LandmarkPair> read(const std::string& content) const {
    writeFile(path_, content);
    return readLandmarkPairs(path_);
  }

  std::string refusal(const std::string& content) const {
    try {
      read(content);
    } catch (const InvalidInput& error) {
      return error.what();
    }
    return "";
  }

  void TearDown() override { std::filesystem::remove(path_); }

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

}  // namespace
}  // namespace pneuma
