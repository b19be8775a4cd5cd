#include "pipeline/split_lobes.h"

#include <algorithm>
#include <cmath>

#include "core/error.h"
#include "core/units.h"
#include "geometry/mesh_topology.h"
#include "pipeline/figure_table.h"
#include "pipeline/fissure_coverage.h"
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

void splitOne(const LobeSurface& lung, const LobeInputs& inputs, const LobeOptions& options,
              LobesOfLungs& result, const Progress& progress) {
  requireFit(lung);
  const Side of = side(lung.lobe);
  FissureSurfaces surfaces;
  for (auto& [fissure, used] :
       fissureSurfaces(*lung.mesh, of, inputs.given, options, result.warnings)) {
    surfaces[fissure] = used.surface;
    result.fissures[fissure] = std::move(used);
  }
  const auto shares = inputs.shares.find(of);
  if (shares != inputs.shares.end()) {
    surfaces = withShares(*lung.mesh, of, std::move(surfaces), shares->second, options.capSpacingMm,
                          progress.part(0.0, 0.6, "moving fissures"));
    for (const auto& [fissure, surface] : surfaces) result.fissures[fissure].surface = surface;
  }
  SplitLung split = splitLung(*lung.mesh, of, surfaces, options.capSpacingMm,
                              progress.part(0.6, 1.0, "cutting along fissures"));
  for (const auto& [fissure, report] : split.reports) {
    if (report.piecesJoined == 0) continue;
    result.warnings.push_back("the " + std::string(longName(fissure)) + " had cut " +
                              std::to_string(report.piecesJoined) + " pieces off, together " +
                              fixed(millilitres(report.joinedMm3), 2) +
                              " ml; they went to the lobe around them");
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
    splitOne(*lung, inputs, options, result, progress.part(from, from + 0.5, "splitting lungs"));
  }
  if (result.lungs.empty()) {
    throw InvalidInput(
        "there is no whole lung to split; name its surface right or left, as 'pneuma segment "
        "--surfaces' does");
  }
  result.parted = partedLobes(result.lungs, inputs.accessory, options, result.warnings);
  progress.report(1.0);
  return result;
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
    Json entry = {{"fissure", shortName(fissure)}, {"source", textOf(used.source)},
                  {"points", used.points},         {"mean_mm", used.meanMm},
                  {"largest_mm", used.largestMm},  {"left_out_mm", used.leftOutMm}};
    if (used.coverage) entry["coverage"] = *used.coverage;
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
  addPartedLobes(report, lobes.parted);
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
  for (const SplitLung& lung : lobes.lungs) {
    for (const auto& [fissure, report] : lung.reports) {
      const UsedFissure& used = lobes.fissures.at(fissure);
      rows.push_back({std::string(shortName(fissure)), textOf(used.source),
                      std::to_string(used.points), fixed(report.contactMm2 / 100.0, 1) + " cm2"});
    }
  }
  return text + textTable(rows);
}

}  // namespace pneuma
