// Corrections of lungs by hand: what strokes cover is known exactly, and so is what a seed may
// take.
#include "segmentation/lung_edits.h"

#include <cmath>
#include <functional>
#include <numbers>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/error.h"
#include "core/parallel.h"
#include "segmentation/lung_segmentation.h"

namespace pneuma {
namespace {

using ::testing::HasSubstr;

constexpr std::uint8_t Right = 10;
constexpr std::uint8_t Left = 20;
constexpr std::uint8_t Airway = 6;
constexpr double Pi = std::numbers::pi;

ImageGeometry plainGrid() {
  ImageGeometry geometry;
  geometry.size = {90, 80, 70};
  geometry.spacing = {0.8, 0.8, 1.0};
  geometry.origin = {-36.0, -32.0, -35.0};
  return geometry;
}

/// Turned about all axes, as no scanner has it, with k running down.
ImageGeometry obliqueGrid() {
  ImageGeometry geometry = plainGrid();
  geometry.direction =
      (Eigen::AngleAxisd(0.4, Vec3::UnitX()) * Eigen::AngleAxisd(-0.3, Vec3::UnitY()) *
       Eigen::AngleAxisd(0.2, Vec3::UnitZ()))
          .toRotationMatrix();
  geometry.direction.col(2) *= -1.0;
  geometry.origin = geometry.origin + geometry.worldFromVoxel({0, 0, 0}) -
                    geometry.worldFromVoxel({45, 40, 35}) - geometry.origin;
  return geometry;
}

CtImage water(const ImageGeometry& geometry, std::int16_t hu = 40) {
  return {geometry, std::vector<std::int16_t>(geometry.voxelCount(), hu)};
}

LabelImage nothing(const ImageGeometry& geometry) {
  return {geometry, std::vector<std::uint8_t>(geometry.voxelCount(), 0)};
}

LungEdit stroke(LungTool tool, Side side, double radiusMm, std::vector<Vec3> points) {
  LungEdit edit;
  edit.tool = tool;
  edit.side = side;
  edit.radiusMm = radiusMm;
  edit.points = std::move(points);
  return edit;
}

double volumeMm3(const LabelImage& labels, std::uint8_t label) {
  return static_cast<double>(std::count(labels.voxels.begin(), labels.voxels.end(), label)) *
         labels.geometry.voxelMm3();
}

class LungStroke : public ::testing::TestWithParam<std::function<ImageGeometry()>> {
 protected:
  CtImage ct = water(GetParam()());
  LabelImage labels = nothing(ct.geometry);
};

TEST_P(LungStroke, PaintsABall) {
  const Vec3 middle = ct.geometry.worldFromVoxel({45.0, 40.0, 35.0}) + Vec3(0.2, -0.3, 0.1);
  applyEdit(ct, stroke(LungTool::Paint, Side::Right, 15.0, {middle}), labels);
  const double ball = 4.0 / 3.0 * Pi * std::pow(15.0, 3.0);
  EXPECT_NEAR(volumeMm3(labels, Right) / ball, 1.0, 0.005);
  for (std::size_t v = 0; v < labels.voxels.size(); v += 7) {
    const int i = static_cast<int>(v % 90);
    const int j = static_cast<int>(v / 90 % 80);
    const int k = static_cast<int>(v / (90 * 80));
    const double away = (ct.geometry.worldFromVoxel(Vec3(i, j, k)) - middle).norm();
    ASSERT_EQ(labels.voxels[v] == Right, away <= 15.0) << i << " " << j << " " << k;
  }
}

TEST_P(LungStroke, CoversWhatLiesBetweenItsPoints) {
  const Vec3 from = ct.geometry.worldFromVoxel({25.0, 40.0, 35.0});
  const Vec3 to = ct.geometry.worldFromVoxel({65.0, 45.0, 38.0});
  applyEdit(ct, stroke(LungTool::Paint, Side::Left, 8.0, {from, to}), labels);
  const double capsule = Pi * 64.0 * (to - from).norm() + 4.0 / 3.0 * Pi * 512.0;
  EXPECT_NEAR(volumeMm3(labels, Left) / capsule, 1.0, 0.01);
  // The same in parts, as the window shows it while it is drawn.
  LabelImage parts = nothing(ct.geometry);
  const Vec3 between = 0.3 * from + 0.7 * to;
  applyEdit(ct, stroke(LungTool::Paint, Side::Left, 8.0, {from}), parts);
  applyEdit(ct, stroke(LungTool::Paint, Side::Left, 8.0, {from, between}), parts);
  applyEdit(ct, stroke(LungTool::Paint, Side::Left, 8.0, {between, to}), parts);
  LabelImage whole = nothing(ct.geometry);
  applyEdit(ct, stroke(LungTool::Paint, Side::Left, 8.0, {from, between, to}), whole);
  EXPECT_EQ(parts.voxels, whole.voxels);
}

TEST_P(LungStroke, IsTheSameForAnyNumberOfThreads) {
  const Vec3 from = ct.geometry.worldFromVoxel({20.0, 30.0, 20.0});
  const Vec3 to = ct.geometry.worldFromVoxel({70.0, 50.0, 50.0});
  const LungEdit edit = stroke(LungTool::Paint, Side::Left, 12.0, {from, to});
  {
    const ThreadLimit one(1);
    applyEdit(ct, edit, labels);
  }
  LabelImage many = nothing(ct.geometry);
  const ThreadLimit four(4);
  applyEdit(ct, edit, many);
  EXPECT_EQ(many.voxels, labels.voxels);
}

TEST_P(LungStroke, ErasingUndoesPainting) {
  const Vec3 middle = ct.geometry.worldFromVoxel({45.0, 40.0, 35.0});
  const Vec3 end = ct.geometry.worldFromVoxel({60.0, 40.0, 35.0});
  EXPECT_GT(applyEdit(ct, stroke(LungTool::Paint, Side::Right, 9.0, {middle, end}), labels), 0U);
  applyEdit(ct, stroke(LungTool::Erase, Side::None, 9.0, {middle, end}), labels);
  EXPECT_EQ(labels.voxels, nothing(ct.geometry).voxels);
  // And in part: a smaller brush leaves the difference of the balls.
  applyEdit(ct, stroke(LungTool::Paint, Side::Right, 14.0, {middle}), labels);
  applyEdit(ct, stroke(LungTool::Erase, Side::Right, 10.0, {middle}), labels);
  const double shell = 4.0 / 3.0 * Pi * (std::pow(14.0, 3.0) - std::pow(10.0, 3.0));
  EXPECT_NEAR(volumeMm3(labels, Right) / shell, 1.0, 0.01);
}

INSTANTIATE_TEST_SUITE_P(, LungStroke, ::testing::Values(&plainGrid, &obliqueGrid),
                         [](const auto& test) { return test.index == 0 ? "Plain" : "Oblique"; });

TEST(LungEdits, ADiscStaysInItsSlice) {
  const CtImage ct = water(plainGrid());
  for (const BrushShape shape :
       {BrushShape::AxialDisc, BrushShape::CoronalDisc, BrushShape::SagittalDisc}) {
    LabelImage labels = nothing(ct.geometry);
    LungEdit edit = stroke(LungTool::Paint, Side::Right, 12.0,
                           {ct.geometry.worldFromVoxel({45.0, 40.0, 35.0})});
    edit.shape = shape;
    applyEdit(ct, edit, labels);
    const int axis = shape == BrushShape::AxialDisc ? 2 : shape == BrushShape::CoronalDisc ? 1 : 0;
    const double thickMm = ct.geometry.spacing[axis];
    EXPECT_NEAR(volumeMm3(labels, Right) / (Pi * 144.0 * thickMm), 1.0, 0.02);
    const std::array<int, 3> middle = {45, 40, 35};
    for (std::size_t v = 0; v < labels.voxels.size(); ++v) {
      if (labels.voxels[v] == 0) continue;
      const std::array<int, 3> at = {static_cast<int>(v % 90), static_cast<int>(v / 90 % 80),
                                     static_cast<int>(v / (90 * 80))};
      ASSERT_EQ(at[static_cast<std::size_t>(axis)], middle[static_cast<std::size_t>(axis)]);
    }
  }
}

TEST(LungEdits, LeaveAirwaysAndWhatIsDenserThanTheLimit) {
  CtImage ct = water(plainGrid(), -850);
  LabelImage labels = nothing(ct.geometry);
  labels.at(45, 40, 35) = Airway;
  labels.at(46, 40, 35) = Left;
  ct.at(44, 40, 35) = -300;
  ct.at(43, 40, 35) = -301;
  LungEdit edit =
      stroke(LungTool::Paint, Side::Right, 5.0, {ct.geometry.worldFromVoxel({45.0, 40.0, 35.0})});
  edit.belowHu = -300.0;
  applyEdit(ct, edit, labels);
  EXPECT_EQ(labels.at(45, 40, 35), Airway);
  EXPECT_EQ(labels.at(46, 40, 35), Right);
  EXPECT_EQ(labels.at(44, 40, 35), 0);
  EXPECT_EQ(labels.at(43, 40, 35), Right);
  edit.tool = LungTool::Erase;
  edit.side = Side::Left;
  EXPECT_EQ(applyEdit(ct, edit, labels), 0U) << "the right lung is not the left one";
  edit.side = Side::None;
  edit.belowHu.reset();
  applyEdit(ct, edit, labels);
  EXPECT_EQ(volumeMm3(labels, Right), 0.0);
  EXPECT_EQ(labels.at(45, 40, 35), Airway);
}

TEST(LungEdits, AStrokeAtTheBorderStaysInTheImage) {
  const CtImage ct = water(plainGrid());
  LabelImage labels = nothing(ct.geometry);
  const Vec3 corner = ct.geometry.worldFromVoxel({-0.5, -0.5, -0.5});
  applyEdit(ct, stroke(LungTool::Paint, Side::Right, 15.0, {corner}), labels);
  const double eighth = 4.0 / 3.0 * Pi * std::pow(15.0, 3.0) / 8.0;
  EXPECT_NEAR(volumeMm3(labels, Right) / eighth, 1.0, 0.02);
}

/// A body in air, whose left half of a lung was found: a pocket of it is missing.
class LungSeed : public ::testing::Test {
 protected:
  LungSeed() {
    fill(ct, {6, 6, 0}, {83, 73, 69}, 40);  // the body
    for (int k = 25; k < 45; ++k) {         // the pocket, a ball, with noise
      for (int j = 20; j < 60; ++j) {
        for (int i = 20; i < 60; ++i) {
          const Vec3 away = geometry.worldFromVoxel(Vec3(i, j, k)) - middle;
          if (away.norm() > 9.0) continue;
          ct.at(i, j, k) = static_cast<std::int16_t>(-850 + (i * 7 + j * 3 + k * 5) % 40);
          ++pocket;
        }
      }
    }
    fill(ct, {65, 20, 20}, {75, 50, 50}, -850);  // another space, which is none of it
  }

