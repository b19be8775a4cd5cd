#include "lobes/sheet_splitting.h"

#include <array>
#include <cmath>
#include <set>
#include <unordered_map>
#include <vector>

#include "core/disjoint_sets.h"
#include "core/error.h"
#include "geometry/corefinement.h"
#include "geometry/mesh_topology.h"
#include "geometry/nearest_triangle.h"
#include "geometry/self_intersections.h"
#include "geometry/surface_domain.h"
#include "lobes/detail/sentence_text.h"
#include "lobes/edge_chains.h"
#include "lobes/region_pieces.h"
#include "lobes/sheet_rim.h"

namespace pneuma {
namespace {

constexpr double LeastUpward = 0.05;  ///< of the mean normal along what is above
/// Where the sheet runs through points and edges of the region it is moved by so little, round by
/// round, that the cut is another and the fissure the same.
constexpr double MoveMm = 1e-3;
const Vec3 MoveWay(0.53, -0.31, 0.79);
constexpr int Rounds = 7;
constexpr int MostJoins = 4;

using Corners = std::array<std::uint32_t, 3>;

std::uint64_t keyOf(std::uint32_t a, std::uint32_t b) { return (std::uint64_t{a} << 32U) | b; }

/// Twice the area along the normal.
Vec3 crossOf(const std::vector<Vec3>& points, const Corners& t) {
  return (points[t[1]] - points[t[0]]).cross(points[t[2]] - points[t[0]]);
}

Vec3 middleOf(const std::vector<Vec3>& points, const Corners& t) {
  return (points[t[0]] + points[t[1]] + points[t[2]]) / 3.0;
}

enum class Outcome {
  Done,
  DoesNotCross,
  EndsInside,   ///< the sheet has a rim in the region
  DoesNotPart,  ///< one comes around it from one side to the other
  Irregular,    ///< what comes of it is not manifold, or meets itself
};

/// One try to split a region along a sheet.
class SheetCut {
 public:
  SheetCut(const RegionComplex& before, const RegionSurface& region, const SurfaceDomain& inside,
           const SplitRegion& settings)
      : before_(before), region_(region), inside_(inside), settings_(settings) {}

  Outcome cut(const TriangleMesh& sheet, const Progress& progress) {
    auto both = corefined(region_.mesh, sheet, progress);
    if (!both) return Outcome::Irregular;
    both_ = std::move(*both);
    for (const auto& [a, b] : both_.line) line_.insert(keyOf(a, b));
    if (!findCap()) return Outcome::EndsInside;
    if (cap_.empty()) return Outcome::DoesNotCross;
    if (!findSides(sheet)) return Outcome::DoesNotPart;
    assemble();
    return Outcome::Done;
  }

  RegionComplex result;

 private:
  bool isOnLine(std::uint32_t a, std::uint32_t b) const {
    return line_.contains(keyOf(std::min(a, b), std::max(a, b)));
  }

  /// Parts of the sheet between lines, those inside. False if one has a rim there.
  bool findCap() {
    const std::vector<Corners>& triangles = both_.second;
    DisjointSets parts(triangles.size());
    std::unordered_map<std::uint64_t, std::uint32_t> sideOf;
    for (std::uint32_t t = 0; t < triangles.size(); ++t) {
      for (std::size_t e = 0; e < 3; ++e) {
        sideOf[keyOf(triangles[t][e], triangles[t][(e + 1) % 3])] = t;
      }
    }
    std::vector<std::uint32_t> onRim;
    for (std::uint32_t t = 0; t < triangles.size(); ++t) {
      for (std::size_t e = 0; e < 3; ++e) {
        const std::uint32_t a = triangles[t][e];
        const std::uint32_t b = triangles[t][(e + 1) % 3];
        if (isOnLine(a, b)) continue;
        const auto other = sideOf.find(keyOf(b, a));
        if (other == sideOf.end()) {
          onRim.push_back(t);
        } else {
          parts.join(t, other->second);
        }
      }
    }
    // The middle of its largest triangle tells where a part is: nothing is farther from the line.
    std::unordered_map<std::uint32_t, std::uint32_t> largestOf;
    const auto area = [&](std::uint32_t t) { return crossOf(both_.points, triangles[t]).norm(); };
    for (std::uint32_t t = 0; t < triangles.size(); ++t) {
      const auto [largest, isNew] = largestOf.try_emplace(parts.find(t), t);
      if (area(t) > area(largest->second)) largest->second = t;
    }
    std::set<std::uint32_t> inside;
    for (const auto& [part, largest] : largestOf) {
      if (inside_.contains(middleOf(both_.points, triangles[largest]))) inside.insert(part);
    }
    for (const std::uint32_t t : onRim) {
      if (inside.contains(parts.find(t))) return false;
    }
    for (std::uint32_t t = 0; t < triangles.size(); ++t) {
      if (inside.contains(parts.find(t))) cap_.push_back(triangles[t]);
    }
    return true;
  }

