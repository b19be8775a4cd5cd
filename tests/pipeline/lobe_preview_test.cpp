#include "pipeline/lobe_preview.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <tuple>

#include <gtest/gtest.h>

#include "core/random.h"
#include "core/units.h"
#include "geometry/surface_domain.h"
#include "geometry/test_surfaces.h"
#include "lobes/fissure_fit.h"
#include "pipeline/lobes_model.h"

namespace pneuma {
namespace {

constexpr double SpacingMm = 2.5;

/// An egg of a lung's size, its apex up.
std::shared_ptr<const TriangleMesh> taperedEgg() {
  TriangleMesh mesh = testing::sphere(1.0, Vec3::Zero(), 5);
  for (Vec3& p : mesh.points) {
    p = p.cwiseProduct(Vec3(55.0, 80.0, 115.0)) * (1.0 - 0.15 * p.z());
  }
  return std::make_shared<const TriangleMesh>(std::move(mesh));
}

std::shared_ptr<const LungShape> shape(Side side) {
  return std::make_shared<const LungShape>(lungShape(taperedEgg(), side));
}

/// Bent through points that lie off the proposals.
FissureSurfaces fissures(const LungShape& lung) {
  Random random(3);
  FissureSurfaces surfaces;
  for (const Fissure fissure : fissuresOf(lung.side)) {
    const HeightSurface proposed = proposedFissure(fissure, lung.extent.box);
    std::vector<Vec3> points;
    for (int i = 0; i < 12; ++i) {
      points.push_back(proposed.at({random.uniform(10.0, 90.0), random.uniform(15.0, 130.0)}) +
                       Vec3(0.0, 0.0, random.uniform(-8.0, 8.0)));
    }
    surfaces[fissure] = fitFissure(points);
  }
  return surfaces;
}

using Place = std::tuple<double, double, double>;

Place placeOf(const Vec3& p) { return {p.x(), p.y(), p.z()}; }

TEST(LobePreview, PointsAreInTheLobesThatTheSplitPutsThemIn) {
  for (const Side side : {Side::Right, Side::Left}) {
    const auto lung = shape(side);
    const FissureSurfaces surfaces = fissures(*lung);
    const LobePreview preview(lung, surfaces);
    const SplitLung split = splitLung(*lung->mesh, side, surfaces, SpacingMm);
    std::map<Place, std::set<Lobe>> lobesThere;
    for (const Lobe lobe : lobesOf(side)) {
      for (const Vec3& p : surfaceOf(split.complex, static_cast<RegionId>(lobe)).mesh.points) {
        lobesThere[placeOf(p)].insert(lobe);
      }
    }
    const std::vector<Lobe> lobes = preview.lobes();
    std::size_t inOneLobe = 0;
    for (std::size_t i = 0; i < lobes.size(); ++i) {
      const Vec3& p = lung->mesh->points[i];
      const std::set<Lobe>& there = lobesThere.at(placeOf(p));
      EXPECT_TRUE(there.contains(lobes[i])) << p.transpose();
      EXPECT_EQ(lobes[i], preview.lobeAt(p));
      inOneLobe += there.size() == 1 ? 1 : 0;
    }
    EXPECT_GT(inOneLobe, lobes.size() * 9 / 10);
  }
}

TEST(LobePreview, PointsInsideAreInTheLobesThatTheSplitPutsThemIn) {
  const auto lung = shape(Side::Right);
  FissureSurfaces planes;  // so that the split's triangles lie upon them
  planes[Fissure::RightOblique].axes = {Vec3::UnitX(), Vec3(0.0, 0.8, 0.6), Vec3(0.0, -0.6, 0.8)};
  planes[Fissure::RightHorizontal].centre = Vec3(0.0, 0.0, 12.0);
  const LobePreview preview(lung, planes);
  const SplitLung split = splitLung(*lung->mesh, Side::Right, planes, SpacingMm);
  // Near the wall the cut runs through points of the lung that are a tenth of an edge from it.
  constexpr double EdgeMm = 8.0;
  const SurfaceDomain whole(*lung->mesh);
  for (const Lobe lobe : lobesOf(Side::Right)) {
    const SurfaceDomain domain(surfaceOf(split.complex, static_cast<RegionId>(lobe)).mesh);
    for (const Vec3& p : lung->inside) {
      const double away = std::min(std::abs(planes[Fissure::RightOblique].height(p)),
                                   std::abs(planes[Fissure::RightHorizontal].height(p)));
      if (away < (whole.distanceToWall(p) < EdgeMm ? 0.1 * EdgeMm : 1e-6)) continue;
      EXPECT_EQ(preview.lobeAt(p) == lobe, domain.contains(p)) << p.transpose();
    }
  }
}

TEST(LobePreview, VolumesAreThoseOfTheSplitWithinHalfAPercentOfTheLung) {
  const auto lung = shape(Side::Right);
  const FissureSurfaces surfaces = fissures(*lung);
  const LobePreview preview(lung, surfaces);
  const SplitLung split = splitLung(*lung->mesh, Side::Right, surfaces, SpacingMm);
  for (const auto& [lobe, volume] : preview.volumesMm3()) {
    EXPECT_NEAR(volume, volumeMm3(split.complex, static_cast<RegionId>(lobe)),
                0.005 * lung->volumeMm3)
        << shortName(lobe);
  }
}

TEST(LobePreview, ASetFissureMovesTheOthersNot) {
  const auto lung = shape(Side::Right);
  LobePreview preview(lung, fissures(*lung));
  const auto oblique = preview.heights(Fissure::RightOblique);
  const auto horizontal = preview.heights(Fissure::RightHorizontal);
  HeightSurface moved = preview.surface(Fissure::RightHorizontal);
  moved.quadratic[0] += 5.0;
  preview.set(Fissure::RightHorizontal, moved);
  EXPECT_EQ(preview.heights(Fissure::RightOblique), oblique);
  EXPECT_NEAR(preview.heights(Fissure::RightHorizontal)->front(), horizontal->front() - 5.0, 1e-4);
}

TEST(LobePreview, ReachesWantedShares) {
  for (const Side side : {Side::Right, Side::Left}) {
    const auto lung = shape(side);
    LobePreview preview(lung, fissures(*lung));
    preview.moveTo(usualShares(side));
    const auto volumes = preview.volumesMm3();
    for (std::size_t i = 0; i < lobesOf(side).size(); ++i) {
      EXPECT_NEAR(volumes.at(lobesOf(side)[i]) / lung->volumeMm3, usualShares(side)[i], 0.002);
    }
    EXPECT_NEAR(preview.surface(fissuresOf(side)[0]).height(lung->mesh->points[0]),
                (*preview.heights(fissuresOf(side)[0]))[0], 1e-3);
  }
}

TEST(LobePreview, ContoursLieUponFissureAndLungAndTheHorizontalOneInFrontOfTheOblique) {
  const auto lung = shape(Side::Right);
  const LobePreview preview(lung, fissures(*lung));
  const HeightSurface& oblique = preview.surface(Fissure::RightOblique);
  for (const Fissure fissure : fissuresOf(Side::Right)) {
    const std::vector<SurfaceLine> lines = preview.contour(fissure);
    ASSERT_EQ(lines.size(), 1U);
    for (const Vec3& p : lines[0]) {
      EXPECT_NEAR(preview.surface(fissure).height(p), 0.0, 0.3);  // linear along an edge
    }
    const bool closed = lines[0].front() == lines[0].back();
    EXPECT_EQ(closed, fissure == Fissure::RightOblique);
    if (closed) continue;
    for (const Vec3& p : lines[0]) EXPECT_GT(oblique.height(p), -0.3);
    EXPECT_NEAR(oblique.height(lines[0].front()), 0.0, 0.3);
    EXPECT_NEAR(oblique.height(lines[0].back()), 0.0, 0.3);
  }
}

TEST(LobePreview, PatchesHaveTheAreaOfTheContacts) {
  const auto lung = shape(Side::Right);
  const FissureSurfaces surfaces = fissures(*lung);
  const LobePreview preview(lung, surfaces);
  const SplitLung split = splitLung(*lung->mesh, Side::Right, surfaces, SpacingMm);
  for (const Fissure fissure : fissuresOf(Side::Right)) {
    const double area = areaMm2(preview.patch(fissure, 4.0));
    EXPECT_NEAR(area / split.reports.at(fissure).contactMm2, 1.0, 0.02) << shortName(fissure);
  }
}

TEST(LobePreview, AFissureThatDoesNotCrossShowsNothing) {
  const auto lung = shape(Side::Left);
  LobePreview preview(lung, fissures(*lung));
  HeightSurface beside;
  beside.centre = Vec3(0.0, 0.0, 900.0);
  preview.set(Fissure::LeftOblique, beside);
  EXPECT_TRUE(preview.contour(Fissure::LeftOblique).empty());
  EXPECT_TRUE(preview.patch(Fissure::LeftOblique, 4.0).triangles.empty());
  EXPECT_EQ(preview.volumesMm3().at(Lobe::LeftUpper), 0.0);
}

TEST(LobesModel, GrowthGetsTheLobesAndTheWholeLungsStayForASecondSplit) {
  LungModel model;
  LobeSurface surface;
  surface.lobe = Lobe::LeftLung;
  surface.mesh = taperedEgg();
  surface.health = examine(*surface.mesh, SelfIntersections::Skip, {});
  model.surfaces = std::make_shared<const std::vector<LobeSurface>>(std::vector{surface});
  const LungModel split = withLobes(model, {});
  ASSERT_EQ(split.surfaces->size(), 2U);
  EXPECT_EQ(split.surfaces->at(0).lobe, Lobe::LeftUpper);
  EXPECT_TRUE(split.surfaces->at(1).health.fitToGrow());
  EXPECT_EQ(wholeLungsOf(split), model.surfaces);
  LobeInputs inputs;
  inputs.shares[Side::Left] = {0.6, 0.4};
  const LungModel again = withLobes(split, inputs);
  const double whole = millilitres(again.lobes->lungMm3.at(Side::Left));
  EXPECT_NEAR(again.surfaces->at(0).health.volumeMl / whole, 0.6, 1e-5);
  EXPECT_THROW(withLobes(LungModel{}, {}), InvalidInput);
}

}  // namespace
}  // namespace pneuma
