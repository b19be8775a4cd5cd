#include "render/scene.h"

#include <cstdint>
#include <vector>

#include <gtest/gtest.h>
#include <vtkCamera.h>
#include <vtkNew.h>
#include <vtkRenderWindow.h>
#include <vtkRenderer.h>
#include <vtkUnsignedCharArray.h>

#include "core/random.h"
#include "render/generated_lungs.h"
#include "render/picture.h"

namespace pneuma {
namespace {

constexpr int SceneWidth = 400;
constexpr int SceneHeight = 300;

/// A scene in a window of its own, as an application holds it.
class SceneInAWindow : public testing::Test {
 protected:
  SceneInAWindow() : tree_(test::generatedTree()) {
    window_->SetOffScreenRendering(1);
    window_->SetSize(SceneWidth, SceneHeight);
    scene_.attachTo(window_);
    scene_.setSurfaces(test::generatedLobes());
    scene_.setTree(tree_);
  }

  ~SceneInAWindow() override { scene_.attachTo(nullptr); }

  /// The colours of all pixels.
  std::vector<unsigned char> everyColour() {
    scene_.updateAnnotations();
    window_->Render();
    vtkNew<vtkUnsignedCharArray> colours;
    window_->GetPixelData(0, 0, SceneWidth - 1, SceneHeight - 1, 0, colours);
    return {colours->GetPointer(0), colours->GetPointer(0) + colours->GetNumberOfValues()};
  }

  /// The pixel of a point.
  Vec3 pixelOf(const Vec3& p) {
    scene_.renderer()->SetWorldPoint(p.x(), p.y(), p.z(), 1.0);
    scene_.renderer()->WorldToDisplay();
    return Vec3(scene_.renderer()->GetDisplayPoint());
  }

