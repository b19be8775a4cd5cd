#include "pipeline/fissure_snapping.h"

#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

#include "core/error.h"
#include "core/random.h"
#include "lobes/fissure_fit.h"
#include "support/stop_watch_sink.h"

// Fissures drawn onto sheets of a CT whose truth is known: a ball of lung in soft tissue, in it a
// sheet 1 mm thick, vessels, noise.
namespace pneuma {
namespace {

constexpr double RadiusMm = 42.0;
constexpr double SheetMm = 1.0;
constexpr double AeratedHu = -850.0;
constexpr double SheetHu = -600.0;

/// A fissure that is a plane, 30 degrees steep.
HeightSurface flat() {
  const std::vector<Vec3> points = {{0.0, 0.0, 0.0}, {30.0, 0.0, 2.0}, {0.0, 30.0, 17.3}};
  return fitFissure(points);
}

/// One that bends by some mm as real ones do.
HeightSurface curved() {
  std::vector<Vec3> points;
  for (double x = -40.0; x <= 40.0; x += 20.0) {
    for (double y = -40.0; y <= 40.0; y += 20.0) {
      points.emplace_back(x, y, 0.5 * y + 4.0 * std::sin(x / 18.0) + 3.0 * std::cos(y / 15.0));
    }
  }
  return fitFissure(points);
}

struct Vessel {
  Vec3 point;
  Vec3 way;
  double radiusMm = 1.0;
};

std::vector<Vessel> vessels(Random& random) {
  std::vector<Vessel> all;
  const auto anywhere = [&] {
    return Vec3(random.uniform(-1.0, 1.0), random.uniform(-1.0, 1.0), random.uniform(-1.0, 1.0));
  };
  for (int n = 0; n < 14; ++n) {
    all.push_back({0.7 * RadiusMm * anywhere(), anywhere().normalized(), random.uniform(0.8, 2.5)});
  }
  return all;
}

enum class Sheet { Whole, Half, None };

struct Phantom {
  CtImage ct;
  LabelImage labels;
  SheetnessImage sheets;
};

Phantom phantom(const HeightSurface& fissure, Sheet sheet, bool withVessels = true) {
  Random random(7);
  ImageGeometry geometry;
  geometry.size = {128, 128, 74};
  geometry.spacing = Vec3(0.7, 0.7, 1.25);
  geometry.origin = -0.5 * Vec3(127 * 0.7, 127 * 0.7, 73 * 1.25);
  Phantom made{{geometry, std::vector<std::int16_t>(geometry.voxelCount())},
               {geometry, std::vector<std::uint8_t>(geometry.voxelCount())},
               {}};
  const std::vector<Vessel> tubes = withVessels ? vessels(random) : std::vector<Vessel>();
  for (int k = 0; k < geometry.size[2]; ++k) {
    for (int j = 0; j < geometry.size[1]; ++j) {
      for (int i = 0; i < geometry.size[0]; ++i) {
        const Vec3 p = geometry.worldFromVoxel(Vec3(i, j, k));
        double hu = 40.0;
        if (p.norm() < RadiusMm) {
          made.labels.at(i, j, k) = 10;
          hu = AeratedHu;
          const bool there = sheet == Sheet::Whole || (sheet == Sheet::Half && p.x() < 0.0);
          // What a voxel a millimetre wide holds of the sheet.
          const double away = there ? std::abs(fissure.distance(p)) : RadiusMm;
          hu += (SheetHu - AeratedHu) * std::clamp(0.5 * SheetMm + 0.5 - away, 0.0, 1.0);
          for (const Vessel& tube : tubes) {
            const double to = (p - tube.point).cross(tube.way).norm();
            hu = std::max(hu,
                          AeratedHu - AeratedHu * std::clamp(tube.radiusMm + 0.5 - to, 0.0, 1.0));
          }
        }
        made.ct.at(i, j, k) = static_cast<std::int16_t>(std::lround(hu + 30.0 * random.normal()));
      }
    }
  }
  made.sheets = fissureSheetness(made.ct, made.labels, 10);
  return made;
}

std::vector<Vec3> pointsUpon(const HeightSurface& fissure, double stepMm) {
  std::vector<Vec3> points;
  for (double u = -30.0; u <= 30.0; u += stepMm) {
    for (double v = -30.0; v <= 30.0; v += stepMm) {
      const Vec3 p = fissure.at(fissure.planar(Vec3::Zero()) + Vec2(u, v));
      if (p.norm() < RadiusMm - 5.0) points.push_back(p);
    }
  }
  return points;
}

/// The part of a fissure in the ball, in triangles of 2.5 mm.
TriangleMesh patchOf(const HeightSurface& fissure) {
  TriangleMesh mesh;
  constexpr int Half = 20;
  constexpr std::uint32_t Row = 2 * Half + 1;
  for (int a = -Half; a <= Half; ++a) {
    for (int b = -Half; b <= Half; ++b) {
      mesh.points.push_back(fissure.at(fissure.planar(Vec3::Zero()) + 2.5 * Vec2(a, b)));
    }
  }
  for (std::uint32_t a = 0; a + 1 < Row; ++a) {
    for (std::uint32_t b = 0; b + 1 < Row; ++b) {
      const std::uint32_t p = a * Row + b;
      for (const std::array<std::uint32_t, 3>& t :
           {std::array<std::uint32_t, 3>{p, p + Row, p + 1},
            std::array<std::uint32_t, 3>{p + 1, p + Row, p + Row + 1}}) {
        const bool in = std::ranges::all_of(
            t, [&](std::uint32_t corner) { return mesh.points[corner].norm() < RadiusMm; });
        if (in) mesh.triangles.push_back(t);
      }
    }
  }
  return mesh;
}

UsedFissures proposed(const HeightSurface& surface) {
  UsedFissures fissures;
  fissures[Fissure::LeftOblique].surface = surface;
  fissures[Fissure::LeftOblique].source = FissureSource::Plane;
  return fissures;
}

/// Root of the mean square distance of a surface from the true one, mm.
double awayFrom(const HeightSurface& truth, const HeightSurface& surface) {
  double sum = 0.0;
  const std::vector<Vec3> points = pointsUpon(truth, 4.0);
  for (const Vec3& p : points) sum += std::pow(surface.distance(p), 2);
  return std::sqrt(sum / static_cast<double>(points.size()));
}

class SnappedOnto : public ::testing::TestWithParam<bool> {
 protected:
  HeightSurface truth() const { return GetParam() ? curved() : flat(); }
};

TEST_P(SnappedOnto, PointsTwoMillimetresOff) {
  const HeightSurface fissure = truth();
  const Phantom made = phantom(fissure, Sheet::Whole);
  std::vector<Vec3> points = pointsUpon(fissure, 9.0);
  for (std::size_t i = 0; i < points.size(); ++i) {
    points[i] += (i % 2 == 0 ? 2.0 : -2.0) * fissure.normalAt(fissure.planar(points[i]));
  }
  const SnappedPoints snapped = snapPoints(made.sheets, fissure, points);
  const auto count = static_cast<double>(std::ranges::count(snapped.onSheet, 1));
  EXPECT_GE(count, 0.85 * static_cast<double>(points.size()));
  double close = 0.0;
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (snapped.onSheet[i] == 0) {
      EXPECT_EQ(snapped.points[i], points[i]);
      continue;
    }
    const double away = std::abs(fissure.distance(snapped.points[i]));
    close += away <= 0.3 ? 1.0 : 0.0;
    EXPECT_LE(away, 0.5) << points[i].transpose();  // a vessel beside it draws it a little
  }
  EXPECT_GE(close, 0.95 * count);
}

TEST_P(SnappedOnto, ASurfaceThatIsFarAndTurned) {
  const HeightSurface fissure = truth();
  const Phantom made = phantom(fissure, Sheet::Whole);
  HeightSurface start = flat();
  start.quadratic[0] += 8.0;
  start.quadratic[1] += 0.12 * start.scale;
  UsedFissures fissures = proposed(start);
  std::vector<std::string> warnings;
  const FissureSnappings done = snapFissures(fissures, made.sheets, {}, {}, {}, warnings);
  EXPECT_TRUE(warnings.empty()) << warnings.front();
  EXPECT_GT(awayFrom(fissure, start), 6.0);
  EXPECT_LT(awayFrom(fissure, fissures.at(Fissure::LeftOblique).surface), 0.3);
  EXPECT_GT(done.at(Fissure::LeftOblique).shareAfter, 0.85);
}

TEST_P(SnappedOnto, IsComplete) {
  const HeightSurface fissure = truth();
  const Phantom made = phantom(fissure, Sheet::Whole);
  EXPECT_GT(completeness(made.sheets, patchOf(fissure)).share, 0.9);
}

TEST_P(SnappedOnto, IsHalfCompleteWhereHalfIsMissing) {
  const HeightSurface fissure = truth();
  const Phantom made = phantom(fissure, Sheet::Half, false);
  const TriangleMesh patch = patchOf(fissure);
  const Completeness found = completeness(made.sheets, patch);
  EXPECT_NEAR(found.share, 0.5, 0.05);
  // The missing part is marked, out to the rim.
  ASSERT_EQ(found.onSheet.size(), patch.triangles.size());
  std::size_t wrong = 0;
  for (std::size_t t = 0; t < patch.triangles.size(); ++t) {
    const double x = patch.points[patch.triangles[t][0]].x();
    if (std::abs(x) > 5.0 && (x < 0.0) != (found.onSheet[t] == 1)) ++wrong;
  }
  EXPECT_LE(wrong, patch.triangles.size() / 20);
}

INSTANTIATE_TEST_SUITE_P(, SnappedOnto, ::testing::Values(false, true),
                         [](const auto& test) { return test.param ? "Curved" : "Flat"; });

TEST(Snapping, FindsNothingInNoise) {
  const HeightSurface fissure = flat();
  const Phantom made = phantom(fissure, Sheet::None, false);
  const SnappedPoints snapped = snapPoints(made.sheets, fissure, pointsUpon(fissure, 6.0));
  EXPECT_EQ(std::ranges::count(snapped.onSheet, 1), 0);
  EXPECT_LT(completeness(made.sheets, patchOf(fissure)).share, 0.01);
  UsedFissures fissures = proposed(fissure);
  std::vector<std::string> warnings;
  snapFissures(fissures, made.sheets, {}, {}, {}, warnings);
  EXPECT_EQ(fissures.at(Fissure::LeftOblique).surface.quadratic, fissure.quadratic);
  EXPECT_EQ(warnings.size(), 1U);
}

TEST(Snapping, LeavesAFissureWhereVesselsAreAll) {
  const HeightSurface fissure = flat();
  const Phantom made = phantom(fissure, Sheet::None);
  EXPECT_LT(completeness(made.sheets, patchOf(fissure)).share, 0.05);
  UsedFissures fissures = proposed(fissure);
  std::vector<std::string> warnings;
  snapFissures(fissures, made.sheets, {}, {}, {}, warnings);
  EXPECT_EQ(fissures.at(Fissure::LeftOblique).surface.quadratic, fissure.quadratic);
}

TEST(Snapping, MakesTheSurfaceOfGivenPointsAnew) {
  const HeightSurface fissure = curved();
  const Phantom made = phantom(fissure, Sheet::Whole);
  GivenFissures given;
  given[Fissure::LeftOblique].points = pointsUpon(fissure, 11.0);
  std::vector<Vec3>& points = given[Fissure::LeftOblique].points;
  for (std::size_t i = 0; i < points.size(); ++i) points[i].z() += i % 2 == 0 ? 1.5 : -1.5;
  UsedFissures fissures = proposed(fitFissure(points));
  UsedFissure& used = fissures.at(Fissure::LeftOblique);
  used.source = FissureSource::Points;
  const double before = awayFrom(fissure, used.surface);
  std::vector<std::string> warnings;
  const FissureSnappings done = snapFissures(fissures, made.sheets, given, {}, {}, warnings);
  EXPECT_LT(awayFrom(fissure, used.surface), 0.5 * before);
  EXPECT_GT(std::ranges::count(done.at(Fissure::LeftOblique).points.onSheet, 1), 20);
}

TEST(Snapping, RefusesThickSlices) {
  CtImage ct;
  ct.geometry.spacing = Vec3(0.7, 0.7, 1.5);
  EXPECT_NO_THROW(requireThinSlices(ct));
  ct.geometry.spacing.z() = 2.5;
  EXPECT_THROW(requireThinSlices(ct), Unsupported);
}

TEST(Snapping, RefusesACtOfAnotherPerson) {
  const Phantom made = phantom(flat(), Sheet::None, false);
  LungModel model;
  model.ct = std::make_shared<const CtImage>(made.ct);
  model.labels = std::make_shared<const LabelImage>(made.labels);
  TriangleMesh elsewhere = patchOf(curved());
  for (Vec3& p : elsewhere.points) p.z() += 300.0;
  LobeSurface surface;
  surface.lobe = Lobe::RightLung;
  surface.name = "right.vtp";
  surface.mesh = std::make_shared<const TriangleMesh>(elsewhere);
  model.surfaces = std::make_shared<const std::vector<LobeSurface>>(1, surface);
  EXPECT_THROW(fissureSheets(model, Side::Right), InvalidInput);
}

TEST(Snapping, CanBeStoppedAtAnyMoment) {
  const HeightSurface fissure = curved();
  const Phantom made = phantom(fissure, Sheet::Whole);
  testing::StopWatchSink watch;
  const Progress progress(watch);
  fissureSheetness(made.ct, made.labels, 10, progress.part(0.0, 0.5, "sheets"));
  UsedFissures fissures = proposed(flat());
  std::vector<std::string> warnings;
  snapFissures(fissures, made.sheets, {}, {}, {}, warnings, progress.part(0.5, 1.0, "snapping"));
  progress.throwIfStopped();  // the last look
  EXPECT_LT(watch.longestSeconds(), 0.2);
}

}  // namespace
}  // namespace pneuma
