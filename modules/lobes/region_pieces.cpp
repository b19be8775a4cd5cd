#include "lobes/region_pieces.h"

#include <map>

#include "core/disjoint_sets.h"

namespace pneuma {
namespace {

/// Joins the points of facets for which `f(facet)` is true.
template <class F>
DisjointSets joined(const RegionComplex& complex, F&& f) {
  DisjointSets sets(complex.points.size());
  for (const Facet& facet : complex.facets) {
    if (!f(facet)) continue;
    sets.join(facet.corners[0], facet.corners[1]);
    sets.join(facet.corners[0], facet.corners[2]);
  }
  return sets;
}

/// A piece's volume from one of its own points, by the point that stands for it.
std::map<std::uint32_t, double> volumesOf(const RegionComplex& complex, RegionId region,
                                          DisjointSets& pieces) {
  std::map<std::uint32_t, double> volumes;
  for (const Facet& facet : complex.facets) {
    if (!facet.borders(region)) continue;
    const std::uint32_t piece = pieces.find(facet.corners[0]);
    const Vec3& origin = complex.points[piece];
    const Vec3 a = complex.points[facet.corners[0]] - origin;
    const Vec3 b = complex.points[facet.corners[1]] - origin;
    const Vec3 c = complex.points[facet.corners[2]] - origin;
    volumes[piece] += (facet.behind == region ? 1.0 : -1.0) * a.dot(b.cross(c)) / 6.0;
  }
  return volumes;
}

}  // namespace

std::size_t pieceCount(const RegionComplex& complex, RegionId region) {
  DisjointSets pieces = joined(complex, [&](const Facet& f) { return f.borders(region); });
  return volumesOf(complex, region, pieces).size();
}

StrayPieces strayPieces(const RegionComplex& complex, RegionId part, RegionId other) {
  DisjointSets pieces = joined(complex, [&](const Facet& f) { return f.borders(part); });
  DisjointSets bodies =
      joined(complex, [&](const Facet& f) { return f.borders(part) || f.borders(other); });
  const auto volumes = volumesOf(complex, part, pieces);
  std::map<std::uint32_t, std::uint32_t> largestOf;  // piece of each body
  for (const auto& [piece, volume] : volumes) {
    const auto [largest, isNew] = largestOf.try_emplace(bodies.find(piece), piece);
    if (volume > volumes.at(largest->second)) largest->second = piece;
  }
  StrayPieces strays;
  strays.count = volumes.size() - largestOf.size();
  if (strays.count == 0) return strays;
  const auto isStray = [&](std::uint32_t piece) {
    return largestOf.at(bodies.find(piece)) != piece;
  };
  for (const auto& [piece, volume] : volumes) {
    if (isStray(piece)) strays.volumeMm3 += volume;
  }
  for (std::uint32_t f = 0; f < complex.facets.size(); ++f) {
    const Facet& facet = complex.facets[f];
    if (facet.borders(part) && isStray(pieces.find(facet.corners[0]))) strays.facets.push_back(f);
  }
  return strays;
}

}  // namespace pneuma
