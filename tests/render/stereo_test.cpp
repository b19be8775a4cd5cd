#include "render/stereo.h"

#include <cmath>
#include <memory>
#include <vector>

#include <gtest/gtest.h>

#include "core/error.h"

namespace pneuma {
namespace {

/// A cube of 10 mm about a point.
std::shared_ptr<const TriangleMesh> cube(const Vec3& centre) {
  auto mesh = std::make_shared<TriangleMesh>();
  for (int n = 0; n < 8; ++n) {
    mesh->points.push_back(
        centre + 5.0 * Vec3((n & 1) != 0 ? 1 : -1, (n & 2) != 0 ? 1 : -1, (n & 4) != 0 ? 1 : -1));
  }
  mesh->triangles = {{0, 2, 1}, {1, 2, 3}, {4, 5, 6}, {5, 7, 6}, {0, 1, 4}, {1, 5, 4},
                     {2, 6, 3}, {3, 6, 7}, {0, 4, 2}, {2, 4, 6}, {1, 3, 5}, {3, 7, 5}};
  return mesh;
}

constexpr int EyeWidth = 400;  // of each eye
constexpr int EyeHeight = 300;

/// The middle column of what stands out in the rows from `top` to `bottom` of an eye's half.
double columnOf(const Picture& both, int half, int top, int bottom) {
  double sum = 0.0;
  double weight = 0.0;
  for (int row = top; row < bottom; ++row) {
    for (int column = 0; column < EyeWidth; ++column) {
      const std::size_t at =
          3 * (static_cast<std::size_t>(row) * 2 * EyeWidth + half * EyeWidth + column);
      const std::size_t corner =
          3 * (static_cast<std::size_t>(row) * 2 * EyeWidth + half * EyeWidth);
      double difference = 0.0;
      for (std::size_t c = 0; c < 3; ++c) {
        difference += std::abs(both.rgb[at + c] - both.rgb[corner + c]);
      }
      if (difference < 30.0) continue;
      sum += column;
      weight += 1.0;
    }
  }
  EXPECT_GT(weight, 0.0);
  return sum / weight;
}

/// Cubes 50 mm before and behind the focus, above and below the middle.
Picture eyes(Stereo stereo, double mm = 10.0) {
  Scene scene;
  SceneOptions options;
  options.annotations = false;
  options.lobeOpacity = 1.0;
  scene.setOptions(options);
  scene.setSurfaces(
      {{Lobe::RightUpper, cube({0.0, -50.0, 40.0})}, {Lobe::LeftUpper, cube({0.0, 50.0, -40.0})}});
  scene.look({});
  const int width = stereo == Stereo::Anaglyph ? EyeWidth : 2 * EyeWidth;
  return renderStereo(scene, width, EyeHeight, {stereo, mm});
}

TEST(Stereo, NearThingsCrossAndFarThingsSpread) {
  const Picture both = eyes(Stereo::SideBySide);
  ASSERT_EQ(both.width, 2 * EyeWidth);
  const double near = columnOf(both, 0, 0, EyeHeight / 2) - columnOf(both, 1, 0, EyeHeight / 2);
  const double far =
      columnOf(both, 0, EyeHeight / 2, EyeHeight) - columnOf(both, 1, EyeHeight / 2, EyeHeight);
  EXPECT_GT(near, 2.0) << "what is near lies further right for the left eye";
  EXPECT_LT(far, -2.0) << "what is far lies further left for the left eye";
  EXPECT_LT(std::abs(far), near) << "parallax grows with nearness";
  const Picture wide = eyes(Stereo::SideBySide, 20.0);
  EXPECT_NEAR(columnOf(wide, 0, 0, EyeHeight / 2) - columnOf(wide, 1, 0, EyeHeight / 2), 2.0 * near,
              1.0);
}

TEST(Stereo, CrossedEyesGetTheHalvesSwapped) {
  const Picture beside = eyes(Stereo::SideBySide);
  const Picture crossed = eyes(Stereo::Crossed);
  for (int row = 0; row < EyeHeight; row += 10) {
    for (int column = 0; column < EyeWidth; ++column) {
      const std::size_t line = static_cast<std::size_t>(row) * 2 * EyeWidth;
      ASSERT_EQ(beside.rgb[3 * (line + column)], crossed.rgb[3 * (line + EyeWidth + column)]);
      ASSERT_EQ(beside.rgb[3 * (line + EyeWidth + column)], crossed.rgb[3 * (line + column)]);
    }
  }
}

TEST(Stereo, RedIsTheLeftEyes) {
  const Picture left{2, 1, {100, 100, 100, 0, 200, 0}};
  const Picture right{2, 1, {1, 2, 3, 4, 5, 6}};
  const Picture both = stereoPicture(left, right, Stereo::Anaglyph);
  EXPECT_EQ(both.rgb, (std::vector<std::uint8_t>{100, 2, 3, 117, 5, 6}));
  EXPECT_THROW(stereoPicture(left, Picture{1, 1, {0, 0, 0}}, Stereo::Anaglyph), InvalidInput);
}

TEST(Stereo, LeavesTheCameraWhereItWas) {
  Scene scene;
  scene.setSurfaces({{Lobe::RightUpper, cube(Vec3::Zero())}});
  scene.look({});
  const Picture before = renderPicture(scene, 100, 80);
  renderStereo(scene, 200, 80, {Stereo::SideBySide, 65.0});
  EXPECT_EQ(renderPicture(scene, 100, 80).rgb, before.rgb);
  EXPECT_THROW(renderStereo(scene, 200, 80, {Stereo::Crossed, 0.0}), InvalidOption);
}

}  // namespace
}  // namespace pneuma
