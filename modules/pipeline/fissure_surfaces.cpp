#include "pipeline/fissure_surfaces.h"

#include <cmath>
#include <numeric>

#include "core/error.h"
#include "lobes/fissure_fit.h"
#include "pipeline/figure_table.h"

namespace pneuma {
namespace {

constexpr std::size_t PointsOfTheirOwn = 6;  ///< from which the proposal does harm
constexpr double FarMm = 30.0;               ///< beyond a lung's box points are another's
constexpr double SuspectMm = 8.0;
constexpr double SuspectTimes = 3.0;  ///< the mean of the others

std::string boxText(const Box3& box) {
  const auto axis = [&](int a) { return fixed(box.min()[a], 0) + " to " + fixed(box.max()[a], 0); };
  return axis(0) + ", " + axis(1) + ", " + axis(2) + " mm";
}

void requireNear(const GivenFissure& set, const Box3& box, Fissure fissure) {
  Box3 wide = box;
  wide.min().array() -= FarMm;
  wide.max().array() += FarMm;
  Box3 ofPoints;
  bool outside = false;
  for (const Vec3& p : set.points) {
    ofPoints.extend(p);
    outside = outside || !wide.contains(p);
  }
  if (!outside) return;
  throw InvalidInput("points of the " + std::string(longName(fissure)) +
                     " lie far from the lung: they take " + boxText(ofPoints) + ", the lung " +
                     boxText(box) + "; check that both are in LPS and mm, and of one person");
}

/// Says which points stand out, for people to look at; none is dropped.
void warnOfSuspects(const UsedFissure& used, Fissure fissure, std::vector<std::string>& warnings) {
  for (const std::size_t i : suspects(used)) {
    warnings.push_back("point " + std::to_string(i + 1) + " of the " +
                       std::string(longName(fissure)) + " lies " + fixed(used.leftOutMm[i], 1) +
                       " mm from where the others put it; look at it");
  }
}

HeightSurface surfaceOf(const FissurePlane& plane) {
  HeightSurface surface;
  surface.centre = plane.point;
  const Vec3 normal = plane.normal.normalized();
  // Any two axes across the normal do; the least of its components gives a steady choice.
  Eigen::Index least = 0;
  normal.cwiseAbs().minCoeff(&least);
  const Vec3 u = Vec3::Unit(least).cross(normal).normalized();
  surface.axes = {u, normal.cross(u), normal};
  return surface;
}

UsedFissure usedFissure(Fissure fissure, const LungExtent& lung, const GivenFissures& all,
                        const LobeOptions& options, std::vector<std::string>& warnings) {
  UsedFissure used;
  const auto found = all.find(fissure);
  if (found != all.end() && found->second.plane) {
    used.source = FissureSource::Plane;
    used.surface = surfaceOf(*found->second.plane);
    return used;
  }
  used.surface = proposedFissure(fissure, lung.box);
  if (found == all.end()) return used;
  const GivenFissure& given = found->second;
  requireNear(given, lung.bounds, fissure);
  const FissureFitOptions fit{.smoothness = options.smoothness};
  const bool alone = given.points.size() >= PointsOfTheirOwn;
  used.source = alone ? FissureSource::Points : FissureSource::BentProposal;
  used.surface = alone ? fitFissure(given.points, fit, given.weights)
                       : bentThrough(used.surface, given.points, fit, given.weights);
  used.points = given.points.size();
  if (alone) used.leftOutMm = leaveOneOut(given.points, fit);
  for (const Vec3& p : given.points) {
    used.meanMm += std::abs(used.surface.distance(p)) / static_cast<double>(used.points);
  }
  warnOfSuspects(used, fissure, warnings);
  return used;
}

}  // namespace

std::vector<std::size_t> suspects(const UsedFissure& used) {
  std::vector<std::size_t> suspects;
  const double sum = std::accumulate(used.leftOutMm.begin(), used.leftOutMm.end(), 0.0);
  for (std::size_t i = 0; i < used.leftOutMm.size(); ++i) {
    const double others =
        (sum - used.leftOutMm[i]) / static_cast<double>(used.leftOutMm.size() - 1);
    if (used.leftOutMm[i] < SuspectMm || used.leftOutMm[i] < SuspectTimes * others) continue;
    suspects.push_back(i);
  }
  return suspects;
}

LungExtent extentOf(const TriangleMesh& lung) { return {bounds(lung), lungBox(lung)}; }

UsedFissures fissureSurfaces(const TriangleMesh& lung, Side side, const GivenFissures& given,
                             const LobeOptions& options, std::vector<std::string>& warnings) {
  return fissureSurfaces(extentOf(lung), side, given, options, warnings);
}

UsedFissures fissureSurfaces(const LungExtent& lung, Side side, const GivenFissures& given,
                             const LobeOptions& options, std::vector<std::string>& warnings) {
  UsedFissures used;
  for (const Fissure fissure : fissuresOf(side)) {
    used[fissure] = usedFissure(fissure, lung, given, options, warnings);
  }
  return used;
}

}  // namespace pneuma
