#include "lobes/sheet_splitting.h"

#include <cmath>
#include <functional>
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

constexpr RegionId UpperPart = 1;
constexpr RegionId MiddlePart = 2;
constexpr RegionId LowerPart = 3;
constexpr SplitRegion Oblique = {.region = UpperPart, .below = LowerPart, .above = UpperPart};
constexpr SplitRegion Horizontal = {.region = UpperPart, .below = MiddlePart, .above = UpperPart};

/// An ellipsoid of a lung's size, the same on both sides of its middle.
TriangleMesh ellipsoid(int levels = 5) {
  TriangleMesh mesh = testing::sphere(1.0, Vec3::Zero(), levels);
  for (Vec3& p : mesh.points) p = p.cwiseProduct(Vec3(55.0, 80.0, 115.0));
  return mesh;
}

/// A grid bent by `place`, both from -1 to 1.
TriangleMesh bentGrid(std::uint32_t along, std::uint32_t across,
                      const std::function<Vec3(double, double)>& place) {
  TriangleMesh mesh;
  for (std::uint32_t j = 0; j <= across; ++j) {
    for (std::uint32_t i = 0; i <= along; ++i) {
      mesh.points.push_back(place(2.0 * i / along - 1.0, 2.0 * j / across - 1.0));
    }
  }
  const std::uint32_t row = along + 1;
  for (std::uint32_t j = 0; j < across; ++j) {
    for (std::uint32_t i = 0; i < along; ++i) {
      const std::uint32_t v = j * row + i;
      mesh.triangles.push_back({v, v + 1, v + row});
      mesh.triangles.push_back({v + 1, v + row + 1, v + row});
    }
  }
  return mesh;
}

/// An S that leans over itself, drawn out along y; turned by half a circle it is itself.
TriangleMesh overhanging(double half = 100.0, double lift = 0.0) {
  return bentGrid(60, 40, [&](double a, double b) {
    const double x = 75.0 * a - 40.0 * std::sin(std::numbers::pi * a);
    return Vec3(x, half * b, 35.0 * a + lift);
  });
}

/// The plane z = 0 with a ball of radius 30 upon it whose middle is 15 above: a mushroom.
TriangleMesh mushroom() {
  constexpr double R = 30.0;
  constexpr double Height = 15.0;
  const double neck = std::sqrt(R * R - Height * Height);
  const double atNeck = std::acos(-Height / R);
  return bentGrid(144, 90, [&](double a, double b) {
    const double turn = std::numbers::pi * a;
    const double s = (b + 1.0) / 2.0;  // from the top down, then outwards
    const double ball = std::min(1.0, 2.0 * s) * atNeck;
    const double radius = s < 0.5 ? R * std::sin(ball) : neck + (2.0 * s - 1.0) * (140.0 - neck);
    const double z = s < 0.5 ? Height + R * std::cos(ball) : 0.0;
    return Vec3(radius * std::cos(turn), -radius * std::sin(turn), z);
  });
}

/// A grid around an axis is one sheet once its seam and its middle are welded.
TriangleMesh welded(const TriangleMesh& mesh) {
  TriangleMesh result;
  std::vector<std::uint32_t> indexOf;
  for (const Vec3& p : mesh.points) {
    std::uint32_t found = 0;
    while (found < result.points.size() && (result.points[found] - p).norm() > 1e-9) ++found;
    if (found == result.points.size()) result.points.push_back(p);
    indexOf.push_back(found);
  }
  for (const auto& [a, b, c] : mesh.triangles) {
    const std::array<std::uint32_t, 3> t = {indexOf[a], indexOf[b], indexOf[c]};
    if (t[0] != t[1] && t[1] != t[2] && t[2] != t[0]) result.triangles.push_back(t);
  }
  return result;
}

FissureSheet sheetOf(TriangleMesh mesh, double extendMm = 0.0) {
  return fissureSheet(std::move(mesh), Vec3::UnitZ(), extendMm, "surface");
}

std::string refusal(const FissureSheet& sheet) {
  RegionComplex complex = complexOf(ellipsoid(4), UpperPart);
  const std::size_t before = complex.facets.size();
  try {
    splitRegion(complex, sheet, Oblique, "oblique fissure");
  } catch (const InvalidInput& error) {
    EXPECT_EQ(complex.facets.size(), before);
    return error.what();
  }
  return "";
}

HeightSurface planeAt(const Vec3& centre, const Vec3& normal) {
  HeightSurface surface;
  surface.centre = centre;
  surface.axes[2] = normal.normalized();
  surface.axes[0] = surface.axes[2].unitOrthogonal();
  surface.axes[1] = surface.axes[2].cross(surface.axes[0]);
  return surface;
}

