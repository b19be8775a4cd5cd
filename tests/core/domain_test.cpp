#include "core/domain.h"

#include <gtest/gtest.h>

#include "support/simple_domains.h"

namespace pneuma {
namespace {

TEST(Domain, ContainsASegmentWhoseEveryPointIsInside) {
  const auto ball = testing::ball(10.0);
  EXPECT_TRUE(ball->containsSegment(Vec3(-9, 0, 0), Vec3(9, 0, 0)));
  EXPECT_FALSE(ball->containsSegment(Vec3(0, 0, 0), Vec3(11, 0, 0)));
  EXPECT_FALSE(ball->containsSegment(Vec3(11, 0, 0), Vec3(0, 0, 0)));
  EXPECT_TRUE(ball->containsSegment(Vec3(1, 2, 3), Vec3(1, 2, 3)));
}

/// Everything but a slab of 1 mm.
class Slit : public testing::BoxDomain {
 public:
  Slit() : BoxDomain(Box3(Vec3::Constant(-50), Vec3::Constant(50))) {}

  bool contains(const Vec3& p) const override {
    return BoxDomain::contains(p) && (p.x() < 7.0 || p.x() > 8.0);
  }
};

TEST(Domain, NoticesThatASegmentLeavesAndComesBack) {
  const Slit slit;
  EXPECT_FALSE(slit.containsSegment(Vec3(-40, 0, 0), Vec3(40, 3, 0)));
  EXPECT_TRUE(slit.containsSegment(Vec3(-40, 0, 0), Vec3(6.9, 3, 0)));
}

}  // namespace
}  // namespace pneuma
