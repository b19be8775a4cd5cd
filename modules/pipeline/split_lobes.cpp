#include "pipeline/split_lobes.h"

#include <algorithm>
#include <cmath>

#include "core/error.h"
#include "core/units.h"
#include "geometry/mesh_topology.h"
#include "pipeline/figure_table.h"
#include "pipeline/report.h"

namespace pneuma {
namespace {

constexpr double MostPartitionError = 1e-12;

void requireFit(const LobeSurface& lung) {
  if (lung.health.fitToGrow()) return;
  std::string wrong;
  for (const std::string& complaint : complaints(lung.health)) {
    wrong += (wrong.empty() ? "" : "; ") + complaint;
  }
  throw InvalidInput("'" + lung.name + "' cannot be split: " + wrong +
                     "; mend it with 'pneuma repair'");
}

/// What shows of fissures in the model's CT; none without one that can show them.
std::optional<SheetnessImage> sheetsFor(const LungModel& model, Side of, const LobeInputs& inputs,
                                        const Progress& progress) {
  if (inputs.snap) {
    if (!model.ct || !model.labels) {
      throw InvalidInput("fissures can be snapped only in a CT whose lungs were found; give one");
    }
    requireThinSlices(*model.ct);
  }
  if (!model.ct || !model.labels || !hasThinSlices(*model.ct)) return std::nullopt;
  return fissureSheets(model, of, progress);
}

void splitOne(const LungModel& model, const LobeSurface& lung, const LobeInputs& inputs,
              const LobeOptions& options, LobesOfLungs& result, const Progress& progress) {
  requireFit(lung);
  const Side of = side(lung.lobe);
  const std::optional<SheetnessImage> sheets =
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
  const auto shares = inputs.shares.find(of);
  if (shares != inputs.shares.end()) {
    surfaces = withShares(*lung.mesh, of, std::move(surfaces), shares->second, options.capSpacingMm,
                          progress.part(0.4, 0.7, "moving fissures"));
    for (const auto& [fissure, surface] : surfaces) result.fissures[fissure].surface = surface;
  }
  SplitLung split = splitLung(*lung.mesh, of, surfaces, options.capSpacingMm,
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
    const MeshTopology health = topology(surfaceOf(split.complex, region).mesh);
    result.faults[lobe] = health.openEdges + health.nonManifoldEdges + health.misorientedEdges +
                          health.nonManifoldVertices;
  }
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
  progress.report(1.0);
  return result;
}

TriangleMesh fissurePatch(const SplitLung& lung, Fissure fissure) {
  const auto contact = [&](Lobe behind, Lobe front) {
    return contactOf(lung.complex, static_cast<RegionId>(behind), static_cast<RegionId>(front));
  };
  switch (fissure) {
    case Fissure::RightHorizontal:
      return contact(Lobe::RightMiddle, Lobe::RightUpper);
    case Fissure::LeftOblique:
      return contact(Lobe::LeftLower, Lobe::LeftUpper);
    default:
      break;
  }
  TriangleMesh mesh = contact(Lobe::RightLower, Lobe::RightMiddle);
  const TriangleMesh other = contact(Lobe::RightLower, Lobe::RightUpper);
  const auto first = static_cast<std::uint32_t>(mesh.points.size());
  mesh.points.insert(mesh.points.end(), other.points.begin(), other.points.end());
  for (const auto& [a, b, c] : other.triangles) {
    mesh.triangles.push_back({a + first, b + first, c + first});
  }
  return mesh;
}

double partitionError(const LobesOfLungs& lobes, Side of) {
  double sum = 0.0;
  for (const Lobe lobe : lobesOf(of)) sum += lobes.lobeMm3.at(lobe);
  return std::abs(sum / lobes.lungMm3.at(of) - 1.0);
}

Json lobesReport(const LungModel& model, const LobesOfLungs& lobes, const LobeOptions& options) {
  Json report = reportEnvelope("pneuma/lobes/1", model.inputs, toJson(options), 0);
  double all = 0.0;
  for (const auto& [of, volume] : lobes.lungMm3) all += volume;
  for (const auto& [lobe, volume] : lobes.lobeMm3) {
    report["lobes"].push_back({{"lobe", shortName(lobe)},
                               {"volume_ml", millilitres(volume)},
                               {"share_of_lung", volume / lobes.lungMm3.at(side(lobe))},
                               {"share_of_both", volume / all}});
  }
  for (const auto& [fissure, used] : lobes.fissures) {
    Json entry = {{"fissure", shortName(fissure)},
                  {"source", textOf(used.source)},
                  {"points", used.points},
                  {"mean_mm", used.meanMm},
                  {"left_out_mm", used.leftOutMm}};
    if (const auto known = lobes.complete.find(fissure); known != lobes.complete.end()) {
      entry["completeness"] = known->second.share;
    }
    if (const auto known = lobes.snapped.find(fissure); known != lobes.snapped.end()) {
      const auto& [points, before, after] = known->second;
      entry["snapped"] = std::ranges::count(points.onSheet, 1);
      entry["unsnapped"] = std::ranges::count(points.onSheet, 0);
      entry["share_before"] = before;
      entry["share_after"] = after;
    }
    for (const SplitLung& lung : lobes.lungs) {
      const auto found = lung.reports.find(fissure);
      if (found == lung.reports.end()) continue;
      entry["contact_cm2"] = found->second.contactMm2 / 100.0;
      entry["rounds"] = found->second.rounds;
      entry["pieces_joined"] = found->second.piecesJoined;
      entry["joined_ml"] = millilitres(found->second.joinedMm3);
    }
    report["fissures"].push_back(std::move(entry));
  }
  const auto check = [&](const std::string& id, double value, double limit) {
    report["checks"].push_back(
        {{"id", id}, {"value", value}, {"limit", limit}, {"ok", value <= limit}});
  };
  for (const SplitLung& lung : lobes.lungs) {
    check("PARTITION-" + std::string(lung.side == Side::Right ? "R" : "L"),
          partitionError(lobes, lung.side), MostPartitionError);
  }
  for (const auto& [lobe, faults] : lobes.faults) {
    check("CLOSED-" + std::string(shortName(lobe)), static_cast<double>(faults), 0.0);
  }
  report["warnings"] = model.warnings;
  for (const std::string& warning : lobes.warnings) report["warnings"].push_back(warning);
  report["peak_memory_mb"] = peakMemoryMb();
  return report;
}

std::string lobesText(const LobesOfLungs& lobes) {
  double all = 0.0;
  for (const auto& [of, volume] : lobes.lungMm3) all += volume;
  std::vector<std::vector<std::string>> rows = {{"lobe", "volume", "of its lung", "of both"}};
  for (const auto& [lobe, volume] : lobes.lobeMm3) {
    rows.push_back({std::string(shortName(lobe)), fixed(millilitres(volume), 1) + " ml",
                    fixed(100.0 * volume / lobes.lungMm3.at(side(lobe)), 1) + " %",
                    fixed(100.0 * volume / all, 1) + " %"});
  }
  std::string text = textTable(rows);
  rows = {{"fissure", "from", "points", "contact"}};
  if (!lobes.complete.empty()) rows[0].push_back("shows");
  for (const SplitLung& lung : lobes.lungs) {
    for (const auto& [fissure, report] : lung.reports) {
      const UsedFissure& used = lobes.fissures.at(fissure);
      rows.push_back({std::string(shortName(fissure)), textOf(used.source),
                      std::to_string(used.points), fixed(report.contactMm2 / 100.0, 1) + " cm2"});
      const auto known = lobes.complete.find(fissure);
      if (known == lobes.complete.end()) continue;
      rows.back().push_back(fixed(100.0 * known->second.share, 0) + " %");
    }
  }
  return text + textTable(rows);
}

}  // namespace pneuma
