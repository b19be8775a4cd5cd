#include "lobes/region_splitting.h"

#include <cmath>
#include <cstdlib>
#include <numbers>

#include <gtest/gtest.h>

#include "core/error.h"
#include "core/random.h"
#include "geometry/test_surfaces.h"
#include "lobes/fissure_fit.h"
#include "sound_regions.h"

namespace pneuma {
namespace {

using testing::contactsIn;
using testing::expectSound;

/// A lung's size, with bumps and a hollow where the heart lies.
TriangleMesh lung(int levels, Random& random) {
  TriangleMesh mesh = testing::sphere(1.0, Vec3::Zero(), levels);
  // One after the other: compilers do not agree in which order arguments are computed.
  Vec3 waves;
  for (const int axis : {2, 1, 0}) waves[axis] = random.uniform(2.0, 5.0);
  const double bump = random.uniform(0.02, 0.1);
  const double hollow = random.uniform(0.0, 0.5);
  for (Vec3& p : mesh.points) {
    const double side = p.x() - 0.9;
    const double depth = 1.0 - hollow * std::exp(-4.0 * (side * side + p.z() * p.z()));
    p *= depth * (1.0 + bump * std::sin(waves.x() * p.x() + 1.0) * std::sin(waves.y() * p.y()) *
                            std::cos(waves.z() * p.z()));
    p = p.cwiseProduct(Vec3(60.0, 85.0, 115.0));
  }
  return mesh;
}

HeightSurface plane(const Vec3& through, const Vec3& normal) {
  HeightSurface surface;
  surface.centre = through;
  surface.axes[2] = normal.normalized();
  surface.axes[0] = surface.axes[2].unitOrthogonal();
  surface.axes[1] = surface.axes[2].cross(surface.axes[0]);
  return surface;
}

/// Through points by chance, as far as `rough` from a plane.
HeightSurface roughFissure(const HeightSurface& flat, double rough, int n, double smoothness,
                           Random& random) {
  std::vector<Vec3> points;
  for (int i = 0; i < n; ++i) {
    const double u = random.uniform(-70.0, 70.0);
    const double v = random.uniform(-70.0, 70.0);
    points.push_back(flat.at({u, v}) + random.uniform(-rough, rough) * flat.normal());
  }
  return fitFissure(points, {.smoothness = smoothness});
}

constexpr RegionId Lower = 3;
constexpr RegionId Middle = 2;
constexpr RegionId Upper = 1;

std::string refusalOfSplit(RegionComplex& complex, const HeightSurface& surface) {
  try {
    splitRegion(complex, surface, {.region = 1, .below = Lower, .above = Upper}, "oblique fissure");
  } catch (const InvalidInput& error) {
    return error.what();
  }
  return "";
}

TEST(RegionSplitting, HalvesABallIntoCapsOfKnownVolume) {
  RegionComplex complex = complexOf(testing::sphere(1.0, Vec3::Zero(), 6), 1);
  for (Vec3& p : complex.points) p *= 80.0;
  const double whole = volumeMm3(complex, 1);
  const SplitReport report = splitRegion(complex, plane({0.0, 0.0, 20.0}, {0.3, -0.5, 1.0}),
                                         {.region = 1, .below = Lower, .above = Upper}, "fissure");
  expectSound(complex, Lower);
  expectSound(complex, Upper);
  // The cap of a ball (R, h): pi h^2 (3 R - h) / 3.
  const double offset = 20.0 / std::sqrt(0.09 + 0.25 + 1.0);
  const double h = 80.0 - offset;
  const double cap = std::numbers::pi * h * h * (240.0 - h) / 3.0;
  EXPECT_NEAR(volumeMm3(complex, Upper) / cap, 1.0, 2e-3);
  EXPECT_NEAR((volumeMm3(complex, Upper) + volumeMm3(complex, Lower)) / whole, 1.0, 1e-14);
  EXPECT_NEAR(report.contactMm2 / (std::numbers::pi * (6400.0 - offset * offset)), 1.0, 2e-3);
  EXPECT_EQ(report.piecesJoined, 0U);
}

TEST(RegionSplitting, CutsAlongALayerOfPointsExactly) {
  TriangleMesh octahedron;
  octahedron.points = {{50, 0, 0}, {-50, 0, 0}, {0, 50, 0}, {0, -50, 0}, {0, 0, 50}, {0, 0, -50}};
  octahedron.triangles = {{0, 2, 4}, {2, 1, 4}, {1, 3, 4}, {3, 0, 4},
                          {2, 0, 5}, {1, 2, 5}, {3, 1, 5}, {0, 3, 5}};
  RegionComplex complex = complexOf(octahedron, 1);
  splitRegion(complex, plane(Vec3::Zero(), Vec3::UnitZ()),
              {.region = 1, .below = Lower, .above = Upper, .capSpacingMm = 7.0}, "fissure");
  expectSound(complex, Lower);
  expectSound(complex, Upper);
  EXPECT_NEAR(volumeMm3(complex, Upper), volumeMm3(complex, Lower), 1e-9);
  EXPECT_NEAR(volumeMm3(complex, Upper), 50.0 * 50.0 * 50.0 * 2.0 / 3.0, 1e-9);
}

TEST(RegionSplitting, SharesTrianglesAtTheTripleLine) {
  Random random(3);
  RegionComplex complex = complexOf(lung(6, random), 1);
  const double whole = volumeMm3(complex, 1);
  splitRegion(complex, plane({0.0, 10.0, 0.0}, {0.1, -0.8, 1.0}),
              {.region = 1, .below = Lower, .above = 1}, "oblique fissure");
  splitRegion(complex, plane({0.0, -30.0, 10.0}, {0.0, 0.2, 1.0}),
              {.region = 1, .below = Middle, .above = Upper}, "horizontal fissure");
  double sum = 0.0;
  for (const RegionId region : {Upper, Middle, Lower}) {
    expectSound(complex, region);
    sum += volumeMm3(complex, region);
  }
  EXPECT_NEAR(sum / whole, 1.0, 1e-13);
  std::map<std::pair<RegionId, RegionId>, int> contacts = contactsIn(complex);
  EXPECT_GT((contacts[{Lower, Middle}]), 100);
  EXPECT_GT((contacts[{Lower, Upper}]), 100);
  EXPECT_GT((contacts[{Middle, Upper}]), 100);
}

/// A lung, split along a rough fissure into two sound parts.
struct RoughSplit {
  RoughSplit(std::uint64_t seed, double roughMm) {
    Random random(seed);
    complex = complexOf(lung(5, random), 1);
    const double whole = volumeMm3(complex, 1);
    fissure = roughFissure(plane({0.0, 60.0, 0.0}, {0.0, -1.0, 0.3}), roughMm, 25, 1e-3, random);
    report =
        splitRegion(complex, fissure, {.region = 1, .below = Lower, .above = Upper}, "fissure");
    expectSound(complex, Lower);
    expectSound(complex, Upper);
    EXPECT_NEAR((volumeMm3(complex, Upper) + volumeMm3(complex, Lower)) / whole, 1.0, 1e-13);
  }

