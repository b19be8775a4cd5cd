#include "core/moving_points.h"

#include <cmath>
#include <vector>

#include <gtest/gtest.h>

namespace pneuma {
namespace {

constexpr std::size_t Count = 3 * 50'001;  // several blocks, the last one short

TEST(MovingPoints, MoveAlongTheirSlopes) {
  std::vector<double> rest(Count);
  std::vector<double> slope(Count);
  for (std::size_t n = 0; n < Count; ++n) {
    rest[n] = 0.5 * static_cast<double>(n);
    slope[n] = 7.0 - static_cast<double>(n % 11);
  }
  std::vector<double> moved(Count);
  moveAlong(rest, slope, 0.25, moved);
  for (std::size_t n = 0; n < Count; ++n) ASSERT_EQ(moved[n], rest[n] + 0.25 * slope[n]) << n;
  const std::vector<float> restF(rest.begin(), rest.end());
  const std::vector<float> slopeF(slope.begin(), slope.end());
  std::vector<float> movedF(Count);
  moveAlong(restF, slopeF, 0.25F, movedF);
  for (std::size_t n = 0; n < Count; ++n) ASSERT_EQ(movedF[n], restF[n] + 0.25F * slopeF[n]) << n;
}

TEST(MovingPoints, TurnNormalsAndKeepTheirLength) {
  std::vector<float> normals(Count, 0.0F);
  std::vector<float> slope(Count, 0.0F);
  for (std::size_t n = 0; n < Count; n += 3) {
    normals[n] = n == 6 ? 0.0F : 1.0F;  // one has no direction
    slope[n + 1] = n == 6 ? 0.0F : static_cast<float>(n % 5);
  }
  std::vector<float> turned(Count);
  turnAlong(normals, slope, 0.5F, turned);
  for (std::size_t n = 0; n < Count; n += 3) {
    if (n == 6) {
      EXPECT_EQ(turned[n], 0.0F);
      continue;
    }
    const double tilt = 0.5 * static_cast<double>(n % 5);
    ASSERT_NEAR(turned[n], 1.0 / std::hypot(1.0, tilt), 1e-6) << n;
    ASSERT_NEAR(turned[n + 1], tilt / std::hypot(1.0, tilt), 1e-6) << n;
    ASSERT_EQ(turned[n + 2], 0.0F) << n;
  }
}

}  // namespace
}  // namespace pneuma
