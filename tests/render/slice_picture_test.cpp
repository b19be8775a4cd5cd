#include "render/slice_picture.h"

#include <algorithm>
#include <array>
#include <cmath>

#include <gtest/gtest.h>

#include "core/error.h"
#include "core/units.h"
#include "render/generated_chest.h"

namespace pneuma {
namespace {

constexpr SliceLook PlainSlice{.labels = LabelStyle::Hidden, .annotations = false};

ImageGeometry cube(int size) {
  ImageGeometry geometry;
  geometry.size = {size, size, size};
  return geometry;
}

CtImage filled(const ImageGeometry& geometry, int hu) {
  return {geometry,
          std::vector<std::int16_t>(geometry.voxelCount(), static_cast<std::int16_t>(hu))};
}

std::array<int, 3> rgbAt(const Picture& picture, int x, int y) {
  const std::size_t at = (static_cast<std::size_t>(y) * static_cast<std::size_t>(picture.width) +
                          static_cast<std::size_t>(x)) *
                         3;
  return {picture.rgb[at], picture.rgb[at + 1], picture.rgb[at + 2]};
}

/// The middle of the pixels that are brighter than half.
PicturePoint brightMiddle(const Picture& picture) {
  PicturePoint sum;
  int count = 0;
  for (int y = 0; y < picture.height; ++y) {
    for (int x = 0; x < picture.width; ++x) {
      if (rgbAt(picture, x, y)[1] < 128) continue;
      sum.x += x + 0.5;
      sum.y += y + 0.5;
      ++count;
    }
  }
  return {sum.x / count, sum.y / count};
}

int largestDifference(const Picture& a, const Picture& b) {
  int largest = 0;
  for (std::size_t i = 0; i < a.rgb.size(); ++i) {
    largest = std::max(largest, std::abs(a.rgb[i] - b.rgb[i]));
  }
  return largest;
}

/// The share of pixels that look clearly different.
double otherShare(const Picture& a, const Picture& b) {
  std::size_t others = 0;
  for (std::size_t i = 0; i < a.rgb.size(); ++i)
    others += std::abs(a.rgb[i] - b.rgb[i]) > 90 ? 1 : 0;
  return static_cast<double>(others) / static_cast<double>(a.rgb.size());
}

TEST(SlicePicture, PutsRightLeftFrontAndTopWhereTheyBelong) {
  CtImage ct = filled(cube(21), -1000);
  ct.at(16, 4, 17) = 1000;  // left, in front, high
  const auto middleOf = [&](SlicePlane plane, double positionMm) {
    return brightMiddle(slicePicture(
        {.ct = &ct}, framedSlice(ct.geometry, plane, positionMm, 210, 210), PlainSlice));
  };
  const PicturePoint axial = middleOf(SlicePlane::Axial, 17.0);
  EXPECT_NEAR(axial.x, 165.0, 1.0);  // the patient's left on the right
  EXPECT_NEAR(axial.y, 45.0, 1.0);   // the front above
  const PicturePoint coronal = middleOf(SlicePlane::Coronal, 4.0);
  EXPECT_NEAR(coronal.x, 165.0, 1.0);
  EXPECT_NEAR(coronal.y, 35.0, 1.0);  // the head above
  const PicturePoint sagittal = middleOf(SlicePlane::Sagittal, 16.0);
  EXPECT_NEAR(sagittal.x, 45.0, 1.0);  // the front on the left
  EXPECT_NEAR(sagittal.y, 35.0, 1.0);
}

TEST(SlicePicture, IsTheSameForEveryAxisOrder) {
  const test::GeneratedChest chest = test::generatedChest(test::chestGrid());
  std::array<int, 3> from{0, 1, 2};
  do {
    for (int flips = 0; flips < 8; ++flips) {
      const AxisOrder order{from, {(flips & 1) != 0, (flips & 2) != 0, (flips & 4) != 0}};
      const CtImage ct = turned(chest.ct, order);
      const LabelImage labels = turned(chest.labels, order);
      for (const SlicePlane plane : SlicePlanes) {
        // No pixel lies on the border of two voxels, where either may be the nearest.
        SliceFrame frame{plane, Vec3(0.37, 0.41, 0.43), 2.9, 120, 90};
        frame.centre[normalAxis(plane)] = sliceStack(ct.geometry, plane).positionMm(25);
        const Picture plain = slicePicture({&chest.ct, &chest.labels, {}, {}}, frame);
        // One grey more or less by rounding.
        EXPECT_LE(largestDifference(plain, slicePicture({&ct, &labels, {}, {}}, frame)), 1);
      }
    }
  } while (std::next_permutation(from.begin(), from.end()));
}

TEST(SlicePicture, ShowsAnObliqueImageWhereThePatientIs) {
  const test::GeneratedChest straight = test::generatedChest(test::chestGrid());
  ImageGeometry geometry = test::chestGrid();
  geometry.size = {160, 130, 90};
  geometry.direction = (Eigen::AngleAxisd(radians(20.0), Vec3::UnitX()) *
                        Eigen::AngleAxisd(radians(-15.0), Vec3::UnitZ()))
                           .toRotationMatrix();
  geometry.origin = -geometry.steps() * Vec3(79.5, 64.5, 44.5);
  const test::GeneratedChest oblique = test::generatedChest(geometry);
  CtImage unturned = oblique.ct;
  unturned.geometry.direction = Mat3::Identity();
  for (const SlicePlane plane : SlicePlanes) {
    const SliceFrame frame{plane, Vec3(20.0, -20.0, 30.0), 1.5, 110, 80};
    const Picture truth = slicePicture({.ct = &straight.ct}, frame, PlainSlice);
    // Only edges fall differently between the voxels.
    EXPECT_LT(otherShare(truth, slicePicture({.ct = &oblique.ct}, frame, PlainSlice)), 0.04);
    EXPECT_GT(otherShare(truth, slicePicture({.ct = &unturned}, frame, PlainSlice)), 0.15);
  }
}

TEST(SlicePicture, IsTrueToScaleForThickSlices) {
  ImageGeometry geometry;
  geometry.size = {101, 101, 21};
  geometry.spacing = Vec3(0.8, 0.8, 4.0);
  CtImage ct = filled(geometry, -1000);
  for (int k = 0; k < 21; ++k) {
    for (int j = 0; j < 101; ++j) {
      for (int i = 0; i < 101; ++i) {
        if ((geometry.worldFromVoxel(Vec3(i, j, k)) - Vec3(40, 40, 40)).norm() < 24.0) {
          ct.at(i, j, k) = 400;
        }
      }
    }
  }
  const Picture picture = slicePicture(
      {.ct = &ct}, framedSlice(geometry, SlicePlane::Coronal, 40.0, 400, 400), PlainSlice);
  int across = 0;
  int along = 0;
  for (int at = 0; at < 400; ++at) {
    across += rgbAt(picture, at, 200)[0] > 128 ? 1 : 0;
    along += rgbAt(picture, 200, at)[0] > 128 ? 1 : 0;
  }
  EXPECT_NEAR(across, along, 24);  // one voxel of 4 mm is 19 pixels
}

TEST(SlicePicture, DrawsNothingOutsideTheImage) {
  const CtImage ct = filled(cube(10), 3000);
  SliceFrame frame = framedSlice(ct.geometry, SlicePlane::Axial, 5.0, 100, 100);
  frame.mmPerPixel *= 2.0;
  const Picture picture = slicePicture({.ct = &ct}, frame, PlainSlice);
  EXPECT_EQ(rgbAt(picture, 24, 50)[0], 0);
  EXPECT_EQ(rgbAt(picture, 25, 50)[0], 255);
  EXPECT_EQ(rgbAt(picture, 74, 50)[0], 255);
  EXPECT_EQ(rgbAt(picture, 75, 50)[0], 0);
  frame.centre.z() = 200.0;
  EXPECT_EQ(rgbAt(slicePicture({.ct = &ct}, frame, PlainSlice), 50, 50)[0], 0);
}

TEST(SlicePicture, AveragesVoxelsFinerThanItsPixels) {
  CtImage ct = filled(cube(64), -1000);
  for (int j = 0; j < 64; ++j) {
    for (int i = 0; i < 64; ++i) {
      if ((i + j) % 2 == 0) ct.at(i, j, 32) = -200;
    }
  }
  SliceFrame frame = framedSlice(ct.geometry, SlicePlane::Axial, 32.0, 16, 16);
  frame.centre += Vec3(0.5, 0.5, 0.0);  // the pixels' centres are voxels' centres
  const Picture picture = slicePicture({.ct = &ct}, frame, PlainSlice);
  const int mean = PlainSlice.window.grey(-600.0);
  for (int x = 1; x < 15; ++x) EXPECT_NEAR(rgbAt(picture, x, 7)[0], mean, 2) << x;
}

TEST(SlicePicture, FillsOutlinesAndHidesLabels) {
  const CtImage ct = filled(cube(30), -600);
  LabelImage labels{cube(30), std::vector<std::uint8_t>(27000, 0)};
  for (int j = 10; j < 20; ++j) {
    for (int i = 10; i < 20; ++i) labels.at(i, j, 15) = 10;
  }
  const SliceFrame frame = framedSlice(ct.geometry, SlicePlane::Axial, 15.0, 30, 30);
  const auto at = [&](LabelStyle style, int x) {
    SliceLook look = PlainSlice;
    look.labels = style;
    return rgbAt(slicePicture({&ct, &labels, {}, {}}, frame, look), x, 15);
  };
  const std::array<int, 3> grey = {128, 128, 128};
  EXPECT_EQ(at(LabelStyle::Hidden, 15), grey);
  EXPECT_EQ(at(LabelStyle::Outlined, 15), grey);
  EXPECT_NE(at(LabelStyle::Filled, 15), grey);
  for (const LabelStyle style : {LabelStyle::Outlined, LabelStyle::Filled}) {
    EXPECT_EQ(at(style, 9), grey);
    EXPECT_NE(at(style, 10), grey);
    EXPECT_NE(at(style, 10), at(style, 15));  // the edge is denser than the inside
    EXPECT_NE(at(style, 19), at(style, 15));
  }
  // The right lung is blue: it takes red away.
  EXPECT_LT(at(LabelStyle::Filled, 15)[0], 128);
  EXPECT_GT(at(LabelStyle::Filled, 15)[2], 128);
}

TEST(SlicePicture, ColoursTheVoxelsBetweenTwoThresholds) {
  CtImage ct = filled(cube(10), 40);
  ct.at(3, 5, 5) = -400;
  ct.at(5, 5, 5) = -401;
  ct.at(7, 5, 5) = -1200;
  SliceLook look = PlainSlice;
  look.highlight = HuBand{-1100.0, -400.5};
  const Picture picture =
      slicePicture({.ct = &ct}, framedSlice(ct.geometry, SlicePlane::Axial, 5.0, 10, 10), look);
  const auto coloured = [&](int x) { return rgbAt(picture, x, 5)[0] != rgbAt(picture, x, 5)[1]; };
  EXPECT_FALSE(coloured(3));
  EXPECT_TRUE(coloured(5));
  EXPECT_FALSE(coloured(7));
}

TEST(SlicePicture, OutlinesLabelsWhereAThresholdIsShown) {
  const CtImage ct = filled(cube(30), 40);
  LabelImage labels{cube(30), std::vector<std::uint8_t>(27000, 10)};
  SliceLook look = PlainSlice;
  look.labels = LabelStyle::Filled;
  look.highlight = HuBand{-1100.0, -400.0};
  const SliceFrame frame = framedSlice(ct.geometry, SlicePlane::Axial, 15.0, 30, 30);
  const std::array<int, 3> rgb = rgbAt(slicePicture({&ct, &labels, {}, {}}, frame, look), 15, 15);
  EXPECT_EQ(rgb[0], rgb[2]);
}

TEST(SlicePicture, ColoursNoAirRoundThePatient) {
  const test::GeneratedChest chest = test::generatedChest(test::chestGrid());
  SliceLook look = PlainSlice;
  look.highlight = HuBand{-1100.0, -400.0};
  const auto coloured = [&](const Vec3& point, SlicePlane plane) {
    SliceFrame frame{plane, point, 1.0, 9, 9};  // looked at from near, it stays the same
    const std::array<int, 3> rgb = rgbAt(slicePicture({.ct = &chest.ct}, frame, look), 4, 4);
    return rgb[0] != rgb[1];
  };
  for (const SlicePlane plane : SlicePlanes) {
    EXPECT_TRUE(coloured(Vec3(-70.5, 31.5, 40.0), plane));    // the right lung
    EXPECT_FALSE(coloured(Vec3(-172.5, 91.5, 40.0), plane));  // the air of the room
    EXPECT_FALSE(coloured(Vec3(-1.5, -85.5, 40.0), plane));   // the breast bone's fat
  }
  // The trachea leaves the image above.
  EXPECT_TRUE(coloured(Vec3(1.5, -4.5, 140.0), SlicePlane::Coronal));
}

TEST(SlicePicture, MarksPointsOfItsSliceAlone) {
  const CtImage ct = filled(cube(40), -3000);
  const SliceFrame frame = framedSlice(ct.geometry, SlicePlane::Axial, 20.0, 120, 120);
  const auto lit = [&](const SliceContents& contents) {
    const Picture picture = slicePicture(contents, frame, PlainSlice);
    return std::count_if(picture.rgb.begin(), picture.rgb.end(), [](auto v) { return v > 0; });
  };
  EXPECT_EQ(lit({&ct, nullptr, {Vec3(20, 20, 21)}, {}}), 0);
  EXPECT_GT(lit({&ct, nullptr, {Vec3(20, 20, 20.4)}, {}}), 50);
  EXPECT_GT(lit({&ct, nullptr, {}, Vec3(20, 20, 33)}), 200);  // a crosshair is in every slice
}

TEST(SlicePicture, TellsWhatIsAtAPoint) {
  const test::GeneratedChest chest = test::generatedChest(test::chestGrid());
  EXPECT_EQ(huAt(chest.ct, Vec3(-70.0, 40.0, 40.0)), -860);
  EXPECT_EQ(labelAt(chest.labels, Vec3(-70.0, 40.0, 40.0)), 10);
  EXPECT_EQ(labelAt(chest.labels, Vec3(70.0, 40.0, 40.0)), 20);
  EXPECT_EQ(huAt(chest.ct, Vec3(0.0, 0.0, 151.0)), std::nullopt);
  EXPECT_EQ(labelAt(chest.labels, Vec3(181.0, 0.0, 0.0)), std::nullopt);
}

TEST(Tiled, PutsPicturesSideBySide) {
  const Picture white{20, 10, std::vector<std::uint8_t>(600, 255)};
  const Picture sheet = tiled({white, white, white}, 2);
  EXPECT_EQ(sheet.width, 42);
  EXPECT_EQ(sheet.height, 22);
  EXPECT_EQ(rgbAt(sheet, 0, 0)[0], 255);
  EXPECT_LT(rgbAt(sheet, 20, 0)[0], 100);
  EXPECT_EQ(rgbAt(sheet, 22, 0)[0], 255);
  EXPECT_EQ(rgbAt(sheet, 5, 15)[0], 255);
  EXPECT_EQ(rgbAt(sheet, 30, 15)[0], 0);
  EXPECT_THROW(tiled({}, 2), InvalidInput);
  EXPECT_THROW(tiled({white, {10, 10, std::vector<std::uint8_t>(300)}}, 2), InvalidInput);
}

}  // namespace
}  // namespace pneuma
