#include "core/point_index.h"

#include <algorithm>
#include <utility>

#include <gtest/gtest.h>

#include "core/random.h"

namespace pneuma {
namespace {

std::vector<Vec3> randomPoints(std::size_t n, std::uint64_t seed) {
  Random random(seed);
  std::vector<Vec3> points(n);
  for (Vec3& p : points) {
    for (Eigen::Index axis = 0; axis < 3; ++axis) p[axis] = random.uniform(-50.0, 50.0);
  }
  return points;
}

/// Distances from `p` to all points with their indices, nearest first.
std::vector<std::pair<double, std::size_t>> byDistance(const std::vector<Vec3>& points,
                                                       const Vec3& p) {
  std::vector<std::pair<double, std::size_t>> result;
  for (std::size_t i = 0; i < points.size(); ++i) result.emplace_back((points[i] - p).norm(), i);
  std::ranges::sort(result);
  return result;
}

TEST(PointIndex, FindsTheNearestPoint) {
  const std::vector<Vec3> points = randomPoints(1000, 1);
  const PointIndex index(points);
  for (const Vec3& p : randomPoints(200, 2)) {
    const PointIndex::Neighbour found = index.nearest(p);
    const auto expected = byDistance(points, p).front();
    EXPECT_EQ(found.index, expected.second);
    EXPECT_NEAR(found.distance, expected.first, 1e-12);
  }
}

TEST(PointIndex, ListsNeighboursNearestFirst) {
  const std::vector<Vec3> points = randomPoints(500, 3);
  const PointIndex index(points);
  for (const Vec3& p : randomPoints(50, 4)) {
    const auto found = index.nearest(p, 7);
    const auto expected = byDistance(points, p);
    ASSERT_EQ(found.size(), 7U);
    for (std::size_t i = 0; i < 7; ++i) EXPECT_EQ(found[i].index, expected[i].second);
  }
}

TEST(PointIndex, ListsEverythingWithinARadius) {
  const std::vector<Vec3> points = randomPoints(500, 5);
  const PointIndex index(points);
  for (const Vec3& p : randomPoints(50, 6)) {
    const auto found = index.within(p, 20.0);
    const auto expected = byDistance(points, p);
    const auto inside = static_cast<std::size_t>(
        std::ranges::count_if(expected, [](const auto& item) { return item.first < 20.0; }));
    ASSERT_EQ(found.size(), inside);
    for (std::size_t i = 0; i < inside; ++i) {
      EXPECT_EQ(found[i].index, expected[i].second);
      EXPECT_NEAR(found[i].distance, expected[i].first, 1e-12);
    }
  }
}

TEST(PointIndex, GivesNoMoreThanThereIs) {
  const PointIndex index({Vec3(1, 2, 3), Vec3(4, 5, 6)});
  EXPECT_EQ(index.nearest(Vec3::Zero(), 5).size(), 2U);
  EXPECT_TRUE(index.within(Vec3::Zero(), 1.0).empty());
  EXPECT_EQ(index.points().size(), 2U);
}

TEST(PointIndex, CanBeMoved) {
  PointIndex first({Vec3(1, 2, 3)});
  const PointIndex second = std::move(first);
  EXPECT_EQ(second.nearest(Vec3(1, 2, 4)).distance, 1.0);
}

}  // namespace
}  // namespace pneuma