  RegionComplex complex;
  HeightSurface fissure;
  SplitReport report;
};

TEST(RegionSplitting, JoinsPiecesOnTheWrongSide) {
  std::size_t joined = 0;
  for (std::uint64_t seed = 0; seed < 12; ++seed) {
    const SplitReport report = RoughSplit(seed, 25.0).report;
    EXPECT_EQ(report.piecesJoined > 0, report.joinedMm3 > 0.0);
    joined += report.piecesJoined;
  }
  EXPECT_GT(joined, 0U);
}

TEST(RegionSplitting, MovesAFissureThatOnlyTouchesTheLung) {
  int moved = 0;
  for (const std::uint64_t seed : {21, 92, 269}) {
    const RoughSplit split(seed, 10.0);
    EXPECT_LE(std::abs(split.report.movedMm), 0.2);
    if (split.report.movedMm != 0.0) ++moved;
    for (const Facet& facet : split.complex.facets) {
      if (!facet.borders(Lower) || !facet.borders(Upper)) continue;
      for (const std::uint32_t v : facet.corners) {
        EXPECT_LE(std::abs(split.fissure.height(split.complex.points[v])),
                  0.2 + 0.5);  // a tenth of an edge
      }
    }
  }
  EXPECT_GT(moved, 0);
}

/// Two lungs' worth of one region, 200 mm apart.
TriangleMesh twoLungs(Random& random) {
  TriangleMesh one = lung(5, random);
  TriangleMesh other = lung(5, random);
  for (Vec3& p : other.points) p.x() += 200.0;
  return testing::together(one, other);
}

TEST(RegionSplitting, CutsEveryPieceOfALungOfSeveral) {
  Random random(5);
  RegionComplex complex = complexOf(twoLungs(random), 1);
  const double whole = volumeMm3(complex, 1);
  const SplitReport oblique =
      splitRegion(complex, plane({0.0, 10.0, 0.0}, {0.1, -0.8, 1.0}),
                  {.region = 1, .below = Lower, .above = 1}, "oblique fissure");
  const SplitReport horizontal =
      splitRegion(complex, plane({0.0, -30.0, 10.0}, {0.0, 0.2, 1.0}),
                  {.region = 1, .below = Middle, .above = Upper}, "horizontal fissure");
  EXPECT_EQ(oblique.piecesJoined + horizontal.piecesJoined, 0U);
  double sum = 0.0;
  for (const RegionId region : {Upper, Middle, Lower}) {
    expectSound(complex, region, 2);
    sum += volumeMm3(complex, region);
  }
  EXPECT_NEAR(sum / whole, 1.0, 1e-13);
}

TEST(RegionSplitting, LeavesAPieceThatTheFissurePassesByWhole) {
  Random random(6);
  RegionComplex complex = complexOf(twoLungs(random), 1);
  const double whole = volumeMm3(complex, 1);
  // Through the first from its foot to its apex, and over the second.
  splitRegion(complex, plane({0.0, 0.0, 0.0}, {-1.0, 0.0, 0.5}),
              {.region = 1, .below = Lower, .above = Upper}, "fissure");
  expectSound(complex, Lower, 2);
  expectSound(complex, Upper, 1);
  EXPECT_NEAR((volumeMm3(complex, Upper) + volumeMm3(complex, Lower)) / whole, 1.0, 1e-13);
}

TEST(RegionSplitting, JoinsPiecesOnTheWrongSideToTheirOwnPieceOfTheLung) {
  std::size_t joined = 0;
  for (std::uint64_t seed = 0; seed < 12; ++seed) {
    Random random(seed);
    const TriangleMesh one = lung(5, random);
    const HeightSurface rough =
        roughFissure(plane({0.0, 60.0, 0.0}, {0.0, -1.0, 0.3}), 25.0, 25, 1e-3, random);
    const auto split = [&](RegionComplex& complex) {
      return splitRegion(complex, rough, {.region = 1, .below = Lower, .above = Upper}, "fissure");
    };
    RegionComplex alone = complexOf(one, 1);
    const SplitReport ofOne = split(alone);
    // A ball beside it that the fissure cuts in two, or passes by.
    const TriangleMesh ball = testing::sphere(15.0, {0.0, 60.0, 140.0}, 3);
    RegionComplex complex = complexOf(testing::together(one, ball), 1);
    const SplitReport ofBoth = split(complex);
    EXPECT_EQ(ofBoth.piecesJoined, ofOne.piecesJoined);
    EXPECT_NEAR(ofBoth.joinedMm3, ofOne.joinedMm3, 1e-6);
    const std::size_t lower = pieceCount(complex, Lower);
    const std::size_t upper = pieceCount(complex, Upper);
    EXPECT_GE(lower + upper, 3U);
    EXPECT_LE(std::max(lower, upper), 2U);
    expectSound(complex, Lower, lower);
    expectSound(complex, Upper, upper);
    joined += ofBoth.piecesJoined;
  }
  EXPECT_GT(joined, 0U);
}

int eulerNumber(const RegionComplex& complex, RegionId region) {
  const TriangleMesh mesh = surfaceOf(complex, region).mesh;
  return static_cast<int>(mesh.points.size()) - static_cast<int>(mesh.triangles.size() / 2);
}

TEST(RegionSplitting, CutsALungWithAHandle) {
  const TriangleMesh ring = testing::torus(60.0, 25.0);
  const auto halved = [&](const HeightSurface& fissure) {
    RegionComplex complex = complexOf(ring, 1);
    const double whole = volumeMm3(complex, 1);
    splitRegion(complex, fissure, {.region = 1, .below = Lower, .above = Upper}, "fissure");
    expectSound(complex, Lower);
    expectSound(complex, Upper);
    EXPECT_NEAR((volumeMm3(complex, Upper) + volumeMm3(complex, Lower)) / whole, 1.0, 1e-13);
    return complex;
  };
  // Along the ring: both halves are rings. Across it: both are without a handle, and the fissure
  // is two disks.
  const RegionComplex along = halved(plane({0.0, 0.0, 3.0}, {0.05, 0.1, 1.0}));
  EXPECT_EQ(eulerNumber(along, Lower), 0);
  EXPECT_EQ(eulerNumber(along, Upper), 0);
  const RegionComplex across = halved(plane({3.0, 0.0, 0.0}, {1.0, 0.2, 0.1}));
  EXPECT_EQ(eulerNumber(across, Lower), 2);
  EXPECT_EQ(eulerNumber(across, Upper), 2);
}

TEST(RegionSplitting, SaysWhereTheFissureDoesNotCross) {
  RegionComplex complex = complexOf(testing::sphere(1.0, Vec3::Zero(), 3), 1);
  for (Vec3& p : complex.points) p *= 50.0;
  const std::vector<Facet> before = complex.facets;
  const std::string apart = refusalOfSplit(complex, plane({0.0, 0.0, 70.0}, Vec3::UnitZ()));
  EXPECT_NE(apart.find("does not cross the lung: all of it lies between -120.0 mm and -20.0 mm"),
            std::string::npos)
      << apart;
  const std::string touching = refusalOfSplit(complex, plane({0.0, 0.0, 50.0}, Vec3::UnitZ()));
  EXPECT_NE(touching.find("touches the lung"), std::string::npos) << touching;
  EXPECT_EQ(complex.facets.size(), before.size());
}

/// Lungs and fissures by chance: the whole partition is right every time.
class RandomLungs : public ::testing::TestWithParam<int> {};

TEST_P(RandomLungs, SplitIntoThreeSoundLobes) {
  Random random(static_cast<std::uint64_t>(GetParam()) + 1000);
  RegionComplex complex = complexOf(lung(GetParam() % 3 == 0 ? 6 : 5, random), 1);
  const double whole = volumeMm3(complex, 1);
  const auto fissure = [&](const Vec3& centre, const Vec3& normal, double rough, int n) {
    return roughFissure(plane(centre, normal), rough, n, std::pow(10.0, random.uniform(-4.0, 0.0)),
                        random);
  };
  const double rough = random.uniform(0.0, 15.0);
  const int n = 3 + static_cast<int>(random.below(23));
  const HeightSurface oblique = fissure(
      {random.uniform(-10.0, 10.0), random.uniform(-15.0, 25.0), random.uniform(-30.0, 20.0)},
      {random.uniform(-0.3, 0.3), random.uniform(-1.2, -0.4), 1.0}, rough, n);
  const HeightSurface horizontal =
      fissure({0.0, -40.0, random.uniform(5.0, 35.0)},
              {random.uniform(-0.2, 0.2), random.uniform(-0.2, 0.4), 1.0}, 0.5 * rough, n);
  splitRegion(complex, oblique, {.region = 1, .below = Lower, .above = 1}, "oblique fissure");
  splitRegion(complex, horizontal, {.region = 1, .below = Middle, .above = Upper},
              "horizontal fissure");
  double sum = 0.0;
  for (const RegionId region : {Upper, Middle, Lower}) {
    expectSound(complex, region);
    sum += volumeMm3(complex, region);
  }
  EXPECT_NEAR(sum / whole, 1.0, 1e-12);
}

/// 60, or as many as PNEUMA_RANDOM_LUNGS says.
int randomLungs() {
  const char* count = std::getenv("PNEUMA_RANDOM_LUNGS");
  return count == nullptr ? 60 : std::atoi(count);
}

INSTANTIATE_TEST_SUITE_P(, RandomLungs, ::testing::Range(0, randomLungs()));

}  // namespace
}  // namespace pneuma
