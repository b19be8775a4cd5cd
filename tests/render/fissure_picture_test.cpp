#include <array>
#include <cmath>
#include <memory>

#include <gtest/gtest.h>
#include <vtkNew.h>
#include <vtkRenderWindow.h>
#include <vtkRenderer.h>

#include "render/colour_map.h"
#include "render/drawing.h"
#include "render/generated_lungs.h"
#include "render/picture.h"
#include "render/slice_picture.h"

// Fissures that are edited, over slices and in the 3-D view.
namespace pneuma {
namespace {

constexpr SliceLook Plain{.annotations = false};

/// 101 mm each way about the origin; a right lung on the patient's right half, nothing on the left.
LabelImage halfALung() {
  LabelImage labels;
  labels.geometry.size = {101, 101, 101};
  labels.geometry.origin = Vec3::Constant(-50.0);
  labels.voxels.assign(labels.geometry.voxelCount(), 0);
  for (int k = 0; k < 101; ++k) {
    for (int j = 0; j < 101; ++j) {
      for (int i = 0; i < 50; ++i) labels.at(i, j, k) = static_cast<std::uint8_t>(Lobe::RightLung);
    }
  }
  return labels;
}

/// The oblique fissure at y = z, the horizontal one at z = 10.
SliceFissures twoFissures() {
  SliceFissures fissures;
  fissures.lines = {
      {Fissure::RightOblique,
       [](const Vec3& p) { return (p.z() - p.y()) * std::sqrt(0.5); },
       false,
       false,
       {}},
      {Fissure::RightHorizontal, [](const Vec3& p) { return p.z() - 10.0; }, false, false, {}}};
  return fissures;
}

class FissuresInSlices : public testing::Test {
 protected:
  Rgb at(const Vec3& p) {
    const SliceFrame frame = framedSlice(labels_.geometry, SlicePlane::Sagittal, p.x(), 404, 404);
    const Picture picture =
        slicePicture({.labels = &labels_, .fissures = &fissures_}, frame, Plain);
    const PicturePoint place = frame.drawnAt(p);
    return pixel(picture, static_cast<int>(place.x), static_cast<int>(place.y));
  }

  static double away(const Rgb& a, const Rgb& b) {
    return std::abs(a.r - b.r) + std::abs(a.g - b.g) + std::abs(a.b - b.b);
  }

  static Rgb filled(Lobe lobe) {
    return mixed({}, lobeColour(lobe, Palette::Pneuma), Plain.opacity);
  }

  static constexpr Rgb White{1.0, 1.0, 1.0};

  LabelImage labels_ = halfALung();
  SliceFissures fissures_ = twoFissures();
};

TEST_F(FissuresInSlices, LungsAreColouredByTheirLobes) {
  EXPECT_LT(away(at({-25.0, 30.0, 0.0}), filled(Lobe::RightLower)), 0.05);
  EXPECT_LT(away(at({-25.0, -30.0, 0.0}), filled(Lobe::RightMiddle)), 0.05);
  EXPECT_LT(away(at({-25.0, -30.0, 30.0}), filled(Lobe::RightUpper)), 0.05);
}

TEST_F(FissuresInSlices, LinesRunWhereTheHeightIsZeroAndTheLungIs) {
  EXPECT_LT(away(at({-25.0, -20.0, -20.0}), White), 0.8);  // of 1.9; half a pixel beside it
  EXPECT_LT(away(at({-25.0, -20.0, 10.0}), White), 0.3);
  EXPECT_GT(away(at({-25.0, 20.0, 10.0}), White), 0.5);    // behind the oblique one
  EXPECT_LT(away(at({25.0, -20.0, -20.0}), Rgb{}), 0.05);  // beside the lung
}

TEST_F(FissuresInSlices, ProposalsAreDashed) {
  const auto gaps = [&] {
    int dark = 0;
    for (int y = -40; y < 0; ++y) dark += away(at({-25.0, 1.0 * y, 10.0}), White) > 0.3 ? 1 : 0;
    return dark;
  };
  EXPECT_EQ(gaps(), 0);
  fissures_.lines[1].proposed = true;
  EXPECT_GT(gaps(), 8);
  EXPECT_LT(gaps(), 32);
}

TEST_F(FissuresInSlices, PartsThatDoNotShowAreDottedInAnotherColour) {
  const Rgb missing = rgbOfHex(0xff7033);
  const auto count = [&](double from, double to, const Rgb& colour) {
    int hits = 0;
    for (double y = from; y < to; y += 1.0)
      hits += away(at({-25.0, y, 10.0}), colour) < 0.3 ? 1 : 0;
    return hits;
  };
  fissures_.lines[1].shows = [](const Vec3& p) { return p.y() < -20.0; };
  EXPECT_EQ(count(-40.0, -22.0, White), 18);
  EXPECT_EQ(count(-18.0, 0.0, White), 0);
  EXPECT_GT(count(-18.0, 0.0, missing), 4);
  EXPECT_LT(count(-18.0, 0.0, missing), 14);  // there are gaps
}

TEST_F(FissuresInSlices, MarksAreDrawnNearTheirSliceAlone) {
  const Vec3 rim(0.0, 0.0, 4.5 * 0.25);  // the ring's radius, pixels of 0.25 mm
  const Vec3 place(-25.0, -30.0, 30.0);
  fissures_.marks = {{place, true}};
  EXPECT_GT(away(at(place + rim), filled(Lobe::RightUpper)), 0.3);
  fissures_.marks[0].place.x() += 2.5;
  EXPECT_LT(away(at(place + rim), filled(Lobe::RightUpper)), 0.05);
}

/// A scene with one lung, its oblique fissure at z = 0 and the horizontal one at z = 40.
class FissuresInTheScene : public testing::Test {
 protected:
  FissuresInTheScene() {
    window_->SetOffScreenRendering(1);
    window_->SetSize(300, 300);
    scene_.attachTo(window_);
    SceneOptions options;
    options.lobeOpacity = 1.0;
    options.annotations = false;
    scene_.setOptions(options);
    auto mesh = std::make_shared<const TriangleMesh>(
        test::ellipsoid(Vec3::Zero(), Vec3(60.0, 60.0, 100.0)));
    scene_.setSurfaces({{Lobe::RightLung, mesh}});
    auto oblique = std::make_shared<std::vector<float>>();
    auto horizontal = std::make_shared<std::vector<float>>();
    for (const Vec3& p : mesh->points) {
      oblique->push_back(static_cast<float>(p.z()));
      horizontal->push_back(static_cast<float>(p.z() - 40.0));
    }
    fissures_.lungs = {{Side::Right, mesh, oblique, horizontal}};
    scene_.look(viewDirection("A"));
  }