  template <class Voxels>
  void fill(Voxels& image, const std::array<int, 3>& low, const std::array<int, 3>& high,
            int value) const {
    for (int k = low[2]; k <= high[2]; ++k) {
      for (int j = low[1]; j <= high[1]; ++j) {
        for (int i = low[0]; i <= high[0]; ++i) {
          image.at(i, j, k) = static_cast<typename Voxels::value_type>(value);
        }
      }
    }
  }

  LungEdit seed(const Vec3& at) const { return stroke(LungTool::Seed, Side::Left, 5.0, {at}); }

  std::string refusal(const LungEdit& edit) {
    const LabelImage before = labels;
    try {
      applyEdit(ct, edit, labels);
    } catch (const InvalidInput& error) {
      EXPECT_EQ(labels.voxels, before.voxels) << "something was left behind";
      return error.what();
    }
    return "nothing was refused";
  }

  ImageGeometry geometry = plainGrid();
  Vec3 middle = geometry.worldFromVoxel({40.0, 40.0, 35.0});
  CtImage ct = water(geometry, -1000);
  LabelImage labels = nothing(geometry);
  std::size_t pocket = 0;
};

TEST_F(LungSeed, TakesAPocketAndNothingElse) {
  EXPECT_EQ(applyEdit(ct, seed(middle), labels), pocket);
  EXPECT_EQ(static_cast<std::size_t>(std::count(labels.voxels.begin(), labels.voxels.end(), Left)),
            pocket);
  for (std::size_t v = 0; v < labels.voxels.size(); ++v) {
    if (labels.voxels[v] == 0) continue;
    ASSERT_LT(ct.voxels[v], -500);
  }
  EXPECT_EQ(labels.at(70, 30, 30), 0) << "another space";
  EXPECT_THAT(refusal(seed(middle)), HasSubstr("lies in the left lung already"));
}

TEST_F(LungSeed, StopsAtLungsThatAreThere) {
  fill(ct, {40, 40, 35}, {75, 42, 37}, -850);  // a bridge to the other space
  fill(labels, {62, 6, 6}, {64, 73, 63}, Right);
  fill(ct, {62, 6, 6}, {64, 73, 63}, -850);
  applyEdit(ct, seed(middle), labels);
  EXPECT_EQ(labels.at(61, 41, 36), Left);
  EXPECT_EQ(labels.at(63, 41, 36), Right);
  EXPECT_EQ(labels.at(66, 41, 36), 0);
}

TEST_F(LungSeed, RefusesToLeakOutOfTheBody) {
  fill(ct, {40, 0, 35}, {40, 40, 35}, -980);  // one voxel wide
  fill(ct, {0, 0, 0}, {89, 5, 69}, -1000);
  EXPECT_THAT(refusal(seed(middle)), HasSubstr("leaks out of the body"));
}

TEST_F(LungSeed, RefusesToLeakIntoTheAirways) {
  fill(ct, {38, 55, 5}, {46, 63, 60}, -1000);
  fill(labels, {39, 56, 5}, {45, 62, 60}, Airway);
  EXPECT_EQ(applyEdit(ct, seed(middle), labels), pocket) << "there is a wall between them";
  labels.voxels = nothing(geometry).voxels;
  fill(labels, {39, 56, 5}, {45, 62, 60}, Airway);
  fill(ct, {38, 41, 33}, {42, 55, 37}, -990);  // a bronchus that opens into it
  EXPECT_THAT(refusal(seed(middle)), HasSubstr("leaks into the airways"));
}

TEST_F(LungSeed, RefusesGasAndTissueAndTooMuch) {
  EXPECT_THAT(refusal(seed(geometry.worldFromVoxel({10.0, 10.0, 35.0}))),
              HasSubstr("has 40 HU, which is not less dense than -500 HU"));
  fill(ct, {12, 12, 30}, {18, 18, 40}, -1000);
  EXPECT_THAT(refusal(seed(geometry.worldFromVoxel({15.0, 15.0, 35.0}))),
              HasSubstr("as empty as air outside of lungs"));
  labels.at(40, 40, 35) = Airway;
  EXPECT_THAT(refusal(seed(middle)), HasSubstr("lies in the airways already"));
  labels.at(40, 40, 35) = 0;
  // The same grid, as large as a room.
  ct.geometry.spacing = labels.geometry.spacing = Vec3(12.0, 12.0, 12.0);
  EXPECT_THAT(refusal(seed(labels.geometry.worldFromVoxel({40.0, 40.0, 35.0}))),
              HasSubstr("more than 3000 ml"));
}

TEST(LungEdits, SayWhatIsWrongWithThem) {
  const ImageGeometry grid = plainGrid();
  const Vec3 there = grid.worldFromVoxel({40.0, 40.0, 35.0});
  EXPECT_EQ(problemOf(stroke(LungTool::Paint, Side::Right, 5.0, {there}), grid), "");
  EXPECT_EQ(problemOf(stroke(LungTool::Erase, Side::None, 5.0, {there}), grid), "");
  EXPECT_THAT(problemOf(stroke(LungTool::Paint, Side::None, 5.0, {there}), grid),
              HasSubstr("which lung"));
  EXPECT_THAT(problemOf(stroke(LungTool::Paint, Side::Right, 0.2, {there}), grid),
              HasSubstr("radius"));
  EXPECT_THAT(problemOf(stroke(LungTool::Paint, Side::Right, 5.0, {}), grid), HasSubstr("points"));
  EXPECT_THAT(problemOf(stroke(LungTool::Paint, Side::Right, 5.0, {there, Vec3(900, 0, 0)}), grid),
              HasSubstr("(900.0, 0.0, 0.0) mm, which is outside the image"));
  EXPECT_THAT(problemOf(stroke(LungTool::Seed, Side::Right, 5.0, {there, there}), grid),
              HasSubstr("a seed is one"));
  const CtImage ct = water(grid);
  const std::vector<LungEdit> edits = {stroke(LungTool::Paint, Side::Right, 5.0, {there}),
                                       stroke(LungTool::Seed, Side::Right, 5.0, {there})};
  try {
    editedLabels(ct, nothing(grid), edits);
    FAIL() << "a seed in a lung";
  } catch (const InvalidInput& error) {
    EXPECT_THAT(error.what(), HasSubstr("edit 2 cannot be done: the seed at"));
  }
  ImageGeometry other = grid;
  other.spacing.x() = 0.81;
  EXPECT_FALSE(sameVoxels(grid, other));
  EXPECT_THROW(editedLabels(ct, nothing(other), edits), InvalidInput);
}

TEST(LungEdits, TheNearestLungIsToldByDistance) {
  LabelImage labels = nothing(plainGrid());
  const auto at = [&](double i) { return labels.geometry.worldFromVoxel({i, 40.0, 35.0}); };
  EXPECT_EQ(nearestLung(labels, at(40.0)), Side::None);
  labels.at(20, 40, 35) = Right;
  labels.at(70, 40, 35) = Left;
  EXPECT_EQ(nearestLung(labels, at(20.2)), Side::Right);
  EXPECT_EQ(nearestLung(labels, at(44.0)), Side::Right);
  EXPECT_EQ(nearestLung(labels, at(46.0)), Side::Left);
  EXPECT_EQ(nearestLung(labels, at(30.0)), Side::Right);
}

TEST(LungEdits, AreMeasuredAsTheyAre) {
  CtImage ct = water(plainGrid(), -860);
  LungSegmentation found;
  found.right.volumeMl = 1.0;
  found.right.volumeWithAirwaysMl = 1.5;
  LabelImage labels = nothing(ct.geometry);
  const Vec3 middle = ct.geometry.worldFromVoxel({45.0, 40.0, 35.0});
  applyEdit(ct, stroke(LungTool::Paint, Side::Right, 15.0, {middle}), labels);
  const LungSegmentation measured = measuredAgain(ct, labels, found, -500.0);
  EXPECT_NEAR(measured.right.volumeMl, volumeMm3(labels, Right) / 1000.0, 1e-9);
  EXPECT_NEAR(measured.right.volumeWithAirwaysMl, measured.right.volumeMl + 0.5, 1e-9);
  EXPECT_EQ(measured.right.meanHu, -860.0);
  EXPECT_NEAR(measured.right.airMl, measured.right.volumeMl, 1e-9);
  EXPECT_EQ(measured.left.volumeMl, 0.0);
  EXPECT_TRUE(measured.labels.voxels.empty());
  EXPECT_FALSE(measured.checks.empty());
}

}  // namespace
}  // namespace pneuma
