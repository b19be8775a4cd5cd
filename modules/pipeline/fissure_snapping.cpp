#include "pipeline/fissure_snapping.h"

#include <algorithm>
#include <cmath>

#include "core/error.h"
#include "core/parallel.h"
#include "lobes/fissure_fit.h"
#include "pipeline/detail/sheet_sweep.h"
#include "pipeline/figure_table.h"
#include "segmentation/lung_labels.h"
#include "segmentation/sheet_peak.h"

namespace pneuma {
namespace {

constexpr double GridMm = 3.0;
constexpr double FirstAngleDeg = 45.0;  ///< a proposal may be turned against the fissure
constexpr double LaterReachMm = 10.0;   ///< once parts of it have been found
constexpr double LastReachMm = 3.0;
constexpr int Rounds = 5;
constexpr std::size_t LeastTogether = 25;  ///< places of the grid, 2 cm^2
constexpr std::size_t MostKnots = 200;     ///< every later height costs this many logarithms
constexpr double UnseenWeight = 0.001;     ///< of places without a sheet
constexpr double GivenWeight = 5.0;        ///< of points that a person set
constexpr double Smoothness = 0.01;
constexpr double BesideObliqueMm = 4.0;  ///< nearer to it a sheet is the oblique fissure itself
constexpr double CloseMm = 1.0;          ///< to a sheet, to lie on it
constexpr double LeastShare = 0.05;      ///< of a fissure, to be believed
constexpr double SamePlaceShare = 0.5;   ///< of the boxes of lung and label together

SheetSearch searchOf(const SnapOptions& options, double reachMm) {
  return {reachMm, options.angleDeg, options.coherenceMm, options.strength};
}

/// What a fissure may be looked for in.
struct Surroundings {
  SheetSampler sampler;
  Box3 box;
  FissureRegion region;
};

double shareOnSheet(const HeightSurface& surface, const Surroundings& around,
                    const SnapOptions& options) {
  const SurfaceGrid grid = gridUpon(surface, around.box, GridMm, 0.0, around.region);
  const SheetSearch search = searchOf(options, CloseMm);
  std::vector<std::uint8_t> on(grid.places.size(), 0);
  parallelFor(on.size(), [&](std::size_t i) {
    if (grid.inside[i] == 0) return;
    on[i] = coherentSheet(around.sampler, grid.places[i], grid.normals[i], search) ? 1 : 0;
  });
  const auto inside = static_cast<double>(std::ranges::count(grid.inside, 1));
  return static_cast<double>(std::ranges::count(on, 1)) / std::max(inside, 1.0);
}

/// A surface through the places of a grid after a sweep, thinned evenly, and through given points.
HeightSurface surfaceThrough(const SurfaceGrid& grid, const Sweep& sweep,
                             const std::vector<Vec3>& given) {
  const auto inside = static_cast<std::size_t>(std::ranges::count(grid.inside, 1));
  int every = 1;
  while (inside / static_cast<std::size_t>(every * every) > MostKnots) ++every;
  std::vector<Vec3> points = given;
  std::vector<double> weights(given.size(), GivenWeight);
  for (int row = every / 2; row < grid.height; row += every) {
    for (int column = every / 2; column < grid.width; column += every) {
      const std::size_t i = grid.at(column, row);
      if (grid.inside[i] == 0) continue;
      points.push_back(grid.places[i] + sweep.offsetMm[i] * grid.normals[i]);
      weights.push_back(sweep.onSheet[i] != 0 ? 1.0 : UnseenWeight);
    }
  }
  return fitFissure(points, {.smoothness = Smoothness}, weights);
}

/// The surface of a sheet near a surface; nothing where there is none.
std::optional<HeightSurface> sheetNear(const HeightSurface& surface, const Surroundings& around,
                                       const std::vector<Vec3>& given, const SnapOptions& options,
                                       const Progress& progress) {
  // Over its own best plane first: a proposal is a height along the body, and a grid would be
  // stretched where it is steep.
  SurfaceGrid grid = gridUpon(surface, around.box, GridMm, 0.0, around.region);
  if (std::ranges::count(grid.inside, 1) < static_cast<std::ptrdiff_t>(LeastTogether)) return {};
  Sweep sweep{std::vector<double>(grid.places.size(), 0.0),
              std::vector<std::uint8_t>(grid.places.size(), 1)};
  HeightSurface current = surfaceThrough(grid, sweep, given);
  for (int round = 0; round < Rounds; ++round) {
    progress.report(static_cast<double>(round) / Rounds);
    const double limit = round == 0           ? options.surfaceMm
                         : round + 1 < Rounds ? LaterReachMm
                                              : LastReachMm;
    SheetSearch search = searchOf(options, std::min(limit, options.surfaceMm));
    if (round == 0) search.angleDeg = std::max(search.angleDeg, FirstAngleDeg);
    grid = gridUpon(current, around.box, GridMm, search.reachMm, around.region);
    sweep = sweepForSheet(around.sampler, grid, search, LeastTogether, progress);
    if (std::ranges::count(sweep.onSheet, 1) == 0) return {};
    current = surfaceThrough(grid, sweep, given);
  }
  return current;
}

/// The same fissure through points that moved.
void refit(UsedFissure& used, const std::vector<Vec3>& points, const GivenFissure& given,
           const LobeOptions& options) {
  const FissureFitOptions fit{.smoothness = options.smoothness};
  used.surface = fitFissure(points, fit, given.weights);
  used.leftOutMm = leaveOneOut(points, fit);
}

void updateMean(UsedFissure& used, const std::vector<Vec3>& points) {
  used.meanMm = 0.0;
  for (const Vec3& p : points) {
    used.meanMm += std::abs(used.surface.distance(p)) / static_cast<double>(points.size());
  }
}

std::string percent(double share) { return fixed(100.0 * share, 0) + " %"; }

FissureSnapping snapOne(Fissure fissure, UsedFissure& used, const Surroundings& around,
                        const SheetnessImage& sheets, const GivenFissure& given,
                        const LobeOptions& lobeOptions, const SnapOptions& options,
                        std::vector<std::string>& warnings, const Progress& progress) {
  UsedFissure moved = used;
  FissureSnapping result;
  result.points = snapPoints(sheets, used.surface, given.points, options);
  const bool byPoints = used.source == FissureSource::Points;
  if (byPoints) {
    refit(moved, result.points.points, given, lobeOptions);
  } else if (const auto found =
                 sheetNear(used.surface, around, result.points.points, options, progress)) {
    moved.surface = *found;
  }
  result.shareBefore = shareOnSheet(used.surface, around, options);
  result.shareAfter = shareOnSheet(moved.surface, around, options);
  const bool accepted =
      byPoints ? result.shareAfter >= result.shareBefore
               : result.shareAfter > result.shareBefore && result.shareAfter >= LeastShare;
  const std::string name(longName(fissure));
  if (accepted) {
    if (!given.points.empty()) updateMean(moved, result.points.points);
    used = std::move(moved);
  } else {
    if (given.points.empty()) {
      warnings.push_back("the " + name + " stays where it was: it would lie on what shows in " +
                         percent(result.shareAfter) + " of its area, before in " +
                         percent(result.shareBefore) + "; set points upon it");
    }
    result.shareAfter = result.shareBefore;
    result.points = {given.points, std::vector<std::uint8_t>(given.points.size(), 0)};
  }
  const auto unsnapped = std::ranges::count(result.points.onSheet, 0);
  if (unsnapped > 0) {
    warnings.push_back(std::to_string(unsnapped) + " of " + std::to_string(given.points.size()) +
                       " points of the " + name + " have no fissure that shows within " +
                       fixed(options.pointsMm, 1) + " mm; they stay where they are");
  }
  return result;
}

}  // namespace

bool hasThinSlices(const ImageGeometry& geometry) {
  return geometry.spacing.maxCoeff() <= ThickestSliceMm + 1e-6;
}

void requireThinSlices(const CtImage& ct) {
  if (hasThinSlices(ct)) return;
  throw Unsupported("the CT's slices are " + fixed(ct.geometry.spacing.maxCoeff(), 2) +
                    " mm apart; fissures show only up to " + fixed(ThickestSliceMm, 1) +
                    " mm: take a thinner series, or set points by eye and do not snap");
}

SheetnessImage fissureSheets(const LungModel& model, Side side, const Progress& progress) {
  requireThinSlices(*model.ct);
  const Lobe lung = side == Side::Right ? Lobe::RightLung : Lobe::LeftLung;
  SheetnessImage sheets =
      fissureSheetness(*model.ct, *model.labels, static_cast<std::uint8_t>(lung), progress);
  for (const LobeSurface& surface : *model.surfaces) {
    if (surface.lobe != lung) continue;
    const Box3 ofSurface = bounds(*surface.mesh);
    const Box3 ofLabel = sheets.geometry.bounds();
    const Box3 both = ofSurface.intersection(ofLabel);
    if (!both.isEmpty() && both.volume() >= SamePlaceShare * ofSurface.merged(ofLabel).volume()) {
      continue;
    }
    throw InvalidInput("the " + std::string(longName(lung)) + " of the CT lies elsewhere than '" +
                       surface.name + "'; both must be of one person and one scan");
  }
  return sheets;
}

SnappedPoints snapPoints(const SheetnessImage& sheets, const HeightSurface& surface,
                         const std::vector<Vec3>& points, const SnapOptions& options) {
  requireValid(options);
  const SheetSampler sampler(sheets);
  const SheetSearch search = searchOf(options, options.pointsMm);
  SnappedPoints snapped{points, std::vector<std::uint8_t>(points.size(), 0)};
  for (std::size_t i = 0; i < points.size(); ++i) {
    const Vec3 normal = surface.normalAt(surface.planar(points[i]));
    const std::optional<double> away = coherentSheet(sampler, points[i], normal, search);
    if (!away) continue;
    snapped.points[i] += *away * normal;
    snapped.onSheet[i] = 1;
  }
  return snapped;
}

FissureSnappings snapFissures(UsedFissures& fissures, const SheetnessImage& sheets,
                              const GivenFissures& given, const LobeOptions& lobeOptions,
                              const SnapOptions& options, std::vector<std::string>& warnings,
                              const Progress& progress) {
  requireValid(options);
  FissureSnappings results;
  std::size_t done = 0;
  for (auto& [fissure, used] : fissures) {
    if (used.sheet) {
      warnings.push_back("the surface of the " + std::string(longName(fissure)) +
                         " folds; it is not snapped");
      continue;
    }
    Surroundings around{SheetSampler(sheets), sheets.geometry.bounds(), {}};
    const auto oblique = fissures.find(Fissure::RightOblique);
    const bool inFront = fissure == Fissure::RightHorizontal && oblique != fissures.end();
    around.region = [&, inFront](const Vec3& p) {
      return around.sampler.isMeasured(p) &&
             (!inFront || oblique->second.surface.distance(p) > BesideObliqueMm);
    };
    const auto set = given.find(fissure);
    const auto count = static_cast<double>(fissures.size());
    results[fissure] =
        snapOne(fissure, used, around, sheets, set == given.end() ? GivenFissure{} : set->second,
                lobeOptions, options, warnings,
                progress.part(static_cast<double>(done) / count,
                              static_cast<double>(done + 1) / count, "snapping fissures"));
    ++done;
  }
  return results;
}

}  // namespace pneuma