  ~FissuresInTheScene() override { scene_.attachTo(nullptr); }

  Rgb at(const Vec3& p) {
    const Picture picture = renderPicture(scene_, 300, 300);
    scene_.renderer()->SetWorldPoint(p.x(), p.y(), p.z(), 1.0);
    scene_.renderer()->WorldToDisplay();
    const double* place = scene_.renderer()->GetDisplayPoint();
    return pixel(picture, static_cast<int>(place[0]), 299 - static_cast<int>(place[1]));
  }

  /// The lobe whose colour has the hue that is drawn.
  Lobe lobeAt(const Vec3& p) {
    const Lab drawn = labOf(at(p));
    Lobe nearest = Lobe::Whole;
    double least = 1e9;
    for (const Lobe lobe : FiveLobes) {
      const Lab colour = labOf(lobeColour(lobe, Palette::Pneuma));
      const double away = std::abs(std::atan2(colour.b, colour.a) - std::atan2(drawn.b, drawn.a));
      if (away >= least) continue;
      least = away;
      nearest = lobe;
    }
    return nearest;
  }

  vtkNew<vtkRenderWindow> window_;
  Scene scene_;
  FissureScene fissures_;
};

TEST_F(FissuresInTheScene, LungsTakeTheColoursOfTheirLobesAndGiveThemBack) {
  const Rgb before = at({0.0, -60.0, 20.0});
  scene_.setFissures(fissures_);
  EXPECT_EQ(lobeAt({0.0, -50.0, -30.0}), Lobe::RightLower);
  EXPECT_EQ(lobeAt({0.0, -60.0, 20.0}), Lobe::RightMiddle);
  EXPECT_EQ(lobeAt({0.0, -50.0, 60.0}), Lobe::RightUpper);
  auto moved = std::make_shared<std::vector<float>>(*fissures_.lungs[0].oblique);
  for (float& height : *moved) height -= 30.0F;
  fissures_.lungs[0].oblique = moved;
  scene_.setFissures(fissures_);
  EXPECT_EQ(lobeAt({0.0, -60.0, 20.0}), Lobe::RightLower);
  scene_.setFissures({});
  EXPECT_EQ(at({0.0, -60.0, 20.0}), before);
}

TEST_F(FissuresInTheScene, ThePointOfALungUnderAPixelIsTheNearest) {
  scene_.setFissures(fissures_);
  scene_.updateAnnotations();
  window_->Render();
  const Vec3 front(0.0, -60.0, 0.0);
  scene_.renderer()->SetWorldPoint(front.x(), front.y(), front.z(), 1.0);
  scene_.renderer()->WorldToDisplay();
  const double* place = scene_.renderer()->GetDisplayPoint();
  const auto hit = scene_.lungPointAt(place[0], place[1]);
  ASSERT_TRUE(hit);
  EXPECT_LT((*hit - front).norm(), 0.5);
  EXPECT_FALSE(scene_.lungPointAt(2.0, 2.0));
}

TEST_F(FissuresInTheScene, MarksAreFoundAndMovedAcrossTheLineOfSight) {
  fissures_.marks = {{Vec3(20.0, 0.0, 30.0)}, {Vec3(-20.0, 0.0, 30.0)}};
  scene_.setFissures(fissures_);
  scene_.updateAnnotations();
  window_->Render();
  scene_.renderer()->SetWorldPoint(-20.0, 0.0, 30.0, 1.0);
  scene_.renderer()->WorldToDisplay();
  const double* place = scene_.renderer()->GetDisplayPoint();
  const double x = place[0];
  const double y = place[1];
  EXPECT_EQ(scene_.markAt(x + 3.0, y), 1U);
  EXPECT_FALSE(scene_.markAt(x + 14.0, y));
  const Vec3 moved = scene_.pointBeside(x, y + 20.0, fissures_.marks[1].place);
  EXPECT_GT(moved.z(), 35.0);
  EXPECT_NEAR(moved.y(), 0.0, 1.0);
  EXPECT_NEAR(moved.x(), -20.0, 1.0);
}

}  // namespace
}  // namespace pneuma