TEST(SheetSplitting, AnOverhangingSheetThatIsTheSameTurnedHalvesTheLung) {
  RegionComplex complex = complexOf(ellipsoid(), UpperPart);
  const double whole = volumeMm3(complex, UpperPart);
  const SplitReport report = splitRegion(complex, sheetOf(overhanging()), Oblique, "fissure");
  expectSound(complex, LowerPart);
  expectSound(complex, UpperPart);
  EXPECT_NEAR(volumeMm3(complex, LowerPart) / whole, 0.5, 1e-12);
  EXPECT_NEAR((volumeMm3(complex, LowerPart) + volumeMm3(complex, UpperPart)) / whole, 1.0, 1e-13);
  EXPECT_EQ(report.piecesJoined, 0U);
  EXPECT_NEAR(report.contactMm2, areaMm2(contactOf(complex, LowerPart, UpperPart)), 1e-6);
  // Under the overhang is above, over it is below.
  const auto lowerAt = bounds(surfaceOf(complex, LowerPart).mesh);
  EXPECT_LT(lowerAt.min().z(), -100.0);
  EXPECT_LT(lowerAt.center().z(), bounds(surfaceOf(complex, UpperPart).mesh).center().z());
}

TEST(SheetSplitting, AMushroomAddsItsBallToTheLowerPart) {
  RegionComplex complex = complexOf(ellipsoid(6), UpperPart);
  const double whole = volumeMm3(complex, UpperPart);
  splitRegion(complex, sheetOf(welded(mushroom())), Oblique, "fissure");
  expectSound(complex, LowerPart);
  expectSound(complex, UpperPart);
  // Of a ball (R, middle at c) what is above 0: pi (R + c)^2 (2 R - c) / 3.
  const double ball = std::numbers::pi * 45.0 * 45.0 * 45.0 / 3.0;
  EXPECT_NEAR((volumeMm3(complex, LowerPart) - whole / 2.0) / ball, 1.0, 3e-3);
}

TEST(SheetSplitting, SharesTrianglesAtTheTripleLineInEveryOrder) {
  const HeightSurface plane = planeAt({0.0, -30.0, 25.0}, {0.1, 0.2, 1.0});
  const HeightSurface steep = planeAt({0.0, 10.0, -10.0}, {0.1, -0.8, 1.0});
  const FissureSheet low = sheetOf(overhanging(100.0, -15.0));
  const FissureSheet high = sheetOf(overhanging(100.0, 25.0));
  const auto cut = [](RegionComplex& complex, const auto& fissure, const SplitRegion& settings) {
    splitRegion(complex, fissure, settings, "fissure");
  };
  for (int order = 0; order < 3; ++order) {
    RegionComplex complex = complexOf(ellipsoid(), UpperPart);
    const double whole = volumeMm3(complex, UpperPart);
    if (order == 0) cut(complex, low, Oblique), cut(complex, plane, Horizontal);
    if (order == 1) cut(complex, steep, Oblique), cut(complex, high, Horizontal);
    if (order == 2) {
      TriangleMesh crossing = overhanging(160.0, 0.0);  // turned about z, it crosses the other
      for (Vec3& p : crossing.points) p = Vec3(p.y(), -1.3 * p.x(), p.z() + 30.0);
      cut(complex, low, Oblique), cut(complex, sheetOf(crossing), Horizontal);
    }
    double sum = 0.0;
    for (const RegionId region : {UpperPart, MiddlePart, LowerPart}) {
      expectSound(complex, region);
      sum += volumeMm3(complex, region);
    }
    EXPECT_NEAR(sum / whole, 1.0, 1e-12);
    auto contacts = contactsIn(complex);
    EXPECT_GT((contacts[{LowerPart, MiddlePart}]), 10) << order;
    EXPECT_GT((contacts[{LowerPart, UpperPart}]), 10) << order;
    EXPECT_GT((contacts[{MiddlePart, UpperPart}]), 100) << order;
  }
}

TEST(SheetSplitting, RefusesASheetThatEndsInsideAndSaysWhereAndHowDeep) {
  const std::string small = refusal(sheetOf(overhanging(60.0)));
  EXPECT_NE(small.find("surface of the oblique fissure ends inside the lung: at ("),
            std::string::npos)
      << small;
  EXPECT_NE(small.find(" mm from the wall; extend it"), std::string::npos) << small;
  // Its short edge lies at most 20 mm below the wall; where it is extended that far it parts the
  // lung.
  EXPECT_EQ(refusal(sheetOf(overhanging(70.0), 15.0)), "");
}

TEST(SheetSplitting, GoesOnToTheWallFromARimUponIt) {
  RegionComplex complex = complexOf(ellipsoid(), UpperPart);
  splitRegion(complex, sheetOf(overhanging()), Oblique, "fissure");
  const TriangleMesh contact = contactOf(complex, LowerPart, UpperPart);
  const double below = volumeMm3(complex, LowerPart);
  RegionComplex again = complexOf(ellipsoid(), UpperPart);
  splitRegion(again, sheetOf(contact), Oblique, "fissure");
  expectSound(again, LowerPart);
  expectSound(again, UpperPart);
  EXPECT_NEAR(volumeMm3(again, LowerPart) / below, 1.0, 1e-5);
}

