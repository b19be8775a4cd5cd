#include "anatomy/homogeneity.h"

#include <array>
#include <cmath>
#include <numbers>
#include <string>

#include <gtest/gtest.h>

#include "core/error.h"
#include "core/parallel.h"
#include "support/progress_recorder.h"
#include "support/simple_domains.h"

namespace pneuma {
namespace {

constexpr double SpacingMm = 6.0;

/// The centres of n^3 cubic cells.
std::vector<Vec3> lattice(int n) {
  std::vector<Vec3> ends;
  for (int k = 0; k < n; ++k)
    for (int j = 0; j < n; ++j)
      for (int i = 0; i < n; ++i) ends.push_back(SpacingMm * Vec3(i + 0.5, j + 0.5, k + 0.5));
  return ends;
}

std::vector<LobeRegion> cube(int n) {
  return {{Lobe::Whole, testing::box(Vec3::Zero(), Vec3::Constant(n * SpacingMm))}};
}

TEST(Gap, OfACubicLatticeIsKnown) {
  const auto regions = cube(10);
  const auto points = randomPoints(regions, 100000, 1);
  const std::optional<Gap> result = gap(lattice(10), regions, points[0]);
  ASSERT_TRUE(result.has_value());
  EXPECT_NEAR(result->spacingMm, SpacingMm, 1e-9);
  EXPECT_NEAR(result->mean, 0.4803, 0.4803 * 0.005);  // mean distance to the centre of a unit cube
  EXPECT_NEAR(result->max, std::sqrt(3.0) / 2.0, std::sqrt(3.0) / 2.0 * 0.02);
  EXPECT_LE(result->max, std::sqrt(3.0) / 2.0);
  EXPECT_GT(result->p95, result->mean);
  EXPECT_LT(result->p95, result->max);
}

TEST(Gap, Has95PercentOfThePointsBelowP95) {
  // One end at the centre of a ball: the share of points within r is (r / R)^3.
  const double radius = 10.0;
  const std::vector<LobeRegion> regions = {{Lobe::Whole, testing::ball(radius)}};
  const auto points = randomPoints(regions, 200000, 3);
  const std::optional<Gap> result = gap(std::array{Vec3(0, 0, 0)}, regions, points[0]);
  ASSERT_TRUE(result.has_value());
  const double spacing = std::cbrt(4.0 / 3.0 * std::numbers::pi) * radius;
  EXPECT_NEAR(result->mean * spacing, 0.75 * radius, 0.005 * radius);
  EXPECT_NEAR(result->p95 * spacing, std::cbrt(0.95) * radius, 0.005 * radius);
}

TEST(Gap, MaximumIsThatOfTheSamples) {
  const auto regions = cube(4);
  const std::array<Vec3, 2> points = {SpacingMm * Vec3(0.5, 0.5, 0.5), SpacingMm * Vec3(0, 0, 0)};
  const std::optional<Gap> result = gap(lattice(4), regions, points);
  ASSERT_TRUE(result.has_value());
  EXPECT_NEAR(result->max, std::sqrt(3.0) / 2.0, 1e-12);
  EXPECT_NEAR(result->mean, std::sqrt(3.0) / 4.0, 1e-12);
}

TEST(Gap, EndsOutsideTheRegionDoNotNarrowTheSpacing) {
  const auto regions = cube(4);
  std::vector<Vec3> ends = lattice(4);
  for (int i = 0; i < 100; ++i) ends.emplace_back(-100.0 - i, 0.0, 0.0);
  const std::optional<Gap> result = gap(ends, regions, std::array{Vec3(1, 1, 1)});
  ASSERT_TRUE(result.has_value());
  EXPECT_NEAR(result->spacingMm, SpacingMm, 1e-9);
}

TEST(Gap, IsUnknownWithoutEndsInTheRegion) {
  const auto regions = cube(2);
  const std::array points = {Vec3(1, 1, 1)};
  EXPECT_FALSE(gap({}, regions, points).has_value());
  EXPECT_FALSE(gap(std::array{Vec3(-9, 0, 0)}, regions, points).has_value());
  EXPECT_FALSE(gap(lattice(2), regions, {}).has_value());
  EXPECT_FALSE(gap(lattice(2), {}, points).has_value());
}

TEST(RandomPoints, AreSharedOutByVolumeAndLieInside) {
  const std::vector<LobeRegion> regions = {
      {Lobe::RightUpper, testing::box(Vec3(0, 0, 0), Vec3(10, 10, 10))},
      {Lobe::RightLower, testing::ball(15.0, Vec3(50, 0, 0))},
      {Lobe::RightMiddle, testing::box(Vec3(0, 0, 20), Vec3(10, 10, 50))}};
  const auto points = randomPoints(regions, 10007, 1);
  ASSERT_EQ(points.size(), 3U);
  const double total = 1000.0 + 14137.1669 + 3000.0;
  EXPECT_NEAR(static_cast<double>(points[0].size()), 10007 * 1000.0 / total, 1.0);
  EXPECT_NEAR(static_cast<double>(points[2].size()), 10007 * 3000.0 / total, 1.0);
  EXPECT_EQ(points[0].size() + points[1].size() + points[2].size(), 10007U);
  for (std::size_t r = 0; r < 3; ++r) {
    for (const Vec3& p : points[r]) EXPECT_TRUE(regions[r].domain->contains(p));
  }
}

TEST(RandomPoints, FillTheRegionEvenly) {
  const auto points = randomPoints(cube(1), 80000, 5)[0];
  std::array<int, 8> octant{};
  for (const Vec3& p : points) {
    const auto high = [&](Eigen::Index axis) { return p[axis] > SpacingMm / 2.0 ? 1U : 0U; };
    ++octant[high(0) + 2 * high(1) + 4 * high(2)];
  }
  for (const int count : octant) EXPECT_NEAR(count, 10000, 5 * std::sqrt(10000.0 * 7 / 8));
}

TEST(RandomPoints, DependOnTheSeedOnly) {
  const std::vector<LobeRegion> regions = {{Lobe::Whole, testing::ball(10.0)}};
  const auto first = randomPoints(regions, 9000, 7);
  {
    const ThreadLimit oneThread(1);
    EXPECT_EQ(randomPoints(regions, 9000, 7), first);
  }
  EXPECT_NE(randomPoints(regions, 9000, 8), first);
}

class Hollow : public Domain {
 public:
  explicit Hollow(double volumeMm3) : volumeMm3_(volumeMm3) {}

