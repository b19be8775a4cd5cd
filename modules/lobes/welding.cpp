#include "lobes/welding.h"

#include <algorithm>
#include <unordered_map>

#include "core/point_hash.h"

namespace pneuma {
namespace {

using Corners = std::array<std::uint32_t, 3>;

struct HashOfCorners {
  std::size_t operator()(const Corners& t) const {
    std::uint64_t hash = 0;
    for (const std::uint32_t v : t) hash = (hash ^ v) * 0x9E3779B97F4A7C15ULL, hash ^= hash >> 31U;
    return hash;
  }
};

/// The same triangle begins with its least corner.
Corners turned(Corners t) {
  std::ranges::rotate(t, std::ranges::min_element(t));
  return t;
}

}  // namespace

Welding weld(std::span<const std::pair<RegionId, const TriangleMesh*>> surfaces) {
  Welding welding;
  RegionComplex& complex = welding.complex;
  std::unordered_map<Vec3, std::uint32_t, PointHash> pointAt;
  std::unordered_map<Corners, std::size_t, HashOfCorners> facetOf;
  for (const auto& [region, mesh] : surfaces) {
    std::vector<std::uint32_t> index;
    index.reserve(mesh->points.size());
    for (const Vec3& p : mesh->points) {
      const auto [found, isNew] =
          pointAt.try_emplace(p, static_cast<std::uint32_t>(complex.points.size()));
      if (isNew) complex.points.push_back(p);
      index.push_back(found->second);
    }
    for (const auto& [a, b, c] : mesh->triangles) {
      const Corners corners = turned({index[a], index[b], index[c]});
      const Corners other = turned({index[a], index[c], index[b]});
      const auto facing = facetOf.find(other);
      if (facing != facetOf.end() && complex.facets[facing->second].front == OutsideRegion) {
        complex.facets[facing->second].front = region;
        ++welding.sharedTriangles;
        continue;
      }
      const auto [same, isNew] = facetOf.try_emplace(corners, complex.facets.size());
      if (!isNew) ++welding.conflicts;
      complex.facets.push_back({corners, region, OutsideRegion});
    }
  }
  return welding;
}

TriangleMesh outerSurface(const RegionComplex& complex) {
  RegionComplex joined{complex.points, {}};
  for (const Facet& facet : complex.facets) {
    if (facet.front != OutsideRegion && facet.behind != OutsideRegion) continue;
    const bool inFront = facet.behind == OutsideRegion;
    joined.facets.push_back({facet.corners, static_cast<RegionId>(inFront ? 0 : 1),
                             static_cast<RegionId>(inFront ? 1 : 0)});
  }
  return surfaceOf(joined, 1).mesh;
}

}  // namespace pneuma