TEST(SheetSplitting, RefusesASheetThatOneComesAround) {
  // Through one side of a ring; the other side joins both parts.
  const TriangleMesh half =
      bentGrid(20, 20, [](double a, double b) { return Vec3(60.0 + 40.0 * a, 5.0 * a, 40.0 * b); });
  const FissureSheet sheet = fissureSheet(half, Vec3::UnitY(), 0.0, "surface");
  RegionComplex complex = complexOf(testing::torus(60.0, 25.0), UpperPart);
  try {
    splitRegion(complex, sheet, Oblique, "oblique fissure");
    FAIL();
  } catch (const InvalidInput& error) {
    EXPECT_NE(std::string(error.what()).find("does not part the lung"), std::string::npos);
  }
}

TEST(SheetSplitting, CutsEveryPieceOfALungOfSeveralAndLeavesThoseBesideWhole) {
  TriangleMesh lungs = ellipsoid();
  for (const double beside : {-130.0, 260.0}) {
    TriangleMesh other = ellipsoid(4);
    for (Vec3& p : other.points) p = 0.9 * p + Vec3(beside, 0.0, 0.0);
    lungs = testing::together(lungs, other);
  }
  TriangleMesh sheet = bentGrid(120, 40, [](double a, double b) {  // over two of them
    const double x = 75.0 * (2.0 * a - 1.0) + 45.0 * std::sin(2.0 * std::numbers::pi * a);
    return Vec3(x + 10.0, 100.0 * b, 20.0 * std::cos(std::numbers::pi * a));
  });
  RegionComplex complex = complexOf(lungs, UpperPart);
  const double whole = volumeMm3(complex, UpperPart);
  splitRegion(complex, sheetOf(sheet), Oblique, "fissure");
  EXPECT_EQ(pieceCount(complex, LowerPart) + pieceCount(complex, UpperPart), 5U);
  expectSound(complex, LowerPart, pieceCount(complex, LowerPart));
  expectSound(complex, UpperPart, pieceCount(complex, UpperPart));
  EXPECT_NEAR((volumeMm3(complex, UpperPart) + volumeMm3(complex, LowerPart)) / whole, 1.0, 1e-13);
}

TEST(SheetSplitting, RefusesWhatIsNoSheet) {
  TriangleMesh beside = overhanging();
  for (Vec3& p : beside.points) p.x() += 300.0;
  EXPECT_NE(refusal(sheetOf(beside)).find("does not cross the lung"), std::string::npos);
  TriangleMesh turned = overhanging();
  for (std::size_t t = 0; t < 100; ++t) std::swap(turned.triangles[t][1], turned.triangles[t][2]);
  EXPECT_THROW(sheetOf(turned), InvalidInput);
  TriangleMesh meeting = overhanging();
  const TriangleMesh other = overhanging(100.0, 5.0);
  meeting = testing::together(meeting, other);
  EXPECT_THROW(sheetOf(meeting), InvalidInput);
  TriangleMesh upright =
      bentGrid(10, 10, [](double a, double b) { return Vec3(0.0, 100.0 * a, 100.0 * b); });
  EXPECT_THROW(sheetOf(upright), InvalidInput);
}

/// Lungs and folding sheets by chance.
class RandomSheets : public ::testing::TestWithParam<int> {};

TEST_P(RandomSheets, SplitIntoThreeSoundLobes) {
  Random random(static_cast<std::uint64_t>(GetParam()) + 500);
  TriangleMesh lung = ellipsoid(5);
  const double bump = random.uniform(0.02, 0.08);
  for (Vec3& p : lung.points) {
    p *=
        1.0 + bump * std::sin(0.06 * p.x() + 1.0) * std::sin(0.05 * p.y()) * std::cos(0.04 * p.z());
  }
  TriangleMesh sheet = overhanging(140.0, random.uniform(-25.0, 15.0));
  const Eigen::AngleAxisd tilt(random.uniform(-0.5, 0.5), Vec3::UnitX());
  const Eigen::AngleAxisd turn(random.uniform(-0.4, 0.4), Vec3::UnitZ());
  const double wave = random.uniform(0.0, 6.0);
  for (Vec3& p : sheet.points) {
    p.z() += wave * std::sin(0.07 * p.y());
    p = turn * (tilt * p);
  }
  RegionComplex complex = complexOf(lung, UpperPart);
  const double whole = volumeMm3(complex, UpperPart);
  splitRegion(complex, sheetOf(sheet), Oblique, "oblique fissure");
  splitRegion(complex,
              planeAt({0.0, -30.0, random.uniform(25.0, 45.0)},
                      {random.uniform(-0.2, 0.2), random.uniform(-0.2, 0.4), 1.0}),
              Horizontal, "horizontal fissure");
  double sum = 0.0;
  for (const RegionId region : {UpperPart, MiddlePart, LowerPart}) {
    expectSound(complex, region);
    sum += volumeMm3(complex, region);
  }
  EXPECT_NEAR(sum / whole, 1.0, 1e-12);
  contactsIn(complex);
}

INSTANTIATE_TEST_SUITE_P(, RandomSheets, ::testing::Range(0, 12));

}  // namespace
}  // namespace pneuma
