#include "anatomy/organ_shapes.h"

#include <limits>
#include <memory>
#include <numbers>
#include <ostream>
#include <string>

#include <gtest/gtest.h>

#include "anatomy/thorax.h"
#include "core/units.h"
#include "support/domain_checks.h"

namespace pneuma {
namespace {

using ::testing::TestParamInfo;
using ::testing::Values;

struct ShapeCase {
  std::string name;
  std::shared_ptr<const Domain> domain;
  double leastShare;  ///< of the distance to the wall that distanceToWall() gives on average
};

void PrintTo(const ShapeCase& shape, std::ostream* out) { *out << shape.name; }

class OrganShape : public ::testing::TestWithParam<ShapeCase> {};

TEST_P(OrganShape, RowsAgreeWithPoints) { testing::expectRowsAgree(*GetParam().domain); }

TEST_P(OrganShape, WaysEndAtTheWall) { testing::expectExitsAgree(*GetParam().domain); }

TEST_P(OrganShape, HoldsTheBoxesItSaysItHolds) { testing::expectBoxesAgree(*GetParam().domain); }

TEST_P(OrganShape, WallIsNoNearerThanSaid) {
  testing::expectWallIsNoNearer(*GetParam().domain, GetParam().leastShare);
}

TEST_P(OrganShape, LatticeHoldsItsVolume) {
  const Domain& domain = *GetParam().domain;
  const double volume = domain.volumeMm3();
  EXPECT_NEAR(testing::latticeVolumeMm3(domain, std::cbrt(volume / 1e6)), volume, 0.003 * volume);
}

TEST_P(OrganShape, HangsBelowItsTop) {
  const Box3 box = GetParam().domain->bounds();
  EXPECT_DOUBLE_EQ(box.max().z(), 0.0);
  EXPECT_NEAR(box.center().x(), 0.0, 1e-9);
  EXPECT_NEAR(box.center().y(), 0.0, 1e-9);
}

TEST_P(OrganShape, HasNoPointsInRowsBesideIt) {
  const Domain& domain = *GetParam().domain;
  const Box3 box = domain.bounds();
  for (const Vec3& first : {Vec3(box.min().x(), box.max().y() + 1.0, box.center().z()),
                            Vec3(box.min().x(), 0.0, box.max().z() + 1.0),
                            Vec3(box.min().x(), 0.0, box.min().z() - 1.0),
                            Vec3(box.max().x() + 1.0, 0.0, box.center().z()),
                            Vec3(box.min().x() - 40.0, 0.0, box.center().z())}) {
    EXPECT_EQ(domain.insideAlongX(first, 1.0, ~std::uint32_t{0}), 0U) << first.transpose();
  }
}

INSTANTIATE_TEST_SUITE_P(Shapes, OrganShape,
                         Values(ShapeCase{"Simple", std::make_shared<SimpleOrgan>(), 0.75},
                                ShapeCase{"SmallSimple", std::make_shared<SimpleOrgan>(0.4), 0.75},
                                ShapeCase{"Sphere", std::make_shared<SphereOrgan>(120.0), 0.9},
                                ShapeCase{"Cylinder", std::make_shared<CylinderOrgan>(100.0, 300.0),
                                          0.9},
                                ShapeCase{"Cube", std::make_shared<CubeOrgan>(200.0), 0.9},
                                ShapeCase{"Thorax", std::make_shared<Thorax>(), 0.7},
                                ShapeCase{"LargeThorax", std::make_shared<Thorax>(1.3), 0.7}),
                         [](const TestParamInfo<ShapeCase>& each) { return each.param.name; });

TEST(SimpleOrgan, WidensWithTheFourthRootOfTheDepth) {
  const SimpleOrgan organ;
  // depth = 2 * 15^-3 * (x^2 + (1.5 y)^2)^2 in cm: 30 cm deep at x = 15 and at y = 10, 30 / 16 half
  // as far from the axis.
  for (const Vec3& wall : {Vec3(150.0, 0.0, -300.0), Vec3(0.0, 100.0, -300.0),
                           Vec3(75.0, 0.0, -300.0 / 16.0), Vec3(0.0, -50.0, -300.0 / 16.0)}) {
    EXPECT_TRUE(organ.contains(wall - 1e-6 * Vec3(wall.x(), wall.y(), 0.0)));
    EXPECT_FALSE(organ.contains(wall + 1e-6 * Vec3(wall.x(), wall.y(), 0.0)));
  }
  EXPECT_FALSE(organ.contains({0.0, 0.0, 0.001}));
  EXPECT_FALSE(organ.contains({0.0, 0.0, -300.001}));
  EXPECT_NEAR(organ.volumeMm3(), cubicMillimetres(3000.0 * std::numbers::pi), 1e-3);
}

TEST(SimpleOrgan, GivesWaysThatAreKnown) {
  const SimpleOrgan organ;
  const Vec3 apex = Vec3::Zero();
  EXPECT_NEAR(organ.exitDistance(apex, -Vec3::UnitZ(), 1000.0), 300.0, 1e-6);
  EXPECT_NEAR(organ.exitDistance(apex, -Vec3::UnitZ(), 75.0), 75.0, 1e-12);
  EXPECT_NEAR(organ.exitDistance(apex, Vec3::UnitZ(), 1000.0), 0.0, 1e-9);
  EXPECT_NEAR(organ.exitDistance({0.0, 0.0, -299.0}, Vec3::UnitX(), 1000.0),
              150.0 * std::pow(299.0 / 300.0, 0.25), 1e-6);
  EXPECT_NEAR(organ.exitDistance({0.0, 50.0, -200.0}, Vec3::UnitZ(), 1000.0), 200.0 - 300.0 / 16.0,
              1e-6);
}

TEST(SphereOrgan, KnowsItsDistances) {
  const SphereOrgan organ(50.0);
  EXPECT_NEAR(organ.distanceToWall({0.0, 0.0, -50.0}), 50.0, 1e-12);
  EXPECT_NEAR(organ.distanceToWall({80.0, 0.0, -50.0}), 30.0, 1e-12);
  EXPECT_NEAR(organ.exitDistance({30.0, 0.0, -50.0}, Vec3::UnitZ(), 100.0), 40.0, 1e-12);
}

TEST(CylinderOrgan, KnowsItsDistances) {
  const CylinderOrgan organ(50.0, 200.0);
  EXPECT_NEAR(organ.distanceToWall({0.0, 0.0, -100.0}), 50.0, 1e-12);
  EXPECT_NEAR(organ.distanceToWall({0.0, 40.0, -195.0}), 5.0, 1e-12);
  EXPECT_NEAR(organ.distanceToWall({53.0, 0.0, 4.0}), 5.0, 1e-12);
  EXPECT_NEAR(organ.exitDistance({30.0, 0.0, -50.0}, Vec3::UnitY(), 100.0), 40.0, 1e-12);
  EXPECT_NEAR(organ.exitDistance({30.0, 0.0, -50.0}, Vec3::UnitZ(), 100.0), 50.0, 1e-12);
}

TEST(CubeOrgan, KnowsItsDistances) {
  const CubeOrgan organ(100.0);
  EXPECT_NEAR(organ.distanceToWall({0.0, 0.0, -50.0}), 50.0, 1e-12);
  EXPECT_NEAR(organ.distanceToWall({0.0, 54.0, 3.0}), 5.0, 1e-12);
  EXPECT_NEAR(organ.exitDistance({20.0, 0.0, -50.0}, Vec3::UnitX(), 100.0), 30.0, 1e-12);
}

}  // namespace
}  // namespace pneuma
