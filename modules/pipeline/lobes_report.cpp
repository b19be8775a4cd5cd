#include <algorithm>

#include "core/units.h"
#include "geometry/mesh_topology.h"
#include "lobes/welding.h"
#include "pipeline/figure_table.h"
#include "pipeline/lobe_checks.h"
#include "pipeline/report.h"
#include "pipeline/split_lobes.h"

namespace pneuma {
namespace {

Json contactsOf(const SplitLung& lung) {
  Json contacts = Json::array();
  const std::vector<Lobe> lobes = lobesOf(lung.side);
  for (std::size_t i = 0; i < lobes.size(); ++i) {
    for (std::size_t j = i + 1; j < lobes.size(); ++j) {
      const double area = areaMm2(contactOf(lung.complex, static_cast<RegionId>(lobes[i]),
                                            static_cast<RegionId>(lobes[j])));
      contacts.push_back(
          {{"lobes", {shortName(lobes[i]), shortName(lobes[j])}}, {"area_cm2", area / 100.0}});
    }
  }
  return contacts;
}

void addSnapping(Json& entry, const LobesOfLungs& lobes, Fissure fissure) {
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
}

}  // namespace

Json lobesReport(const LungModel& model, const LobesOfLungs& lobes, const LobeOptions& options) {
  Json report = reportEnvelope("pneuma/lobes/1", model.inputs, toJson(options), 0);
  double all = 0.0;
  for (const auto& [of, volume] : lobes.lungMm3) all += volume;
  for (const auto& [lobe, volume] : lobes.lobeMm3) {
    report["lobes"].push_back({{"lobe", shortName(lobe)},
                               {"volume_ml", millilitres(volume)},
                               {"share_of_lung", volume / lobes.lungMm3.at(side(lobe))},
                               {"share_of_both", volume / all},
                               {"surface_cm2", lobes.shapes.at(lobe).areaMm2 / 100.0},
                               {"genus", lobes.shapes.at(lobe).genus}});
  }
  report["contacts"] = Json::array();
  for (const SplitLung& lung : lobes.lungs) {
    report["lungs"].push_back(
        {{"lung", name(lung.side)}, {"volume_ml", millilitres(lobes.lungMm3.at(lung.side))}});
    for (Json& contact : contactsOf(lung)) report["contacts"].push_back(std::move(contact));
  }
  for (const auto& [fissure, used] : lobes.fissures) {
    Json entry = {{"fissure", shortName(fissure)}, {"source", textOf(used.source)},
                  {"points", used.points},         {"mean_mm", used.meanMm},
                  {"largest_mm", used.largestMm},  {"left_out_mm", used.leftOutMm}};
    if (used.coverage) entry["coverage"] = *used.coverage;
    addSnapping(entry, lobes, fissure);
    for (const SplitLung& lung : lobes.lungs) {
      const auto found = lung.reports.find(fissure);
      if (found == lung.reports.end()) continue;
      entry["contact_cm2"] = found->second.contactMm2 / 100.0;
      entry["rounds"] = found->second.rounds;
      entry["pieces_joined"] = found->second.piecesJoined;
      entry["joined_ml"] = millilitres(found->second.joinedMm3);
      if (found->second.movedMm != 0.0) entry["moved_mm"] = found->second.movedMm;
    }
    report["fissures"].push_back(std::move(entry));
  }
  std::vector<LobeCheck> checks;
  for (const SplitLung& lung : lobes.lungs) {
    checks.push_back({"PARTITION-" + std::string(lung.side == Side::Right ? "R" : "L"),
                      partitionError(lobes, lung.side), MostPartitionError});
    const auto pieces = static_cast<double>(topology(outerSurface(lung.complex)).components);
    for (const Lobe lobe : lobesOf(lung.side)) {
      const LobeShape& shape = lobes.shapes.at(lobe);
      const std::string of(shortName(lobe));
      checks.push_back({"CLOSED-" + of, static_cast<double>(shape.faults), 0.0});
      checks.push_back({"PIECES-" + of, static_cast<double>(shape.pieces), pieces});
    }
  }
  report["checks"] = toJson(checks);
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
