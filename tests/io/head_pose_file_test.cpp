#include "io/head_pose_file.h"

#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/error.h"
#include "io/atomic_file.h"
#include "io/refusal.h"
#include "io/temp_folder.h"

namespace pneuma {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;

const std::string PoseHead = "time_s,x_mm,y_mm,z_mm,qw,qx,qy,qz\n";

class HeadPoses : public ::testing::Test {
 protected:
  std::vector<HeadPose> read(const std::string& content) const {
    writeFile(folder_.path() / "poses.csv", content, Existing::Replace);
    return readHeadPoses(folder_.path() / "poses.csv");
  }

  std::string refusal(const std::string& content) const {
    return testing::refusalOf([&] { read(content); });
  }

 private:
  testing::TempFolder folder_;
};

TEST_F(HeadPoses, AreTakenAsTheyWereRecorded) {
  const std::vector<HeadPose> poses = read(
      "# of a tracker\nframe;QW;qx;qy;qz;time_s;x_mm;y_mm;z_mm\n"
      "1;1;0;0;0;10.5;1;-2;3\n2;0.707;0.707;0;0;10.515;4;5;6\n");
  ASSERT_EQ(poses.size(), 2U);
  EXPECT_EQ(poses[0].seconds, 10.5);
  EXPECT_EQ(poses[0].position, Vec3(1.0, -2.0, 3.0));
  EXPECT_LT((poses[0].orientation * Vec3(1.0, 2.0, 3.0) - Vec3(1.0, 2.0, 3.0)).norm(), 1e-12);
  // A quarter turn about x takes y to z.
  EXPECT_NEAR(poses[1].orientation.norm(), 1.0, 1e-12);
  EXPECT_LT((poses[1].orientation * Vec3::UnitY() - Vec3::UnitZ()).norm(), 1e-3);
}

TEST_F(HeadPoses, NameTheLineThatIsWrong) {
  const std::string good = PoseHead + "0,0,0,0,1,0,0,0\n";
  EXPECT_THAT(refusal(good + "0,0,0,0,1,0,0,0\n"), AllOf(HasSubstr("line 3"), HasSubstr("time")));
  EXPECT_THAT(refusal(good + "-1,0,0,0,1,0,0,0\n"), AllOf(HasSubstr("line 3"), HasSubstr("-1 s")));
  EXPECT_THAT(refusal(good + "1,0,0,0,0,0,0,0\n"),
              AllOf(HasSubstr("line 3"), HasSubstr("quaternion"), HasSubstr("length 0")));
  EXPECT_THAT(refusal(good + "1,0,0,0,0.5,0.5,0.5,0.6\n"), HasSubstr("line 3: the quaternion"));
  EXPECT_THAT(refusal(good + "1,0,0,0,1e300,1e300,0,0\n"), HasSubstr("infinity"));
  EXPECT_THAT(refusal(good + "1,0,nan,0,1,0,0,0\n"), HasSubstr("line 3, column y_mm"));
  EXPECT_THAT(refusal(good + "1,0,0,inf,1,0,0,0\n"), HasSubstr("line 3, column z_mm"));
  EXPECT_THAT(refusal(good + "1,0,200000,0,1,0,0,0\n"),
              AllOf(HasSubstr("line 3"), HasSubstr("mm")));
  EXPECT_THAT(refusal(good + "1000,0,0,0,1,0,0,0\n3601,0,0,0,1,0,0,0\n"),
              AllOf(HasSubstr("line 4"), HasSubstr("seconds")));
  EXPECT_THAT(refusal(good + "1,0,0,0,1,0,0\n"), HasSubstr("line 3 has 7 columns"));
  EXPECT_THAT(refusal(PoseHead), HasSubstr("no pose"));
  EXPECT_THAT(refusal(""), HasSubstr("no table"));
  EXPECT_THAT(refusal("time_s,x_mm,y_mm,z_mm,qx,qy,qz\n"), HasSubstr("no column \"qw\""));
  EXPECT_THROW(readHeadPoses("gone.csv"), InputMissing);
}

TEST_F(HeadPoses, AreAMillionAtMost) {
  std::string content = PoseHead;
  for (std::size_t n = 0; n <= MostHeadPoses; ++n) {
    content += "0,0,0,0,1,0,0,0\n";
  }
  EXPECT_THAT(refusal(content), HasSubstr("1000001 poses"));
}

}  // namespace
}  // namespace pneuma
