#pragma once

#include <algorithm>
#include <array>
#include <map>
#include <set>
#include <utility>

#include <gtest/gtest.h>

#include "geometry/mesh_topology.h"
#include "geometry/self_intersections.h"
#include "lobes/region_pieces.h"

namespace pneuma::testing {

/// Closed, manifold, oriented, of so many pieces, without triangles that meet.
inline void expectSound(const RegionComplex& complex, RegionId region, std::size_t pieces = 1) {
  const RegionSurface surface = surfaceOf(complex, region);
  const MeshTopology health = topology(surface.mesh);
  EXPECT_EQ(health.openEdges, 0U);
  EXPECT_EQ(health.nonManifoldEdges, 0U);
  EXPECT_EQ(health.misorientedEdges, 0U);
  EXPECT_EQ(health.nonManifoldVertices, 0U);
  EXPECT_EQ(health.duplicateTriangles, 0U);
  EXPECT_EQ(pieceCount(complex, region), pieces);
  EXPECT_GT(signedVolumeMm3(surface.mesh), 0.0);
  EXPECT_EQ(selfIntersecting(surface.mesh).pairs, 0U);
}

/// Every triangle is between two regions once, by the numbers of its points.
/// @return how many lie between each two, behind and in front
inline std::map<std::pair<RegionId, RegionId>, int> contactsIn(const RegionComplex& complex) {
  std::set<std::array<std::uint32_t, 3>> seen;
  std::map<std::pair<RegionId, RegionId>, int> contacts;
  for (const Facet& facet : complex.facets) {
    std::array<std::uint32_t, 3> corners = facet.corners;
    std::ranges::sort(corners);
    EXPECT_TRUE(seen.insert(corners).second);
    EXPECT_NE(facet.behind, facet.front);
    ++contacts[{facet.behind, facet.front}];
  }
  return contacts;
}

}  // namespace pneuma::testing
