#include "segmentation/airway_centreline.h"

#include <algorithm>

#include <gtest/gtest.h>

#include "anatomy/centreline.h"

namespace pneuma {
namespace {

struct Tube {
  Vec3 from;
  Vec3 to;
  double radiusMm = 0.0;
};

double distanceToSegment(const Vec3& p, const Vec3& a, const Vec3& b) {
  const Vec3 along = b - a;
  const double t = std::clamp((p - a).dot(along) / along.squaredNorm(), 0.0, 1.0);
  return (p - a - t * along).norm();
}

/// The voxels within tubes, and the one nearest to where the first tube begins as root.
AirwayMask maskOf(const ImageGeometry& geometry, const std::vector<Tube>& tubes) {
  AirwayMask mask;
  double nearest = 1e30;
  for (std::size_t v = 0; v < geometry.voxelCount(); ++v) {
    const auto n = static_cast<int>(v);
    const Vec3 voxel(n % geometry.size[0], n / geometry.size[0] % geometry.size[1],
                     n / geometry.size[0] / geometry.size[1]);
    const Vec3 p = geometry.worldFromVoxel(voxel);
    const bool inside = std::any_of(tubes.begin(), tubes.end(), [&](const Tube& tube) {
      return distanceToSegment(p, tube.from, tube.to) < tube.radiusMm;
    });
    if (!inside) continue;
    mask.voxels.push_back(static_cast<std::uint32_t>(v));
    const double away = (p - tubes.front().from).norm();
    if (away < nearest) {
      nearest = away;
      mask.root = static_cast<std::uint32_t>(v);
    }
  }
  return mask;
}

ImageGeometry gridOf(const Vec3& spacing) {
  ImageGeometry geometry;
  geometry.spacing = spacing;
  geometry.origin = {-60.0, -30.0, -100.0};
  for (int axis = 0; axis < 3; ++axis) {
    const double extent = std::array{120.0, 60.0, 110.0}[static_cast<std::size_t>(axis)];
    geometry.size[static_cast<std::size_t>(axis)] =
        static_cast<int>(std::lround(extent / spacing[axis]));
  }
  return geometry;
}

/// A windpipe of 8 mm and two bronchi of 5 and 3 mm radius.
const std::vector<Tube> Fork = {{{0.0, 0.0, 0.0}, {0.0, 0.0, -40.0}, 8.0},
                                {{0.0, 0.0, -40.0}, {40.0, 0.0, -75.0}, 5.0},
                                {{0.0, 0.0, -40.0}, {-45.0, 10.0, -80.0}, 3.0}};

/// Distance to the nearest axis of the fork.
double offAxis(const Vec3& p) {
  double nearest = 1e30;
  for (const Tube& tube : Fork)
    nearest = std::min(nearest, distanceToSegment(p, tube.from, tube.to));
  return nearest;
}

TEST(AirwayCentreline, OfAForkHasItsThreeBranches) {
  for (const Vec3& spacing : {Vec3(0.8, 0.8, 1.0), Vec3(0.7, 0.7, 2.5)}) {
    const ImageGeometry geometry = gridOf(spacing);
    const AirwayTree tree = airwayCentreline(geometry, maskOf(geometry, Fork));
    ASSERT_EQ(tree.size(), 3U);
    EXPECT_EQ(tree[0].parent, -1);
    EXPECT_EQ(tree[1].parent, 0);
    EXPECT_EQ(tree[2].parent, 0);
    EXPECT_LT((tree[0].distal - Vec3(0.0, 0.0, -40.0)).norm(), 8.0);
    const std::size_t left = tree[1].distal.x() > 0.0 ? 1 : 2;
    EXPECT_NEAR(tree[left].radiusMm, 5.0, 0.5);
    EXPECT_NEAR(tree[3 - left].radiusMm, 3.0, 0.4);
    EXPECT_NEAR(tree[0].radiusMm, 8.0, 0.6);
    // Ends lie on the tubes' rounded ends.
    EXPECT_LT((tree[left].distal - Vec3(40.0, 0.0, -75.0)).norm(), 6.5);
    EXPECT_LT((tree[3 - left].distal - Vec3(-45.0, 10.0, -80.0)).norm(), 5.0);
    for (const Branch& branch : tree) {
      EXPECT_EQ(branch.origin, Origin::Measured);
      for (const CentrelinePoint& point : branch.via) {
        // The line runs in the middle, but for the fork, which is wide, and the blunt ends.
        const auto near = [&](const Vec3& p, double mm) {
          return (point.position - p).norm() < mm;
        };
        if (near(Fork[0].from, 10.0) || near(Fork[0].to, 16.0) || near(Fork[1].to, 10.0) ||
            near(Fork[2].to, 6.0)) {
          continue;
        }
        EXPECT_LT(offAxis(point.position), 1.2);
      }
    }
  }
}

TEST(AirwayCentreline, FollowsTheAxesOfTheImage) {
  ImageGeometry geometry = gridOf({0.8, 0.8, 1.0});
  const AirwayMask mask = maskOf(geometry, Fork);
  const Branch straight = airwayCentreline(geometry, mask)[0];
  geometry.direction = Eigen::AngleAxisd(0.3, Vec3::UnitX()).matrix();
  const Branch leaning = airwayCentreline(geometry, mask)[0];
  const Vec3 expected = geometry.direction * (straight.distal - straight.proximal);
  EXPECT_NEAR((leaning.distal - leaning.proximal - expected).norm(), 0.0, 1e-9);
}

TEST(AirwayCentreline, GrowsNoSpursOutOfAWideAirway) {
  std::vector<Tube> tubes = {{{0.0, 0.0, 0.0}, {0.0, 0.0, -80.0}, 10.0}};
  // Bumps of the wall, as noise leaves them.
  for (int n = 1; n < 8; ++n) {
    const double side = n % 2 == 0 ? 1.0 : -1.0;
    tubes.push_back({{9.0 * side, 0.0, -10.0 * n}, {13.0 * side, 0.0, -10.0 * n}, 2.0});
  }
  const ImageGeometry geometry = gridOf({0.8, 0.8, 1.25});
  EXPECT_EQ(airwayCentreline(geometry, maskOf(geometry, tubes)).size(), 1U);
}

TEST(AirwayCentreline, HasOneRootWhereABranchLeavesAtTheTop) {
  const ImageGeometry geometry = gridOf({0.8, 0.8, 1.25});
  const std::vector<Tube> tubes = {{{0.0, 0.0, 0.0}, {0.0, 0.0, -80.0}, 8.0},
                                   {{0.0, 0.0, 0.0}, {40.0, 0.0, 2.0}, 3.0}};
  const AirwayTree tree = airwayCentreline(geometry, maskOf(geometry, tubes));
  ASSERT_EQ(tree.size(), 3U);
  EXPECT_EQ(std::count_if(tree.begin(), tree.end(), [](const Branch& b) { return b.parent < 0; }),
            1);
}

TEST(AirwayCentreline, OfNothingIsEmpty) {
  EXPECT_TRUE(airwayCentreline(gridOf(Vec3::Ones()), AirwayMask{}).empty());
}

}  // namespace
}  // namespace pneuma
