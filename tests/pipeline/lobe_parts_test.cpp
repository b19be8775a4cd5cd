#include "pipeline/lobe_parts.h"

#include <gtest/gtest.h>

namespace pneuma {
namespace {

/// Two triangles that share an edge.
TriangleMesh two() {
  return {{Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(0, 1, 0), Vec3(1, 1, 0)}, {{0, 1, 2}, {3, 2, 1}}};
}

TEST(LobeParts, HaveTheirOwnPointsAndTrianglesOnly) {
  const auto parts = lobeParts(two(), std::vector<std::uint8_t>{5, 1});
  ASSERT_EQ(parts.size(), 2U);
  EXPECT_EQ(parts.begin()->first, Lobe::RightUpper);
  const TriangleMesh& upper = parts.at(Lobe::RightUpper);
  ASSERT_EQ(upper.points.size(), 3U);
  ASSERT_EQ(upper.triangles.size(), 1U);
  EXPECT_EQ(upper.points[upper.triangles[0][0]], Vec3(1, 1, 0));
  EXPECT_EQ(upper.points[upper.triangles[0][1]], Vec3(0, 1, 0));
  EXPECT_EQ(upper.points[upper.triangles[0][2]], Vec3(1, 0, 0));
  EXPECT_EQ(parts.at(Lobe::LeftLower).points.size(), 3U);
}

TEST(LobeParts, AreNoneWhereAValueIsNoLobe) {
  EXPECT_TRUE(lobeParts(two(), {}).empty());
  EXPECT_TRUE(lobeParts(two(), std::vector<std::uint8_t>{5, 7}).empty());
  EXPECT_TRUE(lobeParts(two(), std::vector<std::uint8_t>{5, 6}).empty());
}

}  // namespace
}  // namespace pneuma
