#include "pipeline/fissure_surfaces.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <optional>
#include <span>

#include "core/error.h"
#include "geometry/nearest_triangle.h"
#include "geometry/surface_domain.h"
#include "lobes/fissure_fit.h"
#include "lobes/patch_surface.h"
#include "lobes/sheet_rim.h"
#include "pipeline/figure_table.h"

namespace pneuma {
namespace {

constexpr std::size_t PointsOfTheirOwn = 6;  ///< from which the proposal does harm
constexpr double FarMm = 30.0;               ///< beyond a lung's box points are another's
constexpr double SuspectMm = 8.0;
constexpr double LeastUpward = 0.05;  ///< of a plane's normal along what is above
constexpr double SuspectTimes = 3.0;  ///< the mean of the others

std::string boxText(const Box3& box) {
  const auto axis = [&](int a) { return fixed(box.min()[a], 0) + " to " + fixed(box.max()[a], 0); };
  return axis(0) + ", " + axis(1) + ", " + axis(2) + " mm";
}

/// Where a fissure is to lie.
struct FissurePlace {
  const TriangleMesh& region;
  Box3 box;                ///< of the region
  std::string regionName;  ///< "lung", "lobe"
  std::string what;        ///< the fissure's name in sentences
  std::optional<HeightSurface> proposal;
  HeightAboveFloor floor;  ///< over the fissure that ends this one below; may be empty
};

void requireNear(std::span<const Vec3> points, const FissurePlace& place) {
  if (points.size() < 3) {
    throw InvalidInput("the " + place.what + " needs three points at least; there are " +
                       std::to_string(points.size()));
  }
  const Box3& box = place.box;
  Box3 wide = box;
  wide.min().array() -= FarMm;
  wide.max().array() += FarMm;
  Box3 ofPoints;
  bool outside = false;
  for (const Vec3& p : points) {
    ofPoints.extend(p);
    outside = outside || !wide.contains(p);
  }
  if (!outside) return;
  throw InvalidInput("points of the " + place.what + " lie far from the " + place.regionName +
                     ": they take " + boxText(ofPoints) + ", the " + place.regionName + " " +
                     boxText(box) + "; check that both are in LPS and mm, and of one person");
}

/// Says which points stand out, for people to look at; none is dropped.
void warnOfSuspects(const UsedFissure& used, const std::string& what,
                    std::vector<std::string>& warnings) {
  for (const std::size_t i : suspects(used)) {
    warnings.push_back("point " + std::to_string(i + 1) + " of the " + what + " lies " +
                       fixed(used.leftOutMm[i], 1) +
                       " mm from where the others put it; look at it");
  }
}

HeightSurface surfaceOf(const FissurePlane& plane, const FissurePlace& place) {
  HeightSurface surface;
  surface.centre = plane.point;
  Vec3 normal = plane.normal.normalized();
  const double upward = normal.dot(AboveFissures.normalized());
  // Lobes are above or below their fissures; what an accessory one parts may be side by side.
  if (std::abs(upward) < LeastUpward && place.proposal) {
    throw InvalidInput("the plane of the " + place.what +
                       " stands so that neither side of it is the upper and front one; turn it");
  }
  if (upward < 0.0) normal = -normal;
  // Any two axes across the normal do; the least of its components gives a steady choice.
  Eigen::Index least = 0;
  normal.cwiseAbs().minCoeff(&least);
  const Vec3 u = Vec3::Unit(least).cross(normal).normalized();
  surface.axes = {u, normal.cross(u), normal};
  return surface;
}

HeightSurface surfaceOf(const FissureEquation& equation) {
  HeightSurface surface;  // z over x and y, as the equation has it
  surface.centre = equation.origin;
  surface.quadratic = equation.coefficients;
  return surface;
}

/// How far points lie over a fissure, by the triangles of one that folds.
HeightAboveFloor heightOver(const UsedFissure& used) {
  if (!used.sheet) return [&used](const Vec3& p) { return used.surface.distance(p); };
  const auto nearest = std::make_shared<const NearestTriangle>(used.sheet->mesh);
  return [&used, nearest](const Vec3& p) {
    const NearestTriangle::Hit hit = nearest->nearest(p);
    const auto& [a, b, c] = used.sheet->mesh.triangles[hit.triangle];
    const std::vector<Vec3>& points = used.sheet->mesh.points;
    const Vec3 normal = (points[b] - points[a]).cross(points[c] - points[a]);
    const Vec3 away = p - hit.point;
    return away.dot(normal) < 0.0 ? -away.norm() : away.norm();
  };
}

UsedFissure usedPatch(const FissurePatch& patch, const FissurePlace& place, double extendMm,
                      std::vector<std::string>& warnings) {
  warnings.insert(warnings.end(), patch.notes.begin(), patch.notes.end());
  requireNear(patch.mesh->points, place);
  const std::string what = "surface of the " + place.what;
  const PatchFit fit = fitPatch(*patch.mesh, what);
  UsedFissure used;
  used.source = fit.fold ? FissureSource::FoldingSurface : FissureSource::Surface;
  used.surface = fit.surface;
  if (fit.fold) {
    // How far it reaches is asked where the region that it parts is known exactly: splitRegion().
    const Vec3 above = place.proposal ? AboveFissures : Vec3::Zero();
    used.sheet =
        std::make_shared<const FissureSheet>(fissureSheet(*patch.mesh, above, extendMm, what));
  } else {
    requireReach(deepestRim(*patch.mesh, SurfaceDomain(place.region), place.floor), extendMm, what,
                 place.regionName);
  }
  used.points = fit.fold ? patch.mesh->points.size() : fit.knots;
  if (fit.fold) return used;  // it is cut along as it is
  used.meanMm = fit.meanMm;
  used.largestMm = fit.largestMm;
  return used;
}

UsedFissure usedPoints(const GivenFissure& given, const FissurePlace& place,
                       const LobeOptions& options, std::vector<std::string>& warnings) {
  requireNear(given.points, place);
  const FissureFitOptions fit{.smoothness = options.smoothness};
  const bool many = given.points.size() >= PointsOfTheirOwn;
  const bool alone = many || !place.proposal;
  UsedFissure used;
  used.source = alone ? FissureSource::Points : FissureSource::BentProposal;
  used.surface = alone ? fitFissure(given.points, fit, given.weights)
                       : bentThrough(*place.proposal, given.points, fit, given.weights);
  used.points = given.points.size();
  if (many) used.leftOutMm = leaveOneOut(given.points, fit);
  for (const Vec3& p : given.points) {
    const double away = std::abs(used.surface.distance(p));
    used.meanMm += away / static_cast<double>(used.points);
    used.largestMm = std::max(used.largestMm, away);
  }
  warnOfSuspects(used, place.what, warnings);
  return used;
}

UsedFissure usedFissure(const GivenFissure& given, const FissurePlace& place,
                        const LobeOptions& options, std::vector<std::string>& warnings) {
  if (given.patch) return usedPatch(*given.patch, place, options.extendMm, warnings);
  if (!given.plane && !given.equation) return usedPoints(given, place, options, warnings);
  UsedFissure used;
  used.source = given.plane ? FissureSource::Plane : FissureSource::Equation;
  used.surface = given.plane ? surfaceOf(*given.plane, place) : surfaceOf(*given.equation);
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

FissureSheets sheetsIn(const UsedFissures& used) {
  FissureSheets sheets;
  for (const auto& [fissure, one] : used) {
    if (one.sheet) sheets[fissure] = one.sheet;
  }
  return sheets;
}

LungExtent extentOf(const TriangleMesh& lung) { return {&lung, bounds(lung), lungBox(lung)}; }

UsedFissures fissureSurfaces(const TriangleMesh& lung, Side side, const GivenFissures& given,
                             const LobeOptions& options, std::vector<std::string>& warnings) {
  return fissureSurfaces(extentOf(lung), side, given, options, warnings);
}

UsedFissures fissureSurfaces(const LungExtent& lung, Side side, const GivenFissures& given,
                             const LobeOptions& options, std::vector<std::string>& warnings) {
  UsedFissures used;
  for (const Fissure fissure : fissuresOf(side)) {
    // The horizontal fissure ends at the oblique one, which comes first.
    const HeightAboveFloor floor =
        used.empty() ? HeightAboveFloor{} : heightOver(used.begin()->second);
    const FissurePlace place{*lung.mesh,
                             lung.bounds,
                             "lung",
                             std::string(longName(fissure)),
                             proposedFissure(fissure, lung.box),
                             floor};
    const auto found = given.find(fissure);
    if (found != given.end()) {
      used[fissure] = usedFissure(found->second, place, options, warnings);
    } else {
      used[fissure].surface = *place.proposal;
    }
  }
  return used;
}

UsedFissure accessorySurface(const AccessoryFissure& fissure, const TriangleMesh& lobe,
                             const LobeOptions& options, std::vector<std::string>& warnings) {
  const FissurePlace place{lobe, bounds(lobe), "lobe", "accessory fissure " + fissure.name, {}, {}};
  return usedFissure(fissure.fissure, place, options, warnings);
}

}  // namespace pneuma
