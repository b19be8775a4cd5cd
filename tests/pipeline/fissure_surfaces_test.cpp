#include "pipeline/fissure_surfaces.h"

#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include "core/error.h"
#include "geometry/test_surfaces.h"
#include "pipeline/fissure_coverage.h"

namespace pneuma {
namespace {

/// An egg of a lung's size.
TriangleMesh egg() {
  TriangleMesh mesh = testing::sphere(1.0, Vec3::Zero(), 4);
  for (Vec3& p : mesh.points) p = p.cwiseProduct(Vec3(55.0, 80.0, 115.0));
  return mesh;
}

UsedFissure leftOblique(const GivenFissure& given, const LobeOptions& options = {}) {
  std::vector<std::string> warnings;
  return fissureSurfaces(egg(), Side::Left, {{Fissure::LeftOblique, given}}, options, warnings)
      .at(Fissure::LeftOblique);
}

std::string refusal(const GivenFissure& given, const LobeOptions& options = {}) {
  try {
    leftOblique(given, options);
  } catch (const InvalidInput& error) {
    return error.what();
  }
  return "";
}

TEST(FissureSurfaces, HaveTheUpperLobeAboveAPlaneWhicheverWayItsNormalPoints) {
  const Vec3 point(10.0, 20.0, 30.0);
  const Vec3 normal(0.1, -0.7, 0.9);
  for (const double sign : {2.0, -3.0}) {
    GivenFissure given;
    given.plane = FissurePlane{point, sign * normal};
    const UsedFissure used = leftOblique(given);
    EXPECT_EQ(used.source, FissureSource::Plane);
    EXPECT_NEAR(used.surface.height(point + 5.0 * normal.normalized()), 5.0, 1e-12);
    EXPECT_NEAR(used.surface.height(point + Vec3(9.0, 9.0, 6.0)), 0.0, 1e-12);
  }
  GivenFissure upright;
  upright.plane = FissurePlane{point, {1.0, 0.01, 0.0}};
  EXPECT_NE(refusal(upright).find("neither side"), std::string::npos);
}

TEST(FissureSurfaces, FollowAnEquationExactly) {
  GivenFissure given;
  given.equation = FissureEquation{{1.0, -2.0, 4.0}, {-20.0, 0.25, 1.15, 0.001, -0.002, -0.0009}};
  const UsedFissure used = leftOblique(given);
  EXPECT_EQ(used.source, FissureSource::Equation);
  for (const auto& [x, y] : {std::pair{0.0, 0.0}, {30.0, -50.0}, {-12.0, 70.0}}) {
    const double z = -20.0 + 0.25 * x + 1.15 * y + 0.001 * x * x - 0.002 * x * y - 0.0009 * y * y;
    EXPECT_NEAR(used.surface.height({1.0 + x, -2.0 + y, 4.0 + z + 7.0}), 7.0, 1e-9);
  }
}

TEST(FissureSurfaces, TellHowMuchOfAFissureItsPointsEnclose) {
  const auto coverage = [](double width, std::vector<std::string>& warnings) {
    GivenFissure given;
    given.points = {{-width, -width, 0.0}, {width, -width, 0.0}, {width, width, 0.0},
                    {-width, width, 0.0},  {0.0, width, 1.0},    {width, 0.0, 1.0}};
    const GivenFissures all = {{Fissure::LeftOblique, given}};
    UsedFissures used = fissureSurfaces(egg(), Side::Left, all, {}, warnings);
    const SplitLung lung = splitLung(
        egg(), Side::Left, {{Fissure::LeftOblique, used.at(Fissure::LeftOblique).surface}}, 2.5);
    addCoverage(used, lung, all, warnings);
    return used.at(Fissure::LeftOblique).coverage.value();
  };
  std::vector<std::string> warnings;
  EXPECT_GT(coverage(45.0, warnings), 0.5);
  EXPECT_TRUE(warnings.empty());
  // The egg has an ellipse of 55 by 80 mm there.
  EXPECT_NEAR(coverage(20.0, warnings), 1600.0 / (std::numbers::pi * 55.0 * 80.0), 0.02);
  ASSERT_EQ(warnings.size(), 1U);
  EXPECT_NE(warnings[0].find("left oblique fissure enclose 1"), std::string::npos) << warnings[0];
}

/// z = 20 over the lung, as far as `reach` mm from the axis.
GivenFissure disk(double reach) {
  TriangleMesh mesh;
  mesh.points.emplace_back(0.0, 0.0, 20.0);
  constexpr std::uint32_t Spokes = 40;
  for (std::uint32_t ring = 1; ring <= 5; ++ring) {
    for (std::uint32_t i = 0; i < Spokes; ++i) {
      const double angle = 2.0 * std::numbers::pi * i / Spokes;
      mesh.points.emplace_back(reach * ring / 5.0 * std::cos(angle),
                               1.5 * reach * ring / 5.0 * std::sin(angle), 20.0);
    }
  }
  const auto at = [](std::uint32_t ring, std::uint32_t i) {
    return ring == 0 ? 0U : 1 + (ring - 1) * Spokes + i % Spokes;
  };
  for (std::uint32_t ring = 0; ring < 5; ++ring) {
    for (std::uint32_t i = 0; i < Spokes; ++i) {
      mesh.triangles.push_back({at(ring, i), at(ring + 1, i), at(ring + 1, i + 1)});
      if (ring > 0) mesh.triangles.push_back({at(ring, i), at(ring + 1, i + 1), at(ring, i + 1)});
    }
  }
  GivenFissure given;
  given.patch = FissurePatch{"disk.vtp", std::make_shared<const TriangleMesh>(mesh), {}};
  return given;
}

TEST(FissureSurfaces, FollowASurfaceThatReachesTheWall) {
  const UsedFissure used = leftOblique(disk(60.0));
  EXPECT_EQ(used.source, FissureSource::Surface);
  EXPECT_NEAR(used.surface.height({10.0, 20.0, 33.0}), 13.0, 1e-3);
  EXPECT_LT(used.largestMm, 0.2);
  EXPECT_GT(used.points, 10U);
}

TEST(FissureSurfaces, GoOnAsFarAsAllowedWhereASurfaceEndsInside) {
  // At z = 20 the egg is 54.2 mm wide on each side: 6.2 mm more than the disk.
  const std::string found = refusal(disk(48.0));
  EXPECT_NE(found.find("surface of the left oblique fissure ends inside the lung: at ("),
            std::string::npos)
      << found;
  EXPECT_FALSE(refusal(disk(48.0), {.extendMm = 3.0}).empty());
  EXPECT_EQ(leftOblique(disk(48.0), {.extendMm = 8.0}).source, FissureSource::Surface);
}

}  // namespace
}  // namespace pneuma