  /// Which triangles of the region are below. False if the cap does not tell.
  bool findSides(const TriangleMesh& sheet) {
    const std::vector<Corners>& triangles = both_.first;
    std::set<std::uint64_t> capEdges;
    for (const Corners& t : cap_) {
      for (std::size_t e = 0; e < 3; ++e) capEdges.insert(keyOf(t[e], t[(e + 1) % 3]));
    }
    DisjointSets parts(triangles.size());
    std::unordered_map<std::uint64_t, std::uint32_t> sideOf;
    std::vector<int> seen(triangles.size(), 0);  // -1 below, 1 above
    for (std::uint32_t t = 0; t < triangles.size(); ++t) {
      for (std::size_t e = 0; e < 3; ++e) {
        const std::uint32_t a = triangles[t][e];
        const std::uint32_t b = triangles[t][(e + 1) % 3];
        sideOf[keyOf(a, b)] = t;
        // The surface of what is below has the cap's normals, so that its other triangles turn
        // against the cap's there; that of what is above turns the cap over.
        if (capEdges.contains(keyOf(b, a))) seen[t] = -1;
        if (capEdges.contains(keyOf(a, b))) seen[t] = 1;
      }
    }
    for (const auto& [edge, t] : sideOf) {
      const std::uint64_t turned = (edge << 32U) | (edge >> 32U);
      if (capEdges.contains(edge) || capEdges.contains(turned)) continue;
      const auto other = sideOf.find(turned);
      if (other != sideOf.end()) parts.join(t, other->second);
    }
    std::vector<int> sideOfPart(triangles.size(), 0);
    for (std::uint32_t t = 0; t < triangles.size(); ++t) {
      int& side = sideOfPart[parts.find(t)];
      if (seen[t] * side < 0) return false;
      if (seen[t] != 0) side = seen[t];
    }
    side_.resize(triangles.size());
    for (std::uint32_t t = 0; t < triangles.size(); ++t) side_[t] = sideOfPart[parts.find(t)];
    decideUntouched(sheet, parts);
    return true;
  }

  /// Pieces of the region that the cap does not touch go by the side of the sheet they lie on.
  void decideUntouched(const TriangleMesh& sheet, DisjointSets& parts) {
    std::unordered_map<std::uint32_t, double> votes;
    for (std::uint32_t t = 0; t < side_.size(); ++t) {
      if (side_[t] == 0) votes[parts.find(t)] = 0.0;
    }
    if (votes.empty()) return;
    const NearestTriangle nearest(sheet);
    for (std::uint32_t t = 0; t < side_.size(); ++t) {
      if (side_[t] != 0) continue;
      const Vec3 middle = middleOf(both_.points, both_.first[t]);
      const NearestTriangle::Hit hit = nearest.nearest(middle);
      const Vec3 normal = crossOf(sheet.points, sheet.triangles[hit.triangle]).normalized();
      votes[parts.find(t)] += (middle - hit.point).dot(normal);
    }
    for (std::uint32_t t = 0; t < side_.size(); ++t) {
      if (side_[t] == 0) side_[t] = votes.at(parts.find(t)) < 0.0 ? -1 : 1;
    }
  }

