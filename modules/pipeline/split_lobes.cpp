#include "pipeline/split_lobes.h"

#include <algorithm>
#include <cmath>

#include "core/error.h"
#include "core/units.h"
#include "geometry/mesh_topology.h"
#include "lobes/contact_sampling.h"
#include "pipeline/figure_table.h"
#include "pipeline/fissure_coverage.h"

namespace pneuma {
namespace {

/// Shares of both lungs that a lobe has in most people; outside of them somebody should look.
std::pair<double, double> usualShareOfBoth(Lobe lobe) {
  switch (lobe) {
    case Lobe::RightUpper:
      return {0.15, 0.30};
    case Lobe::RightMiddle:
      return {0.05, 0.12};
    case Lobe::RightLower:
      return {0.20, 0.35};
    case Lobe::LeftUpper:
      return {0.18, 0.32};
    default:
      return {0.15, 0.35};
  }
}

void requireFit(const LobeSurface& lung) {
  if (lung.health.fitToGrow()) return;
  std::string wrong;
  for (const std::string& complaint : complaints(lung.health)) {
    wrong += (wrong.empty() ? "" : "; ") + complaint;
  }
  throw InvalidInput("'" + lung.name + "' cannot be split: " + wrong +
                     "; mend it with 'pneuma repair'");
}

/// Handles of a closed surface, by Euler's formula.
int genusOf(const TriangleMesh& mesh, const MeshTopology& health) {
  const auto points = static_cast<std::int64_t>(mesh.points.size());
  const auto triangles = static_cast<std::int64_t>(mesh.triangles.size());
  return static_cast<int>(static_cast<std::int64_t>(health.components) -
                          (points - triangles / 2) / 2);
}

void warnOfShares(LobesOfLungs& result) {
  if (result.lungs.size() < 2) return;
  double all = 0.0;
  for (const auto& [side, volume] : result.lungMm3) all += volume;
  for (const auto& [lobe, volume] : result.lobeMm3) {
    const auto [least, most] = usualShareOfBoth(lobe);
    const double share = volume / all;
    if (share >= least && share <= most) continue;
    result.warnings.push_back("the " + std::string(longName(lobe)) + " has " +
                              fixed(100.0 * share, 1) + " % of both lungs; in most people it has " +
                              fixed(100.0 * least, 0) + " to " + fixed(100.0 * most, 0) +
                              " %. Look at its fissures");
  }
}

/// What shows of fissures in the model's CT; none without one that can show them.
std::shared_ptr<const SheetnessImage> sheetsFor(const LungModel& model, Side of,
                                                const LobeInputs& inputs,
                                                const Progress& progress) {
  if (inputs.snap) {
    if (!model.ct || !model.labels) {
      throw InvalidInput("fissures can be snapped only in a CT whose lungs were found; give one");
    }
    requireThinSlices(*model.ct);
  }
  if (!model.ct || !model.labels || !hasThinSlices(*model.ct)) return nullptr;
  const auto known = inputs.sheets.find(of);
  if (known != inputs.sheets.end()) return known->second;
  return std::make_shared<const SheetnessImage>(fissureSheets(model, of, progress));
}

/// Wanted volumes move a fissure along its normal; a sheet moved so would end inside the lung.
void requireMovable(const FissureSheets& folding, Side of) {
  for (const auto& [fissure, sheet] : folding) {
    if (side(fissure) != of) continue;
    throw InvalidInput("the surface of the " + std::string(longName(fissure)) +
                       " folds, so that it cannot be moved to wanted fractions; leave them out, or "
                       "give points");
  }
}

void splitOne(const LungModel& model, const LobeSurface& lung, const LobeInputs& inputs,
              const LobeOptions& options, LobesOfLungs& result, const Progress& progress) {
  requireFit(lung);
  const Side of = side(lung.lobe);
  const std::shared_ptr<const SheetnessImage> sheets =
      sheetsFor(model, of, inputs, progress.part(0.0, 0.2, "looking for fissures"));
  UsedFissures found = fissureSurfaces(*lung.mesh, of, inputs.given, options, result.warnings);
  if (inputs.snap) {
    result.snapped.merge(snapFissures(found, *sheets, inputs.given, options, *inputs.snap,
                                      result.warnings, progress.part(0.2, 0.4, "snapping")));
  }
  FissureSurfaces surfaces;
  for (auto& [fissure, used] : found) {
    surfaces[fissure] = used.surface;
    result.fissures[fissure] = std::move(used);
  }
  const FissureSheets folding = sheetsIn(result.fissures);
  const auto shares = inputs.shares.find(of);
  if (shares != inputs.shares.end()) {
    requireMovable(folding, of);
    surfaces = withShares(*lung.mesh, of, std::move(surfaces), shares->second, options.capSpacingMm,
                          progress.part(0.4, 0.7, "moving fissures"));
    for (const auto& [fissure, surface] : surfaces) result.fissures[fissure].surface = surface;
  }
  SplitLung split = splitLung(*lung.mesh, of, surfaces, folding, options.capSpacingMm,
                              progress.part(0.7, 0.9, "cutting along fissures"));
  for (const auto& [fissure, report] : split.reports) {
    if (report.piecesJoined == 0) continue;
    result.warnings.push_back("the " + std::string(longName(fissure)) + " had cut " +
                              std::to_string(report.piecesJoined) + " pieces off, together " +
                              fixed(millilitres(report.joinedMm3), 2) +
                              " ml; they went to the lobe around them");
  }
  if (sheets) {
    for (const Fissure fissure : fissuresOf(of)) {
      result.complete[fissure] =
          completeness(*sheets, fissurePatch(split, fissure), inputs.snap.value_or(SnapOptions{}),
                       progress.part(0.9, 1.0, "looking at fissures"));
    }
  }
  const auto whole = static_cast<RegionId>(lung.lobe);
  result.lungMm3[of] = volumeMm3(complexOf(*lung.mesh, whole), whole);
  for (const Lobe lobe : lobesOf(of)) {
    const auto region = static_cast<RegionId>(lobe);
    result.lobeMm3[lobe] = volumeMm3(split.complex, region);
    const TriangleMesh mesh = surfaceOf(split.complex, region).mesh;
    const MeshTopology health = topology(mesh);
    LobeShape& shape = result.shapes[lobe];
    shape.faults = health.faults();
    shape.pieces = health.components;
    shape.genus = genusOf(mesh, health);
    shape.areaMm2 = areaMm2(mesh);
  }
  addCoverage(result.fissures, split, inputs.given, result.warnings);
  result.lungs.push_back(std::move(split));
}

}  // namespace

LobesOfLungs splitLobes(const LungModel& model, const LobeInputs& inputs,
                        const LobeOptions& options, const Progress& progress) {
  requireValid(options);
  LobesOfLungs result;
  for (const Lobe wanted : {Lobe::RightLung, Lobe::LeftLung}) {
    const LobeSurface* lung = nullptr;
    for (const LobeSurface& surface : *model.surfaces) {
      if (surface.lobe == wanted) lung = &surface;
    }
    const Side of = side(wanted);
    if (lung == nullptr) {
      for (const auto& [fissure, given] : inputs.given) {
        if (side(fissure) != of) continue;
        throw InvalidInput("a " + std::string(longName(fissure)) + " is given, but no " +
                           std::string(longName(wanted)) + " to split");
      }
      continue;
    }
    const double from = wanted == Lobe::RightLung ? 0.0 : 0.5;
    splitOne(model, *lung, inputs, options, result,
             progress.part(from, from + 0.5, "splitting lungs"));
  }
  if (model.ct && !hasThinSlices(*model.ct)) {
    result.warnings.push_back("how much of the fissures shows is not told: the CT's slices are " +
                              fixed(model.ct->geometry.spacing.maxCoeff(), 2) +
                              " mm apart, more than " + fixed(ThickestSliceMm, 1) + " mm");
  }
  if (result.lungs.empty()) {
    throw InvalidInput(
        "there is no whole lung to split; name its surface right or left, as 'pneuma segment "
        "--surfaces' does");
  }
  warnOfShares(result);
  result.parted = partedLobes(result.lungs, inputs.accessory, options, result.warnings);
  progress.report(1.0);
  return result;
}

TriangleMesh fissurePatch(const SplitLung& lung, Fissure fissure) {
  std::vector<RegionId> above;
  RegionId below = OutsideRegion;
  for (const auto& [behind, front] : lobesBeside(fissure)) {
    below = static_cast<RegionId>(behind);
    above.push_back(static_cast<RegionId>(front));
  }
  return contactOf(lung.complex, below, above);
}

double partitionError(const LobesOfLungs& lobes, Side of) {
  double sum = 0.0;
  for (const Lobe lobe : lobesOf(of)) sum += lobes.lobeMm3.at(lobe);
  return std::abs(sum / lobes.lungMm3.at(of) - 1.0);
}

}  // namespace pneuma
