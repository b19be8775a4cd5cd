#include "anatomy/summary.h"

#include <array>
#include <cmath>

#include <gtest/gtest.h>

namespace pneuma {
namespace {

TEST(Summary, OfKnownValues) {
  const std::array<double, 4> values = {2.0, 4.0, 4.0, 6.0};
  const Summary result = summary(values);
  EXPECT_EQ(result.count, 4U);
  EXPECT_DOUBLE_EQ(result.mean, 4.0);
  EXPECT_DOUBLE_EQ(result.sd, std::sqrt(8.0 / 3.0));
  EXPECT_DOUBLE_EQ(result.min, 2.0);
  EXPECT_DOUBLE_EQ(result.max, 6.0);
}

TEST(Summary, OneValueHasNoSpread) {
  const std::array<double, 1> value = {-3.0};
  const Summary result = summary(value);
  EXPECT_DOUBLE_EQ(result.mean, -3.0);
  EXPECT_DOUBLE_EQ(result.sd, 0.0);
  EXPECT_DOUBLE_EQ(result.max, -3.0);
}

TEST(Summary, OfNothingCountsNothing) { EXPECT_EQ(summary({}).count, 0U); }

}  // namespace
}  // namespace pneuma