  std::shared_ptr<const AirwayTree> tree_;
  vtkNew<vtkRenderWindow> window_;
  Scene scene_;
};

TEST_F(SceneInAWindow, FindsTheBranchUnderAPixel) {
  scene_.look({});
  scene_.updateAnnotations();
  window_->Render();
  const Branch& trachea = (*tree_)[0];
  const Vec3 pixel = pixelOf(0.5 * (trachea.proximal + trachea.distal));
  EXPECT_EQ(scene_.branchAt(pixel.x(), pixel.y()), 0U);
  EXPECT_EQ(scene_.branchAt(2.0, 2.0), std::nullopt);
}

TEST_F(SceneInAWindow, FindsTheSurfaceUnderAPixelWhereItStandsAndSaysWhereThatIsAtRest) {
  const auto near = std::make_shared<const TriangleMesh>(
      TriangleMesh{{{-50, -20, -50}, {50, -20, -50}, {0, -20, 60}}, {{0, 1, 2}}});
  const auto far = std::make_shared<const TriangleMesh>(
      TriangleMesh{{{-50, 20, -50}, {50, 20, -50}, {0, 20, 60}}, {{0, 1, 2}}});
  scene_.setSurfaces({{Lobe::RightLower, far}, {Lobe::RightUpper, near}});
  scene_.look(viewDirection("A"));
  scene_.updateAnnotations();
  Vec3 pixel = pixelOf(Vec3(5, -20, 0));
  auto hit = scene_.surfaceAt(pixel.x(), pixel.y());
  ASSERT_TRUE(hit);
  EXPECT_EQ(hit->surface, 1U);
  EXPECT_NEAR((hit->place - Vec3(5, -20, 0)).norm(), 0.0, 0.2);
  EXPECT_FALSE(scene_.surfaceAt(2.0, 2.0));
  scene_.setSurfaceVisible(1, false);
  EXPECT_EQ(scene_.surfaceAt(pixel.x(), pixel.y())->surface, 0U);
  scene_.setSurfaceVisible(1, true);
  auto breathing = std::make_shared<BreathingScene>();
  const std::vector<Vec3> down(3, Vec3(0, 0, -30));
  breathing->surfaces = {{Side::Right, down, {}}, {Side::Right, down, {}}};
  scene_.setBreathing(breathing);
  scene_.setBreath({1.0, 1.0});
  pixel = pixelOf(Vec3(5, -20, -30));
  hit = scene_.surfaceAt(pixel.x(), pixel.y());
  ASSERT_TRUE(hit);
  EXPECT_NEAR((hit->place - Vec3(5, -20, 0)).norm(), 0.0, 0.2);
}

TEST_F(SceneInAWindow, ADenserSurfaceIsAsDenseAsAllOfThemWouldBe) {
  scene_.look({});
  const auto usual = everyColour();
  const std::size_t count = test::generatedLobes().size();
  scene_.setSurfaceDensity(0, 2.0);
  EXPECT_NE(everyColour(), usual);
  for (std::size_t i = 1; i < count; ++i) scene_.setSurfaceDensity(i, 2.0);
  const auto dense = everyColour();
  for (std::size_t i = 0; i < count; ++i) scene_.setSurfaceDensity(i, 1.0);
  EXPECT_EQ(everyColour(), usual);
  SceneOptions options = scene_.options();
  options.lobeOpacity *= 2.0;
  scene_.setOptions(options);
  EXPECT_EQ(everyColour(), dense);
}

TEST_F(SceneInAWindow, OfTwoBranchesFindsTheNearer) {
  AirwayTree tree;
  Branch branch;
  branch.radiusMm = 3.0;
  branch.proximal = Vec3(0, 50, -40);
  branch.distal = Vec3(0, 50, 40);
  tree.add(branch);
  branch.parent = 0;
  branch.proximal = Vec3(-40, -50, 0);
  branch.distal = Vec3(40, -50, 0);
  tree.add(branch);
  scene_.setTree(std::make_shared<const AirwayTree>(tree));
  scene_.look(viewDirection("A"));
  scene_.updateAnnotations();
  Vec3 pixel = pixelOf(Vec3(0, -50, 0));
  EXPECT_EQ(scene_.branchAt(pixel.x(), pixel.y()), 1U);
  scene_.look(viewDirection("P"));
  scene_.updateAnnotations();
  pixel = pixelOf(Vec3(0, 50, 0));
  EXPECT_EQ(scene_.branchAt(pixel.x(), pixel.y()), 0U);
}

TEST_F(SceneInAWindow, FindsThinBranchesNearThePixelButNoHiddenOnes) {
  const std::size_t last = tree_->size() - 1;
  const Branch& terminal = (*tree_)[last];
  scene_.setOptions({.maxGeneration = 4});
  scene_.look({});
  scene_.updateAnnotations();
  const Vec3 pixel = pixelOf(0.5 * (terminal.proximal + terminal.distal));
  const auto hit = scene_.branchAt(pixel.x(), pixel.y());
  EXPECT_NE(hit, last);
  AirwayTree alone;
  Branch thin = terminal;
  thin.parent = -1;
  thin.radiusMm = 0.05;
  alone.add(thin);
  scene_.setTree(std::make_shared<const AirwayTree>(alone));
  EXPECT_EQ(scene_.branchAt(pixel.x() + 2.0, pixel.y()), 0U);
}

TEST_F(SceneInAWindow, RemembersWhereItLooksFrom) {
  scene_.look({25.0, -10.0});
  EXPECT_NEAR(scene_.lookingFrom().azimuthDeg, 25.0, 1e-6);
  EXPECT_NEAR(scene_.lookingFrom().elevationDeg, -10.0, 1e-6);
}

TEST_F(SceneInAWindow, FramesAgainWhenResizedUntilSomebodyMovesTheCamera) {
  scene_.look({});
  vtkCamera* camera = scene_.renderer()->GetActiveCamera();
  const double distance = camera->GetDistance();
  window_->SetSize(SceneWidth / 2, SceneHeight);
  scene_.updateAnnotations();
  EXPECT_GT(camera->GetDistance(), 1.2 * distance);
  camera->Azimuth(5.0);
  const double moved = camera->GetDistance();
  window_->SetSize(SceneWidth, SceneHeight);
  scene_.updateAnnotations();
  EXPECT_DOUBLE_EQ(camera->GetDistance(), moved);
}

TEST_F(SceneInAWindow, PeersAreFramedAtOneScaleWhicheverIsShown) {
  AirwayTree longTree;
  longTree.add({.parent = -1, .proximal = Vec3(0, 0, 400), .distal = Vec3(0, 0, -400)});
  const auto peer = std::make_shared<const AirwayTree>(longTree);
  scene_.setSurfaces({});
  scene_.look({});
  const double alone = scene_.renderer()->GetActiveCamera()->GetDistance();
  scene_.setPeers({tree_, peer});
  scene_.look({});
  const double beside = scene_.renderer()->GetActiveCamera()->GetDistance();
  EXPECT_GT(beside, 2.0 * alone);
  scene_.setTree(peer);
  scene_.updateAnnotations();
  EXPECT_DOUBLE_EQ(scene_.renderer()->GetActiveCamera()->GetDistance(), beside);
  scene_.look({});
  EXPECT_DOUBLE_EQ(scene_.renderer()->GetActiveCamera()->GetDistance(), beside);
}

TEST_F(SceneInAWindow, KeepsTheLegendInItsColumn) {
  scene_.look({});
  const Picture with = renderPicture(scene_, SceneWidth, SceneHeight);
  const int column = scene_.legendWidth();
  EXPECT_GT(column, 20);
  EXPECT_LT(column, SceneWidth / 3);
  scene_.setOptions({.legend = false});
  const Picture without = renderPicture(scene_, SceneWidth, SceneHeight);
  EXPECT_EQ(scene_.legendWidth(), 0);
  // The camera has not moved: but for the letters at the edges, nothing else changes.
  for (int y = 30; y < SceneHeight - 30; ++y) {
    for (int x = 30; x < SceneWidth - column - 30; ++x) {
      const auto at = static_cast<std::size_t>(3 * (y * SceneWidth + x));
      ASSERT_EQ(with.rgb[at], without.rgb[at]) << x << " " << y;
    }
  }
  EXPECT_NE(with.rgb, without.rgb);
}

TEST_F(SceneInAWindow, GoesBackToItsWindowAfterAPicture) {
  scene_.look({});
  const Picture first = renderPicture(scene_, 160, 120);
  EXPECT_EQ(scene_.renderer()->GetRenderWindow(), window_.Get());
  scene_.updateAnnotations();
  window_->Render();
  EXPECT_EQ(renderPicture(scene_, 160, 120).rgb, first.rgb);
}

TEST_F(SceneInAWindow, HighlightsTheSelectedBranch) {
  scene_.look({});
  const Picture before = renderPicture(scene_, 160, 120);
  scene_.select(1);
  const Picture selected = renderPicture(scene_, 160, 120);
  EXPECT_NE(selected.rgb, before.rgb);
  scene_.select(std::nullopt);
  EXPECT_EQ(renderPicture(scene_, 160, 120).rgb, before.rgb);
  scene_.select(1'000'000);
  EXPECT_EQ(renderPicture(scene_, 160, 120).rgb, before.rgb);
}

TEST_F(SceneInAWindow, LooksAlikeWhileInteractive) {
  scene_.setTree(test::generatedTree(8));  // down to airways that become lines
  scene_.look({});
  const Picture fine = renderPicture(scene_, 320, 240);
  scene_.setInteractive(true);
  const Picture coarse = renderPicture(scene_, 320, 240);
  EXPECT_NE(coarse.rgb, fine.rgb);
  EXPECT_LT(compare(coarse, fine).error, 0.2);
  scene_.setInteractive(false);
  EXPECT_EQ(renderPicture(scene_, 320, 240).rgb, fine.rgb);
}

/// `count` points in the right upper lobe, where the generated tree grows.
std::vector<Vec3> pointsInALobe(std::size_t count) {
  const test::EllipsoidLobe lobe = test::ellipsoidLobes().front();
  Random random(1);
  std::vector<Vec3> points;
  while (points.size() < count) {
    const Vec3 unit(random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-1, 1));
    if (unit.norm() < 1.0) points.push_back(lobe.centre + lobe.semiAxes.cwiseProduct(unit));
  }
  return points;
}

TEST_F(SceneInAWindow, ShowsAPreviewUntilItIsCleared) {
  scene_.look({});
  scene_.select(1);
  const Picture tree = renderPicture(scene_, 320, 240);
  const Vec3 eye(scene_.renderer()->GetActiveCamera()->GetPosition());
  scene_.addPreview({});
  EXPECT_EQ(renderPicture(scene_, 320, 240).rgb, tree.rgb);
  scene_.addPreview(pointsInALobe(500));
  const Picture some = renderPicture(scene_, 320, 240);
  EXPECT_NE(some.rgb, tree.rgb);
  scene_.addPreview(pointsInALobe(2000));
  EXPECT_EQ(scene_.previewed(), 2500U);
  EXPECT_NE(renderPicture(scene_, 320, 240).rgb, some.rgb);
  scene_.setInteractive(true);
  scene_.setInteractive(false);
  EXPECT_EQ(Vec3(scene_.renderer()->GetActiveCamera()->GetPosition()), eye);
  scene_.clearPreview();
  EXPECT_EQ(scene_.previewed(), 0U);
  EXPECT_EQ(renderPicture(scene_, 320, 240).rgb, tree.rgb);
}

TEST_F(SceneInAWindow, DrawsWhatIsAddedToAPreviewOnTheScreen) {
  const auto drawn = [&] {
    scene_.updateAnnotations();
    window_->Render();
    vtkNew<vtkUnsignedCharArray> pixels;
    window_->GetPixelData(0, 0, SceneWidth - 1, SceneHeight - 1, 0, pixels);
    const std::uint8_t* first = pixels->GetPointer(0);
    return std::vector<std::uint8_t>(first, first + pixels->GetNumberOfValues());
  };
  scene_.look({});
  // Those that come later lie inside the box of the first, which says how dots fade.
  const test::EllipsoidLobe lobe = test::ellipsoidLobes().front();
  scene_.addPreview(std::vector<Vec3>{lobe.centre - lobe.semiAxes, lobe.centre + lobe.semiAxes});
  const auto corners = drawn();
  EXPECT_EQ(drawn(), corners);
  scene_.addPreview(pointsInALobe(1000));
  EXPECT_NE(drawn(), corners);
}

TEST_F(SceneInAWindow, GrownBranchesGiveWayToThePreviewAndMeasuredOnesStay) {
  const std::size_t last = tree_->size() - 1;
  ASSERT_EQ((*tree_)[last].origin, Origin::Grown);
  ASSERT_EQ((*tree_)[0].origin, Origin::Measured);
  scene_.look({});
  scene_.addPreview(std::vector<Vec3>{Vec3(0, 5, 150)});
  scene_.select(last);
  const Picture preview = renderPicture(scene_, 320, 240);
  scene_.select(std::nullopt);
  EXPECT_EQ(renderPicture(scene_, 320, 240).rgb, preview.rgb);
  scene_.updateAnnotations();
  for (const std::size_t branch : {std::size_t{0}, last}) {
    const Vec3 pixel = pixelOf(0.5 * ((*tree_)[branch].proximal + (*tree_)[branch].distal));
    const auto hit = scene_.branchAt(pixel.x(), pixel.y());
    EXPECT_EQ(hit.has_value(), branch == 0);
  }
  // As with the measured branches alone, but for the round ends that these get.
  AirwayTree measured;
  for (const Branch& branch : *tree_) {
    if (branch.origin == Origin::Measured) measured.add(branch);
  }
  scene_.setTree(std::make_shared<const AirwayTree>(measured));
  const double ends = compare(renderPicture(scene_, 320, 240), preview).error;
  scene_.setTree(nullptr);
  const double airways = compare(renderPicture(scene_, 320, 240), preview).error;
  EXPECT_LT(ends, 0.1 * airways) << ends << " of " << airways;
}

TEST_F(SceneInAWindow, ATreeSetDuringThePreviewShowsWhenItIsCleared) {
  const auto grown = test::generatedTree(3);
  scene_.look({});
  scene_.addPreview(pointsInALobe(100));
  const Picture preview = renderPicture(scene_, 320, 240);
  scene_.setTree(grown);
  EXPECT_EQ(renderPicture(scene_, 320, 240).rgb, preview.rgb);
  scene_.clearPreview();
  const Picture after = renderPicture(scene_, 320, 240);
  scene_.setTree(nullptr);
  scene_.setTree(grown);
  EXPECT_EQ(renderPicture(scene_, 320, 240).rgb, after.rgb);
}

TEST_F(SceneInAWindow, FramesThePreviewToo) {
  scene_.setSurfaces({});
  scene_.look({});
  const double distance = scene_.renderer()->GetActiveCamera()->GetDistance();
  scene_.addPreview(std::vector<Vec3>{Vec3(-400, 0, 0), Vec3(400, 0, 0)});
  EXPECT_EQ(scene_.renderer()->GetActiveCamera()->GetDistance(), distance);
  scene_.look({});
  EXPECT_GT(scene_.renderer()->GetActiveCamera()->GetDistance(), 1.5 * distance);
}

TEST_F(SceneInAWindow, ShowsASheetFromBothSides) {
  scene_.setTree(nullptr);
  scene_.setSurfaces({});
  SceneOptions options;
  options.annotations = false;
  scene_.setOptions(options);
  const TriangleMesh sheet{{{0, 0, 0}, {100, 0, 0}, {100, 0, 80}, {0, 0, 80}},
                           {{0, 1, 2}, {0, 2, 3}}};
  for (const char* view : {"anterior", "posterior"}) {
    scene_.setSurfaces({});
    scene_.look(viewDirection(view));
    const std::vector<unsigned char> empty = everyColour();
    scene_.setSurfaces({{Lobe::Whole, std::make_shared<const TriangleMesh>(sheet)}});
    scene_.look(viewDirection(view));
    EXPECT_NE(everyColour(), empty) << view;
  }
}

TEST_F(SceneInAWindow, EmptiesAgain) {
  scene_.setTree(nullptr);
  scene_.setSurfaces({});
  scene_.look({});
  const Picture picture = renderPicture(scene_, 100, 80);
  const Picture empty = [] {
    Scene scene;
    return renderPicture(scene, 100, 80);
  }();
  EXPECT_EQ(picture.rgb, empty.rgb);
  EXPECT_EQ(scene_.branchAt(50, 40), std::nullopt);
}

}  // namespace
}  // namespace pneuma
