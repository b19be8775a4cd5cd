#include "render/breathing_scene.h"

#include <algorithm>
#include <cstdlib>
#include <set>

#include <gtest/gtest.h>

#include "generated_lungs.h"
#include "render/picture.h"
#include "render/scene.h"

namespace pneuma {
namespace {

constexpr int BreathWidth = 400;
constexpr int BreathHeight = 300;

const Vec3 RightCentre(-70.0, 0.0, 0.0);
const Vec3 LeftCentre(70.0, 0.0, 0.0);

std::shared_ptr<const TriangleMesh> lung(const Vec3& centre) {
  return std::make_shared<const TriangleMesh>(test::ellipsoid(centre, {50.0, 75.0, 110.0}));
}

/// Down and outwards, most at the base.
Vec3 displacementAt(const Vec3& p) {
  const double share = (110.0 - p.z()) / 220.0;
  return {0.04 * p.x(), -6.0 * share, -22.0 * share * share};
}

std::vector<Vec3> displacements(const TriangleMesh& mesh) {
  std::vector<Vec3> result;
  for (const Vec3& p : mesh.points) result.push_back(displacementAt(p));
  return result;
}

std::vector<SceneSurface> surfaces() {
  return {{Lobe::RightLung, lung(RightCentre)}, {Lobe::LeftLung, lung(LeftCentre)}};
}

/// A bronchus in each lung, with a bend in the right one.
std::shared_ptr<const AirwayTree> bronchi() {
  auto tree = std::make_shared<AirwayTree>();
  Branch right;
  right.proximal = {-30.0, 0.0, 40.0};
  right.via = {{Vec3(-60.0, 0.0, 20.0), 4.0}};
  right.distal = {-70.0, 0.0, -60.0};
  right.radiusMm = 4.0;
  right.lobe = Lobe::RightLower;
  tree->add(right);
  Branch left = right;
  left.via.clear();
  left.proximal.x() = 30.0;
  left.distal.x() = 70.0;
  left.lobe = Lobe::LeftLower;
  tree->add(left);
  return tree;
}

/// Each bronchus goes as one piece, so that tubes that were drawn anew would be the same.
TreeMotion motionOf(const AirwayTree& tree) {
  TreeMotion motion;
  for (std::size_t n = 0; n < tree.size(); ++n) {
    const Vec3 u = displacementAt(tree[n].distal);
    motion.ends.push_back({u, u});
    motion.via.emplace_back(tree[n].via.size(), u);
  }
  return motion;
}

BreathingScene breathing() {
  BreathingScene scene;
  const std::vector<SceneSurface> given = surfaces();
  scene.surfaces = {{Side::Right, displacements(*given[0].mesh), {}},
                    {Side::Left, displacements(*given[1].mesh), {}}};
  scene.tree = motionOf(*bronchi());
  return scene;
}

std::vector<SceneSurface> surfacesAt(const BreathScale& scale) {
  std::vector<SceneSurface> moved = surfaces();
  for (SceneSurface& surface : moved) {
    const double s = surface.lobe == Lobe::RightLung ? scale.right : scale.left;
    auto mesh = std::make_shared<TriangleMesh>(*surface.mesh);
    for (Vec3& p : mesh->points) p += s * displacementAt(p);
    surface.mesh = std::move(mesh);
  }
  return moved;
}

SceneOptions plain() {
  SceneOptions options;
  options.annotations = false;
  return options;
}

/// What the graphics card makes of it.
Picture played(const BreathScale& scale, bool interactive = false) {
  Scene scene;
  scene.setOptions(plain());
  scene.setSurfaces(surfaces());
  scene.setTree(bronchi());
  scene.look({});
  scene.setBreathing(std::make_shared<const BreathingScene>(breathing()));
  scene.setBreath(scale);
  scene.setInteractive(interactive);
  return renderPicture(scene, BreathWidth, BreathHeight);
}

/// The same with everything moved here, seen from the same place.
Picture moved(const BreathScale& scale, bool interactive = false) {
  Scene scene;
  scene.setOptions(plain());
  scene.setSurfaces(surfaces());
  scene.setTree(bronchi());
  scene.look({});
  scene.setSurfaces(surfacesAt(scale));
  const auto rest = bronchi();
  const TreeMotion motion = motionOf(*rest);
  auto tree = std::make_shared<AirwayTree>();
  for (std::size_t n = 0; n < rest->size(); ++n) {
    const Branch& branch = (*rest)[n];
    tree->add(movedBranch(branch, motion, n, scale.of(side(branch.lobe))));
  }
  scene.setTree(tree);
  scene.setInteractive(interactive);
  return renderPicture(scene, BreathWidth, BreathHeight);
}

/// How many channels differ by more than 2 of 255.
std::size_t channelsThatDiffer(const Picture& a, const Picture& b) {
  std::size_t count = 0;
  for (std::size_t i = 0; i < a.rgb.size(); ++i) {
    if (std::abs(static_cast<int>(a.rgb[i]) - static_cast<int>(b.rgb[i])) > 2) ++count;
  }
  return count;
}

TEST(BreathingScene, TheGraphicsCardMovesAsTheProcessorDoes) {
  for (const BreathScale& scale :
       {BreathScale{0.0, 0.0}, BreathScale{1.0, 1.0}, BreathScale{0.3, -0.4}}) {
    EXPECT_EQ(channelsThatDiffer(played(scale), moved(scale)), 0U)
        << scale.right << ", " << scale.left;
  }
  EXPECT_GT(channelsThatDiffer(played({}), played({1.0, 1.0})), 20000U);
}

TEST(BreathingScene, CoarseAirwaysMoveToo) {
  EXPECT_EQ(channelsThatDiffer(played({1.0, 0.5}, true), moved({1.0, 0.5}, true)), 0U);
}

TEST(BreathingScene, TakesNoMotionOfOtherSurfaces) {
  Scene scene;
  scene.setOptions(plain());
  scene.setSurfaces({surfaces()[0]});
  scene.look({});
  const Picture still = renderPicture(scene, BreathWidth, BreathHeight);
  scene.setBreathing(std::make_shared<const BreathingScene>(breathing()));
  scene.setBreath({1.0, 1.0});
  EXPECT_EQ(renderPicture(scene, BreathWidth, BreathHeight).rgb, still.rgb);
}

TEST(BreathingScene, StandsAgainWithoutABreath) {
  Scene scene;
  scene.setOptions(plain());
  scene.setSurfaces(surfaces());
  scene.setTree(bronchi());
  scene.look({});
  const Picture before = renderPicture(scene, BreathWidth, BreathHeight);
  scene.setBreathing(std::make_shared<const BreathingScene>(breathing()));
  scene.setBreath({1.0, 1.0});
  EXPECT_NE(renderPicture(scene, BreathWidth, BreathHeight).rgb, before.rgb);
  scene.setBreathing(nullptr);
  EXPECT_EQ(renderPicture(scene, BreathWidth, BreathHeight).rgb, before.rgb);
}

TEST(BreathingScene, ABranchIsFoundWhereItIsDrawn) {
  Scene scene;
  scene.setOptions(plain());
  scene.setSurfaces(surfaces());
  scene.setTree(bronchi());
  scene.look({});
  BreathingScene far = breathing();
  for (auto& ends : far.tree.ends) ends = {Vec3(0.0, 0.0, -60.0), Vec3(0.0, 0.0, -60.0)};
  for (auto& via : far.tree.via) {
    for (Vec3& u : via) u = Vec3(0.0, 0.0, -60.0);
  }
  scene.setBreathing(std::make_shared<const BreathingScene>(far));
  renderPicture(scene, BreathWidth, BreathHeight);
  EXPECT_EQ(scene.branchAt(10.0, 10.0), std::nullopt);
}

TEST(BreathingScene, ValuesColourTheLungsAndStandInTheLegend) {
  BreathingScene values = breathing();
  values.quantity = "Displacement, mm";
  for (BreathingScene::Surface& surface : values.surfaces) {
    for (const Vec3& u : surface.displacement) surface.values.push_back(u.norm());
  }
  Scene scene;
  scene.setSurfaces(surfaces());
  scene.look({});
  scene.setBreathing(std::make_shared<const BreathingScene>(breathing()));
  const Picture lobes = renderPicture(scene, BreathWidth, BreathHeight);
  scene.setBreathing(std::make_shared<const BreathingScene>(values));
  const Picture coloured = renderPicture(scene, BreathWidth, BreathHeight);
  EXPECT_GT(channelsThatDiffer(lobes, coloured), 20000U);
  EXPECT_GT(scene.legendWidth(), 20);
}

TEST(BreathingScene, CoarseSurfacesAreFewTrianglesBetweenTheSamePoints) {
  BreathingScene scene = breathing();
  for (BreathingScene::Surface& surface : scene.surfaces) {
    for (const Vec3& u : surface.displacement) surface.values.push_back(u.z());
  }
  const auto right = lung(RightCentre);
  const auto left = lung(LeftCentre);
  addCoarseSurfaces(scene, {right, left}, 1000);
  for (std::size_t i = 0; i < 2; ++i) {
    const BreathingScene::Surface& surface = scene.surfaces[i];
    ASSERT_NE(surface.coarse, nullptr);
    EXPECT_NEAR(static_cast<double>(surface.coarse->triangles.size()), 500.0, 60.0);
    ASSERT_EQ(surface.coarseDisplacement.size(), surface.coarse->points.size());
    ASSERT_EQ(surface.coarseValues.size(), surface.coarse->points.size());
    for (std::size_t n = 0; n < surface.coarse->points.size(); ++n) {
      EXPECT_EQ(surface.coarseDisplacement[n], displacementAt(surface.coarse->points[n]));
      EXPECT_EQ(surface.coarseValues[n], surface.coarseDisplacement[n].z());
    }
  }
  BreathingScene few = breathing();
  addCoarseSurfaces(few, {right, left}, 1000000);
  EXPECT_EQ(few.surfaces[0].coarse, nullptr);
}

TEST(BreathingScene, AVeryFineSurfaceIsThinnedOutBetweenItsOwnPointsAndKeepsItsShape) {
  const TriangleMesh fine = test::ellipsoid(RightCentre, {50.0, 75.0, 110.0}, 9);
  ASSERT_GT(fine.triangles.size(), 100000U);
  const BreathingScene::Shell shell =
      shellOf(BreathingScene::Shell::Of::ChestWall, Side::Right, fine, displacements(fine));
  EXPECT_NEAR(static_cast<double>(shell.mesh->triangles.size()), 8000.0, 1000.0);
  EXPECT_NEAR(signedVolumeMm3(*shell.mesh) / signedVolumeMm3(fine), 1.0, 0.02);
  for (std::size_t n = 0; n < shell.mesh->points.size(); ++n) {
    EXPECT_EQ(shell.displacement[n], displacementAt(shell.mesh->points[n]));
  }
}

BreathingScene::Shell chestWall() {
  const TriangleMesh wall = test::ellipsoid(LeftCentre, {58.0, 84.0, 120.0});
  return shellOf(BreathingScene::Shell::Of::ChestWall, Side::Left, wall, displacements(wall));
}

Picture drawn(const BreathingScene& breathing, const BreathScale& scale, bool onionSkin = false) {
  Scene scene;
  scene.setOptions(plain());
  scene.setSurfaces(surfaces());
  scene.look({});
  scene.setBreathing(std::make_shared<const BreathingScene>(breathing));
  scene.setBreath(scale);
  scene.setOnionSkin(onionSkin);
  return renderPicture(scene, BreathWidth, BreathHeight);
}

TEST(BreathingScene, AChestWallStandsAroundTheLungAndMovesByItsOwnScale) {
  const BreathingScene bare = breathing();
  BreathingScene walled = bare;
  walled.shells.push_back(chestWall());
  EXPECT_GT(channelsThatDiffer(drawn(bare, {}), drawn(walled, {})), 2000U);
  EXPECT_GT(channelsThatDiffer(drawn(walled, {}), drawn(walled, {0.0, 0.0, 1.0})), 2000U);
  BreathingScene stands = bare;
  stands.shells.push_back(chestWall());
  auto moved = std::make_shared<TriangleMesh>(*stands.shells[0].mesh);
  for (Vec3& p : moved->points) p += displacementAt(p);
  stands.shells[0].mesh = std::move(moved);
  // Normals of moved points are linear in s.
  EXPECT_LT(channelsThatDiffer(drawn(walled, {0.0, 0.0, 1.0}), drawn(stands, {})), 50U);
}

TEST(BreathingScene, AnOnionSkinShowsTheEndsOfTheBreathWhereverTheLungsAre) {
  const BreathingScene bare = breathing();
  BreathingScene skinned = bare;
  addOnionSkin(skinned, {surfaces()[0].mesh, surfaces()[1].mesh}, {}, {1.0, 1.0});
  ASSERT_EQ(skinned.shells.size(), 4U);
  EXPECT_EQ(drawn(bare, {}).rgb, drawn(skinned, {}).rgb) << "it is off at first";
  EXPECT_GT(channelsThatDiffer(drawn(bare, {}), drawn(skinned, {}, true)), 2000U);
}

TEST(BreathingScene, AnOnionSkinLeavesOutWhatLobesShare) {
  const Vec3 a(0.0, 0.0, 0.0), b(10.0, 0.0, 0.0), c(0.0, 10.0, 0.0);
  const auto upper = std::make_shared<const TriangleMesh>(
      TriangleMesh{{a, b, c, {3.0, 3.0, 10.0}}, {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {2, 0, 3}}});
  const auto lower = std::make_shared<const TriangleMesh>(
      TriangleMesh{{a, b, c, {3.0, 3.0, -10.0}}, {{0, 1, 2}, {1, 0, 3}, {2, 1, 3}, {0, 2, 3}}});
  BreathingScene scene;
  scene.surfaces = {{Side::Right, std::vector<Vec3>(4, Vec3::Zero()), {}},
                    {Side::Right, std::vector<Vec3>(4, Vec3::Zero()), {}}};
  addOnionSkin(scene, {upper, lower}, {}, {});
  ASSERT_EQ(scene.shells.size(), 4U);
  for (const BreathingScene::Shell& shell : scene.shells) {
    EXPECT_EQ(shell.mesh->triangles.size(), 3U);
  }
}

TEST(BreathingScene, ABallMovesWithItsLung) {
  const auto picture = [](std::vector<SceneBall> balls, const BreathScale& scale) {
    Scene scene;
    scene.setOptions(plain());
    scene.setSurfaces(surfaces());
    scene.look({});
    scene.setBalls(std::move(balls));
    scene.setBreathing(std::make_shared<const BreathingScene>(breathing()));
    scene.setBreath(scale);
    return renderPicture(scene, BreathWidth, BreathHeight);
  };
  SceneBall ball{RightCentre, 20.0, true, false, Side::Right, Vec3(0.0, 0.0, -15.0)};
  const BreathScale full{1.0, 1.0};
  EXPECT_GT(channelsThatDiffer(picture({}, full), picture({ball}, full)), 500U);
  SceneBall moved = ball;
  moved.centre += moved.displacement;
  moved.displacement.setZero();
  EXPECT_EQ(channelsThatDiffer(picture({ball}, full), picture({moved}, full)), 0U);
  EXPECT_GT(channelsThatDiffer(picture({ball}, {}), picture({moved}, {})), 500U);
}

}  // namespace
}  // namespace pneuma
