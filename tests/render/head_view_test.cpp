#include "render/head_view.h"

#include <cmath>
#include <memory>
#include <tuple>
#include <utility>

#include <gtest/gtest.h>

#include "core/error.h"
#include "core/units.h"

namespace pneuma {
namespace {

constexpr int EdgePixels = 200;  // pixels

/// A cube of 20 mm.
std::shared_ptr<const TriangleMesh> cubeAbout(const Vec3& centre) {
  auto mesh = std::make_shared<TriangleMesh>();
  for (int n = 0; n < 8; ++n) {
    mesh->points.push_back(
        centre + 10.0 * Vec3((n & 1) != 0 ? 1 : -1, (n & 2) != 0 ? 1 : -1, (n & 4) != 0 ? 1 : -1));
  }
  mesh->triangles = {{0, 2, 1}, {1, 2, 3}, {4, 5, 6}, {5, 7, 6}, {0, 1, 4}, {1, 5, 4},
                     {2, 6, 3}, {3, 6, 7}, {0, 4, 2}, {2, 4, 6}, {1, 3, 5}, {3, 7, 5}};
  return mesh;
}

void show(Scene& scene, const Vec3& centre) {
  SceneOptions options;
  options.annotations = false;
  options.lobeOpacity = 1.0;
  options.background = Background::White;
  scene.setOptions(options);
  scene.setSurfaces({{Lobe::RightUpper, cubeAbout(centre)}});
}

/// Where the cube's middle is in the picture from its left and top, pixels; -1 if it is not there.
std::pair<double, double> cubeIn(const Picture& picture) {
  double x = 0.0;
  double y = 0.0;
  double count = 0.0;
  for (int row = 0; row < picture.height; ++row) {
    for (int column = 0; column < picture.width; ++column) {
      const std::size_t at = 3 * static_cast<std::size_t>(row * picture.width + column);
      if (picture.rgb[at] + picture.rgb[at + 1] + picture.rgb[at + 2] > 740) continue;
      x += column + 0.5;
      y += row + 0.5;
      count += 1.0;
    }
  }
  if (count == 0.0) return {-1.0, -1.0};
  return {x / count, y / count};
}

const Eigen::Quaterniond Straight = Eigen::Quaterniond::Identity();

TEST(HeadView, AHeadAsRecordedLooksDownAndHasTheBackAbove) {
  Scene scene;
  show(scene, Vec3(20.0, 40.0, -500.0));
  HeadView view(scene, EdgePixels, EdgePixels, {});
  // 500 mm ahead the picture is 2 * 500 tan 11 degrees = 194.4 mm high.
  const double pixelsPerMm = EdgePixels / (2.0 * 500.0 * std::tan(radians(11.0)));
  const auto [x, y] = cubeIn(view.from(Vec3::Zero(), Straight));
  EXPECT_NEAR(x, 100.0 + 20.0 * pixelsPerMm, 1.5);
  EXPECT_NEAR(y, 100.0 - 40.0 * pixelsPerMm, 1.5);
}

TEST(HeadView, FollowsWhereTheHeadIsAndHowItIsTurned) {
  Scene scene;
  show(scene, Vec3(0.0, 0.0, 0.0));
  HeadView view(scene, EdgePixels, EdgePixels, {});
  // From the front: turned about x so that what was ahead, -z, is the back, +y.
  const Eigen::Quaterniond level(Eigen::AngleAxisd(radians(90.0), Vec3::UnitX()));
  auto [x, y] = cubeIn(view.from(Vec3(0.0, -500.0, 0.0), level));
  EXPECT_NEAR(x, 100.0, 1.0);
  EXPECT_NEAR(y, 100.0, 1.0);
  std::tie(x, y) = cubeIn(view.from(Vec3(30.0, -500.0, 0.0), level));
  EXPECT_LT(x, 80.0) << "who steps to the patient's left, his own right, sees things on his left";
  EXPECT_NEAR(y, 100.0, 1.0);
  // Tilted to the right by 90 degrees: what was above is on the left.
  const Eigen::Quaterniond tilted = level * Eigen::AngleAxisd(radians(-90.0), Vec3::UnitZ());
  std::tie(x, y) = cubeIn(view.from(Vec3(0.0, -500.0, -30.0), tilted));
  EXPECT_LT(x, 80.0);
  EXPECT_NEAR(y, 100.0, 1.0);
  const Eigen::Quaterniond back = Eigen::AngleAxisd(radians(180.0), Vec3::UnitZ()) * level;
  EXPECT_EQ(cubeIn(view.from(Vec3(0.0, -500.0, 0.0), back)).first, -1.0);
}

TEST(HeadView, WhatIsAsDeepAsTheMiddleLiesInTheScreenForBothEyes) {
  Scene scene;
  show(scene, Vec3(0.0, 0.0, -500.0));
  HeadView view(scene, 2 * EdgePixels, EdgePixels, {Stereo::SideBySide, 65.0});
  const Picture both = view.from(Vec3(0.0, 0.0, 0.0), Straight);
  ASSERT_EQ(both.width, 2 * EdgePixels);
  for (const int half : {0, 1}) {
    Picture eye{EdgePixels, EdgePixels, {}};
    for (std::ptrdiff_t row = 0; row < EdgePixels; ++row) {
      const auto from = both.rgb.begin() + 3 * EdgePixels * (2 * row + half);
      eye.rgb.insert(eye.rgb.end(), from, from + 3 * EdgePixels);
    }
    EXPECT_NEAR(cubeIn(eye).first, 0.5 * EdgePixels, 1.0);
  }
  EXPECT_THROW(HeadView(scene, 200, 100, {Stereo::Crossed, 0.0}), InvalidOption);
}

TEST(HeadView, GivesTheSceneBack) {
  Scene scene;
  show(scene, Vec3::Zero());
  scene.look({});
  { HeadView(scene, EdgePixels, EdgePixels, {}).from(Vec3(0.0, 0.0, 500.0), Straight); }
  scene.look({});
  EXPECT_NEAR(cubeIn(renderPicture(scene, EdgePixels, EdgePixels)).first, 0.5 * EdgePixels, 2.0);
}

}  // namespace
}  // namespace pneuma
