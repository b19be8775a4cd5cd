#include "lobes/patch_surface.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "core/error.h"
#include "core/parallel.h"
#include "lobes/contact_sampling.h"
#include "lobes/fissure_fit.h"
#include "lobes/sheet_rim.h"

namespace pneuma {
namespace {

constexpr std::array<std::size_t, 4> KnotCounts = {100, 200, 400, 800};
constexpr double CloseMm = 0.2;  ///< no more knots are needed
constexpr double MostMm = 2.0;
/// Exact rims of rough patches make cuts that meet themselves: on a person's left lung 1e-6
/// failed for 200 and 800 knots, 0.01 for none.
constexpr double Smoothness = 0.01;
constexpr double FoldSmoothness = 1.0;  ///< between layers that lie over each other

/// An edge of a triangle, and the corner beside it.
struct EdgeSide {
  std::array<std::uint32_t, 2> ends{};  ///< in order
  std::uint32_t opposite = 0;
};

/// The sides of all triangles, those of one edge one after the other.
std::vector<EdgeSide> sidesOf(const TriangleMesh& mesh) {
  std::vector<EdgeSide> sides;
  for (const auto& t : mesh.triangles) {
    for (std::size_t e = 0; e < 3; ++e) {
      const std::uint32_t a = t[e];
      const std::uint32_t b = t[(e + 1) % 3];
      sides.push_back({{std::min(a, b), std::max(a, b)}, t[(e + 2) % 3]});
    }
  }
  std::ranges::sort(sides, {},
                    [](const EdgeSide& side) { return std::pair(side.ends, side.opposite); });
  return sides;
}

/// Calls `f(sides)` for each edge.
template <class F>
void forEachEdge(const std::vector<EdgeSide>& sides, F&& f) {
  for (std::size_t first = 0; first < sides.size();) {
    std::size_t end = first + 1;
    while (end < sides.size() && sides[end].ends == sides[first].ends) ++end;
    f(std::span(sides).subspan(first, end - first));
    first = end;
  }
}

/// The middle of the edge over which two triangles lie upon each other most, seen along the normal.
std::optional<Vec3> widestFold(const TriangleMesh& mesh, const HeightSurface& plane) {
  std::optional<Vec3> place;
  double widest = 0.0;
  forEachEdge(sidesOf(mesh), [&](std::span<const EdgeSide> sides) {
    if (sides.size() != 2) return;
    const auto& [a, b] = sides[0].ends;
    const Vec2 from = plane.planar(mesh.points[a]);
    const Vec2 along = plane.planar(mesh.points[b]) - from;
    const auto beside = [&](const EdgeSide& side) {
      const Vec2 d = plane.planar(mesh.points[side.opposite]) - from;
      return along.x() * d.y() - along.y() * d.x();
    };
    const double one = beside(sides[0]);
    const double other = beside(sides[1]);
    const double both = std::min(std::abs(one), std::abs(other));
    if (one * other <= 0.0 || both <= widest) return;
    widest = both;
    place = (mesh.points[a] + mesh.points[b]) / 2.0;
  });
  return place;
}

/// The points that triangles use, as places to spread knots over.
FissureContact placesOf(const TriangleMesh& mesh) {
  std::vector<char> used(mesh.points.size(), 0);
  for (const auto& t : mesh.triangles) {
    for (const std::uint32_t v : t) used[v] = 1;
  }
  FissureContact places;
  for (std::size_t v = 0; v < used.size(); ++v) {
    if (used[v] != 0) places.points.push_back(mesh.points[v]);
  }
  places.areasMm2.assign(places.points.size(), 1.0);
  places.areaMm2 = static_cast<double>(places.points.size());
  return places;
}

PatchFit fitThrough(std::span<const Vec3> knots, const std::vector<Vec3>& points,
                    double smoothness = Smoothness) {
  PatchFit fit;
  fit.surface = fitFissure(knots, {.smoothness = smoothness});
  fit.knots = knots.size();
  std::vector<double> away(points.size());
  parallelFor(points.size(),
              [&](std::size_t i) { away[i] = std::abs(fit.surface.distance(points[i])); });
  for (const double mm : away) {
    fit.meanMm += mm / static_cast<double>(away.size());
    fit.largestMm = std::max(fit.largestMm, mm);
  }
  return fit;
}

}  // namespace

PatchFit fitPatch(const TriangleMesh& patch, const std::string& what) {
  if (rimOf(patch).empty()) {
    throw InvalidInput("the " + what +
                       " is closed; a fissure is an open surface that crosses the lung");
  }
  const FissureContact places = placesOf(patch);
  const std::vector<Vec3> knots =
      farthestPoints(places, std::min(KnotCounts.back(), places.points.size()));
  // Between knots too: a coarse patch has nothing else.
  std::vector<Vec3> checked = places.points;
  for (const auto& [a, b, c] : patch.triangles) {
    checked.emplace_back((patch.points[a] + patch.points[b] + patch.points[c]) / 3.0);
  }
  PatchFit fit;
  for (const std::size_t count : KnotCounts) {
    const std::size_t n = std::min(count, knots.size());
    fit = fitThrough(std::span(knots).first(n), checked);
    if (fit.largestMm <= CloseMm || n == knots.size()) break;
  }
  if (fit.largestMm <= MostMm) return fit;
  if (const auto fold = widestFold(patch, fit.surface)) {
    fit = fitThrough(std::span(knots).first(std::min(KnotCounts.front(), knots.size())), checked,
                     FoldSmoothness);
    fit.fold = fold;
    return fit;
  }
  throw InvalidInput("the " + what + " is too rough: its points lie up to " +
                     std::to_string(std::lround(fit.largestMm)) +
                     " mm from a smooth surface, 2 mm are allowed; smooth it, or give points");
}

}  // namespace pneuma
