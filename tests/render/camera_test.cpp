#include "render/camera.h"

#include <algorithm>
#include <cmath>
#include <string>

#include <gtest/gtest.h>

#include "core/error.h"
#include "core/random.h"
#include "core/units.h"

namespace pneuma {
namespace {

struct NamedCase {
  std::string name;
  std::string letter;
  std::string left;  ///< the patient's side on the picture's left
  std::string top;
};

TEST(Camera, NamedViewsHaveThePatientTheRightWayRound) {
  for (const NamedCase& view :
       {NamedCase{"anterior", "A", "R", "S"}, NamedCase{"posterior", "p", "L", "S"},
        NamedCase{"left", "L", "A", "S"}, NamedCase{"Right", "R", "P", "S"},
        NamedCase{"superior", "S", "R", "P"}, NamedCase{"inferior", "I", "R", "A"}}) {
    const ViewAxes axes = axesOf(viewDirection(view.name));
    EXPECT_EQ(orientationLetters(-axes.right), view.left) << view.name;
    EXPECT_EQ(orientationLetters(axes.up), view.top) << view.name;
    EXPECT_TRUE(axesOf(viewDirection(view.letter)).up.isApprox(axes.up));
    EXPECT_TRUE(axesOf(viewDirection(view.letter)).right.isApprox(axes.right));
    EXPECT_NEAR(axes.right.cross(axes.up).dot(axes.towardsEye), 1.0, 1e-12);
  }
}

TEST(Camera, LooksFromTheFrontAlongPlusY) {
  EXPECT_TRUE(axesOf(viewDirection("A")).towardsEye.isApprox(Vec3(0, -1, 0)));
  EXPECT_TRUE(axesOf(viewDirection("90,0")).towardsEye.isApprox(Vec3(1, 0, 0)));
}

TEST(Camera, AnglesSurviveTheWayThroughTheAxes) {
  for (const double azimuth : {-170.0, -30.0, 0.0, 12.5, 90.0}) {
    for (const double elevation : {-90.0, -40.0, 0.0, 6.0, 89.0, 90.0}) {
      const ViewAxes axes = axesOf({azimuth, elevation});
      const ViewDirection back = viewDirectionOf(axes.towardsEye, axes.up);
      EXPECT_NEAR(back.azimuthDeg, azimuth, 1e-6);
      EXPECT_NEAR(back.elevationDeg, elevation, 1e-5);
    }
  }
}

TEST(Camera, ReadsAnglesAndRefusesTheRest) {
  EXPECT_EQ(viewDirection("-30, +12.5").azimuthDeg, -30.0);
  EXPECT_EQ(viewDirection("-30, +12.5").elevationDeg, 12.5);
  for (const char* text : {"", "front", "30", "30,", "30,91", "nan,0", "1,2,3", "400,0", "30;10"}) {
    EXPECT_THROW(viewDirection(text), InvalidOption) << text;
  }
  try {
    viewDirection("antirior");
    FAIL();
  } catch (const InvalidOption& error) {
    EXPECT_NE(std::string(error.what()).find("did you mean 'anterior'"), std::string::npos);
  }
}

TEST(Camera, ObliqueDirectionsGetTwoLetters) {
  EXPECT_EQ(orientationLetters(Vec3(1, 0.1, 0).normalized()), "L");
  EXPECT_EQ(orientationLetters(Vec3(-0.9, -0.6, 0).normalized()), "RA");
  EXPECT_EQ(orientationLetters(Vec3(0.3, 0.5, -0.8).normalized()), "IP");
}

TEST(Camera, FramesAllPointsBetweenTheInsetsAndTouchesThem) {
  Random random(3);
  std::vector<Vec3> points;
  for (int i = 0; i < 500; ++i) {
    points.emplace_back(random.uniform(-120, 140), random.uniform(-90, 60), random.uniform(0, 280));
  }
  const Insets insets{30, 120, 25, 15};
  for (const auto& [width, height] : {std::pair{480, 360}, std::pair{300, 700}}) {
    const ViewDirection direction{25.0, -20.0};
    const ViewAxes axes = axesOf(direction);
    const CameraPose pose = framed(points, direction, width, height, insets);
    double left = 1e9;
    double right = 1e9;
    double bottom = 1e9;
    double top = 1e9;
    const double focal = 0.5 * height / std::tan(radians(0.5 * ViewAngleDeg));
    for (const Vec3& p : points) {
      const Vec3 ray = p - pose.eye;
      const double depth = -ray.dot(axes.towardsEye);
      ASSERT_GT(depth, 0.0);
      const double x = 0.5 * width + focal * ray.dot(axes.right) / depth;
      const double y = 0.5 * height + focal * ray.dot(axes.up) / depth;
      left = std::min(left, x - insets.left);
      right = std::min(right, width - insets.right - x);
      bottom = std::min(bottom, y - insets.bottom);
      top = std::min(top, height - insets.top - y);
    }
    for (const double gap : {left, right, bottom, top}) EXPECT_GT(gap, -1e-6);
    // As large as it can be: it touches two opposite edges, and lies in the middle of the others.
    EXPECT_LT(std::min(left + right, bottom + top), 1e-6);
    EXPECT_NEAR(left, right, 0.1 * width);
    EXPECT_NEAR(bottom, top, 0.1 * height);
  }
}

TEST(Camera, FramesASinglePointAndNone) {
  const std::vector<Vec3> one = {Vec3(10, 20, 30)};
  EXPECT_TRUE(framed(one, {}, 100, 100, {}).eye.allFinite());
  EXPECT_TRUE(framed({}, {}, 100, 100, {}).eye.allFinite());
}

}  // namespace
}  // namespace pneuma