  /// The complex with the region's triangles as they were divided, and the cap.
  void assemble() {
    result.points = before_.points;
    std::vector<std::uint32_t> indexOf(both_.points.size());
    std::vector<char> known(both_.points.size(), 0);
    for (std::size_t t = 0; t < region_.mesh.triangles.size(); ++t) {
      for (std::size_t corner = 0; corner < 3; ++corner) {
        const std::uint32_t v = region_.mesh.triangles[t][corner];
        // As surfaceOf() turns them.
        const bool turned = before_.facets[region_.facetOf[t]].front == settings_.region;
        indexOf[v] = before_.facets[region_.facetOf[t]].corners[turned ? (3 - corner) % 3 : corner];
        known[v] = 1;
      }
    }
    const auto indexed = [&](const Corners& t) {
      Corners corners = t;
      for (std::uint32_t& v : corners) {
        if (known[v] == 0) {
          known[v] = 1;
          indexOf[v] = static_cast<std::uint32_t>(result.points.size());
          result.points.push_back(both_.points[v]);
        }
        v = indexOf[v];
      }
      return corners;
    };
    std::vector<std::vector<Corners>> partsOf(region_.mesh.triangles.size());
    std::vector<Facet> parts;
    for (std::uint32_t t = 0; t < both_.first.size(); ++t) {
      const Corners corners = indexed(both_.first[t]);
      partsOf[both_.parentOf[t]].push_back(corners);
      const Facet& parent = before_.facets[region_.facetOf[both_.parentOf[t]]];
      const RegionId side = side_[t] < 0 ? settings_.below : settings_.above;
      if (parent.front == settings_.region) {
        parts.push_back({{corners[0], corners[2], corners[1]}, parent.behind, side});
      } else {
        parts.push_back({corners, side, parent.front});
      }
    }
    EdgeChains chains;
    for (std::size_t t = 0; t < partsOf.size(); ++t) {
      if (partsOf[t].size() > 1) chains.add(indexed(region_.mesh.triangles[t]), partsOf[t]);
    }
    // Neighbours of the region that share a divided edge with it.
    for (const Facet& facet : before_.facets) {
      if (facet.borders(settings_.region)) continue;
      for (const Corners& part : dividedAlong(chains, facet.corners)) {
        result.facets.push_back({part, facet.behind, facet.front});
      }
    }
    result.facets.insert(result.facets.end(), parts.begin(), parts.end());
    for (const Corners& t : cap_) {
      result.facets.push_back({indexed(t), settings_.below, settings_.above});
    }
  }

