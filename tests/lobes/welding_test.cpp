#include "lobes/welding.h"

#include <gtest/gtest.h>

#include "geometry/mesh_topology.h"
#include "geometry/test_surfaces.h"
#include "lobes/egg_lung.h"
#include "lobes/fissure_proposal.h"
#include "lobes/height_table.h"
#include "lobes/lobe_splitting.h"

namespace pneuma {
namespace {

TEST(Welding, GivesTheLungOfItsLobesBack) {
  const TriangleMesh lung = eggLung();
  FissureSurfaces fissures;
  for (const Fissure fissure : fissuresOf(Side::Right)) {
    fissures[fissure] = proposedFissure(fissure, lungBox(lung));
  }
  const SplitLung split = splitLung(lung, Side::Right, fissures, 4.0);
  std::map<Lobe, TriangleMesh> lobes;
  std::vector<std::pair<RegionId, const TriangleMesh*>> surfaces;
  for (const Lobe lobe : lobesOf(Side::Right)) {
    lobes[lobe] = surfaceOf(split.complex, static_cast<RegionId>(lobe)).mesh;
    surfaces.emplace_back(static_cast<RegionId>(lobe), &lobes[lobe]);
  }
  const Welding welding = weld(surfaces);
  EXPECT_EQ(welding.conflicts, 0U);
  std::size_t contact = 0;
  for (const Facet& facet : split.complex.facets) {
    if (facet.front != OutsideRegion && facet.behind != OutsideRegion) ++contact;
  }
  EXPECT_EQ(welding.sharedTriangles, contact);
  EXPECT_EQ(welding.complex.facets.size(), split.complex.facets.size());
  const TriangleMesh outer = outerSurface(welding.complex);
  const MeshTopology health = topology(outer);
  EXPECT_EQ(health.openEdges + health.nonManifoldEdges + health.misorientedEdges +
                health.nonManifoldVertices,
            0U);
  EXPECT_NEAR(signedVolumeMm3(outer) / signedVolumeMm3(lung), 1.0, 1e-12);
}

TEST(Welding, CountsOverlapOfTheSameTriangles) {
  const TriangleMesh cube = testing::cube(10.0);
  const std::array<std::pair<RegionId, const TriangleMesh*>, 2> twice = {
      {{RegionId{1}, &cube}, {RegionId{2}, &cube}}};
  EXPECT_EQ(weld(twice).conflicts, cube.triangles.size());
  EXPECT_EQ(weld(twice).sharedTriangles, 0U);
  const TriangleMesh apart = testing::cube(10.0, Vec3(20.0, 0.0, 0.0));
  const std::array<std::pair<RegionId, const TriangleMesh*>, 2> two = {
      {{RegionId{1}, &cube}, {RegionId{2}, &apart}}};
  EXPECT_EQ(weld(two).sharedTriangles, 0U);
  EXPECT_EQ(outerSurface(weld(two).complex).triangles.size(), 24U);
}

TEST(HeightTable, TellsBelowAsTheFormulaDoes) {
  const TriangleMesh lung = eggLung();
  HeightSurface surface = proposedFissure(Fissure::RightOblique, lungBox(lung));
  for (int i = 0; i < 12; ++i) {
    surface.knots.emplace_back(0.3 * i - 1.5, 0.2 * (i % 4));
    surface.weights.push_back(i % 2 == 0 ? 6.0 : -6.0);
  }
  const HeightTable table(surface, bounds(lung));
  std::size_t below = 0;
  for (const Vec3& p : lung.points) {
    for (const double share : {1.0, 0.7, 0.4}) {
      ASSERT_EQ(table.below(share * p), surface.height(share * p) < 0.0);
      below += table.below(share * p) ? 1U : 0U;
    }
  }
  EXPECT_GT(below, lung.points.size() / 10);
}

}  // namespace
}  // namespace pneuma
