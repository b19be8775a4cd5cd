#include "growth/quantised_points.h"

#include <vector>

#include <gtest/gtest.h>

#include "core/random.h"

namespace pneuma {
namespace {

std::vector<QuantisedPoint> randomPoints(std::size_t count, std::uint64_t seed) {
  Random random(seed);
  std::vector<QuantisedPoint> points(count);
  for (QuantisedPoint& p : points) {
    p.x = static_cast<std::int16_t>(random.uniform(-32760, 32760));
    p.y = static_cast<std::int16_t>(random.uniform(-32760, 32760));
    p.z = static_cast<std::int16_t>(random.uniform(-32760, 32760));
  }
  return points;
}

bool same(const QuantisedPoint& a, const QuantisedPoint& b) {
  return a.x == b.x && a.y == b.y && a.z == b.z;
}

TEST(QuantisedPoints, SumsAreExactForAnyCount) {
  for (const std::size_t count : {0U, 1U, 2U, 3U, 17U, 200001U}) {
    const auto points = randomPoints(count, 3);
    std::int64_t x = 0;
    std::int64_t y = 0;
    std::int64_t z = 0;
    for (const QuantisedPoint& p : points) {
      x += p.x;
      y += p.y;
      z += p.z;
    }
    const QuantisedSum sum = sumOf(points.data(), count);
    EXPECT_EQ(sum.x, x);
    EXPECT_EQ(sum.y, y);
    EXPECT_EQ(sum.z, z);
  }
}

TEST(QuantisedPoints, SumsOfEqualLargestPointsDoNotOverflow) {
  const std::vector<QuantisedPoint> points(300000, {32767, -32767, 32767, 0});
  const QuantisedSum sum = sumOf(points.data(), points.size());
  EXPECT_EQ(sum.x, 300000LL * 32767);
  EXPECT_EQ(sum.y, -300000LL * 32767);
}

TEST(QuantisedPoints, PartitionFollowsThePlaneAndKeepsTheOrder) {
  Random random(7);
  for (int trial = 0; trial < 50; ++trial) {
    const auto count = static_cast<std::size_t>(random.below(400));
    auto points = randomPoints(count, 100 + static_cast<std::uint64_t>(trial));
    const Vec3 normal =
        Vec3(random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-1, 1)).normalized();
    const Vec3 through(random.uniform(-9000, 9000), 0.0, random.uniform(-9000, 9000));
    const QuantisedPlane plane(normal, through);
    std::vector<QuantisedPoint> front;
    std::vector<QuantisedPoint> back;
    for (const QuantisedPoint& p : points) {
      const std::int64_t dot =
          std::int64_t{p.x} * plane.x + std::int64_t{p.y} * plane.y + std::int64_t{p.z} * plane.z;
      (dot < plane.limit ? front : back).push_back(p);
    }
    std::vector<QuantisedPoint> scratch(count);
    const std::size_t inFront = partition(points.data(), count, plane, scratch.data());
    ASSERT_EQ(inFront, front.size());
    for (std::size_t i = 0; i < count; ++i) {
      const QuantisedPoint& expected = i < inFront ? front[i] : back[i - inFront];
      ASSERT_TRUE(same(points[i], expected)) << i;
    }
  }
}

TEST(QuantisedPoints, ThePlaneIsTheOneAskedFor) {
  // Points 100 quanta in front of and behind the plane, far from its foot: the normal's rounding
  // (3e-5 rad) must not reach them.
  Random random(11);
  for (int trial = 0; trial < 1000; ++trial) {
    const Vec3 normal =
        Vec3(random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-1, 1)).normalized();
    const Vec3 inPlane = normal.unitOrthogonal() * random.uniform(-15000.0, 15000.0);
    const Vec3 q = inPlane + 100.0 * normal;
    std::vector<QuantisedPoint> points = {{static_cast<std::int16_t>(q.x()),
                                           static_cast<std::int16_t>(q.y()),
                                           static_cast<std::int16_t>(q.z()), 0}};
    std::vector<QuantisedPoint> scratch(1);
    const QuantisedPlane plane(normal, Vec3::Zero());
    EXPECT_EQ(partition(points.data(), 1, plane, scratch.data()), 0U);
    const QuantisedPlane opposite(-normal, Vec3::Zero());
    EXPECT_EQ(partition(points.data(), 1, opposite, scratch.data()), 1U);
  }
}

}  // namespace
}  // namespace pneuma
