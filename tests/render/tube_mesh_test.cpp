#include "render/tube_mesh.h"

#include <cmath>

#include <gtest/gtest.h>

#include "render/generated_lungs.h"

namespace pneuma {
namespace {

Branch straight(int parent, const Vec3& from, const Vec3& to, double radius) {
  Branch branch;
  branch.parent = parent;
  branch.proximal = from;
  branch.distal = to;
  branch.radiusMm = radius;
  return branch;
}

TubeMesh meshOf(const AirwayTree& tree, const TubeOptions& options = {}) {
  return tubeMesh(tree, std::vector<bool>(tree.size(), true), std::vector<Rgb>(tree.size()),
                  options);
}

Vec3 point(const std::vector<float>& values, std::size_t i) {
  return {values[3 * i], values[3 * i + 1], values[3 * i + 2]};
}

TEST(TubeMesh, ThinTubeIsAPrismTrueToItsRadius) {
  AirwayTree tree;
  tree.add(straight(-1, {1, 2, 3}, {1, 2, 8}, 0.4));
  const TubeMesh mesh = meshOf(tree);
  ASSERT_EQ(mesh.points.size(), 2U * 6 * 3);
  EXPECT_EQ(mesh.triangles.size() / 3, 12U + 4 + 4);
  for (std::size_t i = 0; i < 12; ++i) {
    const Vec3 p = point(mesh.points, i) - Vec3(1, 2, 3);
    EXPECT_NEAR(std::hypot(p.x(), p.y()), 0.4, 1e-5);
    EXPECT_TRUE(p.z() > -1e-5 && p.z() < 5.0 + 1e-5);
    const Vec3 normal = point(mesh.normals, i);
    EXPECT_NEAR(normal.norm(), 1.0, 1e-5);
    EXPECT_NEAR(normal.dot(Vec3(p.x(), p.y(), 0.0)), 0.4, 1e-4);
  }
}

TEST(TubeMesh, TrianglesFaceOutwards) {
  // Each tube is closed at a terminal's end and open at the root of a daughter; of the root branch
  // alone everything is closed, so that the volume tells the orientation.
  AirwayTree tree;
  Branch branch = straight(-1, {0, 0, 0}, {0, 0, 40}, 5.0);
  branch.via = {{{3, 0, 15}, 5.0}, {{3, 0, 28}, 5.0}};
  tree.add(branch);
  const TubeMesh mesh = meshOf(tree);
  double sixfold = 0.0;
  for (std::size_t t = 0; t < mesh.triangles.size(); t += 3) {
    const auto corner = [&](std::size_t k) {
      return point(mesh.points, static_cast<std::size_t>(mesh.triangles[t + k]));
    };
    sixfold += corner(0).dot(corner(1).cross(corner(2)));
  }
  const double cylinder = 3.14159 * 25.0 * 40.0;
  EXPECT_NEAR(sixfold / 6.0, cylinder, 0.10 * cylinder);
}

TEST(TubeMesh, MeasuredBranchKeepsTheRadiiOfItsCentreline) {
  AirwayTree tree;
  Branch branch = straight(-1, {0, 0, 0}, {0, 0, 30}, 0.5);
  branch.via = {{{0, 0, 10}, 0.8}, {{0, 0, 20}, 0.6}};
  tree.add(branch);
  const TubeMesh mesh = meshOf(tree, {.radiusScale = 0.5});
  bool found = false;
  for (std::size_t i = 0; i < mesh.points.size() / 3; ++i) {
    const Vec3 p = point(mesh.points, i);
    if (std::abs(p.z() - 10.0) > 1e-4) continue;
    found = true;
    EXPECT_NEAR(std::hypot(p.x(), p.y()), 0.4, 1e-5);
  }
  EXPECT_TRUE(found);
}

TEST(TubeMesh, DaughterBeginsInsideTheProlongedMother) {
  AirwayTree tree;
  tree.add(straight(-1, {0, 0, 0}, {0, 0, 10}, 0.8));
  const Vec3 way = Vec3(std::sin(0.6), 0.0, std::cos(0.6));
  tree.add(straight(0, {0, 0, 10}, Vec3(0, 0, 10) + 8.0 * way, 0.8));
  const TubeMesh mesh = meshOf(tree);
  double motherTop = 0.0;
  for (std::size_t i = 0; i < 12; ++i) motherTop = std::max(motherTop, point(mesh.points, i).z());
  EXPECT_NEAR(motherTop, 10.0 + 0.8 * std::tan(0.3), 1e-4);
  // Equal radii: the daughter's outermost corner ends on the mother's surface; corners beside the
  // plane of the bend stand out by 2 % of the radius.
  for (std::size_t i = 12; i < 18; ++i) {
    const Vec3 p = point(mesh.points, i);
    EXPECT_LT(std::hypot(std::min(p.x(), 0.0), p.y()), 1.025 * 0.8);
  }
}

TEST(TubeMesh, HiddenBranchesAreLeftOut) {
  const auto tree = test::generatedTree(3);
  std::vector<bool> visible(tree->size(), false);
  visible[0] = true;
  const std::vector<Rgb> colours(tree->size());
  EXPECT_LT(tubeMesh(*tree, visible, colours, {}).points.size(),
            tubeMesh(*tree, std::vector<bool>(tree->size(), true), colours, {}).points.size());
  visible[0] = false;
  EXPECT_TRUE(tubeMesh(*tree, visible, colours, {}).points.empty());
}

TEST(TubeMesh, TakesFewerSidesAndFlatEndsWhereTheyAreAskedFor) {
  AirwayTree tree;
  tree.add(straight(-1, {0, 0, 0}, {0, 0, 30}, 8.0));
  EXPECT_EQ(meshOf(tree, {.sides = 5}).points.size(), 3U * 5U * 3U);  // two rings and its mouth
  EXPECT_GT(meshOf(tree).points.size(), 3U * 20U * 3U);
}

TEST(TubeMesh, BranchWithoutLengthHasFinitePoints) {
  AirwayTree tree;
  tree.add(straight(-1, {0, 0, 0}, {0, 0, 10}, 1.0));
  tree.add(straight(0, {0, 0, 10}, {0, 0, 10}, 1.0));
  for (const float value : meshOf(tree).points) EXPECT_TRUE(std::isfinite(value));
  for (const float value : meshOf(tree).normals) EXPECT_TRUE(std::isfinite(value));
}

TEST(LineMesh, FollowsTheCentreline) {
  AirwayTree tree;
  Branch branch = straight(-1, {0, 0, 0}, {0, 0, 30}, 0.5);
  branch.via = {{{0, 2, 10}, 0.5}, {{0, 2, 20}, 0.5}};
  tree.add(branch);
  const LineMesh mesh = lineMesh(tree, {true}, {Rgb{1, 0, 0}});
  EXPECT_EQ(mesh.segments.size(), 6U);
  EXPECT_EQ(mesh.colours[0], 255);
  EXPECT_TRUE(lineMesh(tree, {false}, {Rgb{}}).segments.empty());
}

}  // namespace
}  // namespace pneuma
