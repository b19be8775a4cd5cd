#include "pipeline/stiffness_region.h"

#include <cmath>

#include <gtest/gtest.h>

#include "core/error.h"
#include "geometry/test_surfaces.h"

namespace pneuma {
namespace {

/// Two balls of 30 mm radius on top of each other as lobes of the left lung.
LungModel modelOfTwoLobes() {
  const auto lobe = [](Lobe name, double z) {
    auto mesh = std::make_shared<TriangleMesh>(testing::sphere(30.0, {60.0, 0.0, z}, 4));
    return LobeSurface{name, std::string(shortName(name)), mesh, {}};
  };
  LungModel model;
  model.surfaces = std::make_shared<const std::vector<LobeSurface>>(
      std::vector{lobe(Lobe::LeftUpper, 30.0), lobe(Lobe::LeftLower, -30.0)});
  return model;
}

TEST(StiffnessRegion, IsReadFromText) {
  EXPECT_EQ(stiffnessRegion("LLL=0.5"), (StiffnessRegion{Lobe::LeftLower, Vec3::Zero(), 0.0, 0.5}));
  EXPECT_EQ(stiffnessRegion("rul=2").lobe, Lobe::RightUpper);
  EXPECT_EQ(stiffnessRegion("60,-20.5,-150,15=5"),
            (StiffnessRegion{Lobe::Whole, {60.0, -20.5, -150.0}, 15.0, 5.0}));
  for (const char* text : {"", "LLL", "LLL=", "LLL=x", "LLL=0", "LLL=-1", "LLL=101", "XXL=2",
                           "1,2,3=5", "1,2,3,0=5", "1,2,3,4,5=5", "1,,3,4=5", "1,2,3,nan=5"}) {
    EXPECT_THROW(stiffnessRegion(text), InvalidOption) << text;
  }
}

TEST(StiffnessRegion, FadesOverTenMillimetres) {
  const LungModel model = modelOfTwoLobes();
  const std::vector<StiffnessRegion> ball = {stiffnessRegion("60,0,0,20=4")};
  const std::vector<Vec3> points = {
      {60.0, 0.0, 0.0}, {60.0, 20.0, 0.0}, {60.0, 25.0, 0.0}, {60.0, 30.0, 0.0}, {60.0, 90.0, 0.0}};
  const std::vector<double> stiffness = stiffnessAt(points, Side::Left, model, ball);
  ASSERT_EQ(stiffness.size(), 5U);
  EXPECT_DOUBLE_EQ(stiffness[0], 4.0);
  EXPECT_DOUBLE_EQ(stiffness[1], 4.0);
  EXPECT_NEAR(stiffness[2], 2.0, 1e-12);
  EXPECT_NEAR(stiffness[3], 1.0, 1e-12);
  EXPECT_NEAR(stiffness[4], 1.0, 1e-12);
  EXPECT_TRUE(stiffnessAt(points, Side::Right, model, ball).empty());
}

TEST(StiffnessRegion, OfALobeIsOnItsSurface) {
  const LungModel model = modelOfTwoLobes();
  const std::vector<StiffnessRegion> lobe = {stiffnessRegion("LLL=0.5")};
  const std::vector<Vec3> points = {(*model.surfaces)[1].mesh->points[7], {60.0, 0.0, 60.0}};
  const std::vector<double> stiffness = stiffnessAt(points, Side::Left, model, lobe);
  EXPECT_NEAR(stiffness[0], 0.5, 1e-9);
  EXPECT_NEAR(stiffness[1], 1.0, 1e-9);
  EXPECT_THROW(stiffnessAt(points, Side::Right, model,
                           std::vector<StiffnessRegion>{stiffnessRegion("RLL=2")}),
               InvalidOption);
}

TEST(StiffnessRegion, SoftPartsGiveWayMore) {
  const LungModel model = modelOfTwoLobes();
  const double both =
      signedVolumeMm3(*(*model.surfaces)[0].mesh) + signedVolumeMm3(*(*model.surfaces)[1].mesh);
  const auto compliance = [&](const char* text) {
    return complianceOf(Side::Left, both, model,
                        std::vector<StiffnessRegion>{stiffnessRegion(text)});
  };
  EXPECT_NEAR(compliance("LLL=0.5"), 1.5, 1e-9);
  EXPECT_NEAR(compliance("LLL=2"), 0.75, 1e-9);
  EXPECT_THROW(compliance("0,0,500,10=2"), InvalidOption);
}

}  // namespace
}  // namespace pneuma