  const RegionComplex& before_;
  const RegionSurface& region_;
  const SurfaceDomain& inside_;
  const SplitRegion& settings_;
  Corefinement both_;
  std::set<std::uint64_t> line_;
  std::vector<Corners> cap_;
  std::vector<int> side_;  ///< of the region's triangles: -1 below, 1 above
};

/// Gives pieces on the wrong side to the other part; the cap between them vanishes.
void joinStrays(RegionComplex& complex, RegionId part, RegionId other, SplitReport& report) {
  for (int join = 0; join < MostJoins; ++join) {
    const StrayPieces strays = strayPieces(complex, part, other);
    if (strays.count == 0) return;
    report.piecesJoined += strays.count;
    report.joinedMm3 += strays.volumeMm3;
    for (const std::uint32_t f : strays.facets) {
      Facet& facet = complex.facets[f];
      (facet.behind == part ? facet.behind : facet.front) = other;
    }
    std::erase_if(complex.facets, [](const Facet& f) { return f.behind == f.front; });
  }
}

/// Rounding may have brought triangles together that exact numbers keep apart.
bool isSound(const RegionComplex& complex, const SplitRegion& settings, const Progress& progress) {
  TriangleMesh both{complex.points, {}};
  for (const RegionId part : {settings.below, settings.above}) {
    const TriangleMesh mesh = surfaceOf(complex, part).mesh;
    if (mesh.triangles.empty()) return false;
    const MeshTopology health = topology(mesh);
    if (health.faults() + health.duplicateTriangles > 0) return false;
  }
  for (const Facet& facet : complex.facets) {
    if (!facet.borders(settings.below) && !facet.borders(settings.above)) continue;
    if (crossOf(complex.points, facet.corners).norm() == 0.0) return false;
    both.triangles.push_back(facet.corners);
  }
  return selfIntersecting(both, progress).pairs == 0;
}

[[noreturn]] void refuse(Outcome outcome, const std::string& what) {
  switch (outcome) {
    case Outcome::DoesNotCross:
      throw InvalidInput("the " + what +
                         " does not cross the lung; check that its surface belongs to this lung "
                         "and lies in the same frame (LPS, mm)");
    case Outcome::EndsInside:
      throw InvalidInput("the surface of the " + what +
                         " ends inside the lung although it was extended: its edge turns away from "
                         "the wall; extend it beyond the wall");
    case Outcome::DoesNotPart:
      throw InvalidInput("the surface of the " + what +
                         " does not part the lung: one comes around it from one side to the other, "
                         "through a handle of the lung or a hole in the surface");
    default:
      throw InvalidInput("the " + what +
                         " could not be cut through the lung without triangles that meet each "
                         "other; smooth its surface near the lung's wall, or repair the lung's");
  }
}

}  // namespace

FissureSheet fissureSheet(TriangleMesh mesh, const Vec3& above, double extendMm,
                          const std::string& what) {
  const MeshTopology health = topology(mesh);
  if (health.nonManifoldEdges + health.nonManifoldVertices > 0) {
    throw InvalidInput("the " + what +
                       " is not one sheet: more than two of its triangles meet at " +
                       std::to_string(health.nonManifoldEdges + health.nonManifoldVertices) +
                       " places; take the triangles that stand off away");
  }
  if (health.misorientedEdges > 0) {
    throw InvalidInput("the triangles of the " + what +
                       " are not turned the same way: " + std::to_string(health.misorientedEdges) +
                       " edges lie between two that are not; make its normals consistent");
  }
  if (const SelfIntersecting meeting = selfIntersecting(mesh); meeting.pairs > 0) {
    const Corners& t = mesh.triangles[meeting.triangles.front()];
    throw InvalidInput("the " + what + " meets itself at " + placeText(middleOf(mesh.points, t)) +
                       "; smooth it there");
  }
  Vec3 normal = Vec3::Zero();
  for (const Corners& t : mesh.triangles) normal += crossOf(mesh.points, t);
  if (above.norm() > 0.0) {
    const double upward = normal.normalized().dot(above.normalized());
    if (!(std::abs(upward) >= LeastUpward)) {
      throw InvalidInput("the " + what +
                         " stands so that neither side of it is the upper and front one");
    }
    if (upward < 0.0) {
      for (Corners& t : mesh.triangles) std::swap(t[1], t[2]);
    }
  }
  return {std::move(mesh), extendMm};
}

SplitReport splitRegion(RegionComplex& complex, const FissureSheet& sheet,
                        const SplitRegion& settings, const std::string& what,
                        const Progress& progress) {
  const RegionSurface region = surfaceOf(complex, settings.region);
  const SurfaceDomain inside(region.mesh);
  requireReach(deepestRim(sheet.mesh, inside), sheet.extendMm, "surface of the " + what, "lung");
  const TriangleMesh extended = extendedThrough(sheet.mesh, inside);
  SplitReport report;
  Outcome outcome = Outcome::Irregular;
  for (int round = 0; round < Rounds; ++round) {
    progress.report(static_cast<double>(round) / Rounds);
    TriangleMesh moved = extended;
    for (Vec3& p : moved.points) p += round * MoveMm * MoveWay;
    report = {};
    report.rounds = round + 1;
    SheetCut cut(complex, region, inside, settings);
    outcome = cut.cut(moved, progress);
    if (outcome != Outcome::Done) continue;
    joinStrays(cut.result, settings.below, settings.above, report);
    joinStrays(cut.result, settings.above, settings.below, report);
    if (!isSound(cut.result, settings, progress)) {
      outcome = Outcome::Irregular;
      continue;
    }
    report.contactMm2 = areaMm2(contactOf(cut.result, settings.below, settings.above));
    complex = std::move(cut.result);
    return report;
  }
  refuse(outcome, what);
}

}  // namespace pneuma