  bool contains(const Vec3&) const override { return false; }

  double distanceToWall(const Vec3&) const override { return 0.0; }

  Box3 bounds() const override { return {Vec3::Zero(), Vec3::Ones()}; }

  double volumeMm3() const override { return volumeMm3_; }

 private:
  double volumeMm3_;
};

TEST(RandomPoints, RefuseRegionsThatHoldNothing) {
  for (const double volume : {0.0, std::nan(""), 1.0}) {
    const std::vector<LobeRegion> regions = {{Lobe::LeftLower, std::make_shared<Hollow>(volume)}};
    try {
      randomPoints(regions, 10, 1);
      FAIL() << volume;
    } catch (const InvalidInput& error) {
      EXPECT_NE(std::string(error.what()).find("LLL"), std::string::npos);
    }
  }
}

TEST(RandomPoints, RefuseNumbersThatCannotBe) {
  EXPECT_THROW(randomPoints(cube(1), 0, 1), InvalidOption);
  EXPECT_THROW(randomPoints(cube(1), 20'000'000, 1), InvalidOption);
}

TEST(RandomPoints, StopOnRequest) {
  testing::ProgressRecorder stop(0.0);
  EXPECT_THROW(randomPoints(cube(2), 100000, 1, Progress(stop)), Cancelled);
}

}  // namespace
}  // namespace pneuma
