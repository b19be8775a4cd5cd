#include "pipeline/segment_report.h"

#include <array>
#include <cmath>
#include <optional>
#include <utility>
#include <vector>

#include "pipeline/figure_table.h"
#include "pipeline/lung_corrections.h"
#include "pipeline/report.h"

namespace pneuma {
namespace {

Json toJson(const LungFinding& lung) {
  return {{"volume_ml", lung.volumeMl},
          {"volume_with_airways_ml", lung.volumeWithAirwaysMl},
          {"air_ml", lung.airMl},
          {"mean_hu", lung.meanHu},
          {"dense_share", lung.denseShare},
          {"dropped_ml", lung.droppedMl},
          {"border_mm2", lung.borderMm2},
          {"lowest_slice_mm2", lung.lowestSliceMm2},
          {"highest_slice_mm2", lung.highestSliceMm2}};
}

/// A named bronchus, and the one at whose beginning it ends.
struct NamedBronchus {
  const char* name;
  std::optional<std::size_t> from;
  std::optional<std::size_t> to;
};

std::vector<NamedBronchus> namedBronchi(const BronchusNames& names) {
  return {{"right main", names.rightMain, names.rightUpper},
          {"left main", names.leftMain, names.leftUpper},
          {"intermedius", names.intermedius, names.rightMiddle},
          {"RUL", names.rightUpper, std::nullopt},
          {"RML", names.rightMiddle, std::nullopt},
          {"RLL", names.rightLower, std::nullopt},
          {"LUL", names.leftUpper, std::nullopt},
          {"LLL", names.leftLower, std::nullopt}};
}

Json airwaysJson(const LungSegmentation& lungs) {
  const AirwayFinding& found = lungs.airways;
  Json airways = {{"found", found.found},
                  {"trachea_mm", found.tracheaLengthMm},
                  {"base_threshold_hu", found.baseThresholdHu},
                  {"base_ml", found.baseMl},
                  {"volume_ml", found.volumeMl},
                  {"leaks_undone", found.leaksUndone},
                  {"walls_missed", found.wallsMissed},
                  {"steps_followed", found.stepsFollowed},
                  {"largest_step_ml", found.largestStepMl},
                  {"branches", lungs.central.size()},
                  {"terminals", terminalCount(lungs.central)}};
  double length = 0.0;
  for (const Branch& branch : lungs.central) length += lengthMm(branch);
  airways["length_mm"] = length;
  airways["carina"] = nullptr;
  if (lungs.names.carina) {
    const Vec3& p = *lungs.names.carina;
    airways["carina"] = {p.x(), p.y(), p.z()};
  }
  for (const NamedBronchus& bronchus : namedBronchi(lungs.names)) {
    Json& entry = airways["bronchi"][bronchus.name];
    if (!bronchus.from) continue;  // null: not found
    entry = {{"length_mm", lengthBetweenMm(lungs.central, *bronchus.from, bronchus.to)},
             {"radius_mm", lungs.central[*bronchus.from].radiusMm}};
  }
  return airways;
}

}  // namespace

std::string sentence(const SegmentationCheck& check) {
  const std::string unit = check.unit.empty() ? "" : " " + check.unit;
  const int digits = check.unit.empty() || check.unit == "ml" ? 2 : 1;
  if (check.low == check.high || check.unit == "votes") return check.advice;  // yes or no
  constexpr double NoLimit = 1e9;
  const std::string wanted = check.high >= NoLimit ? ", below " + fixed(check.low, digits)
                                                   : ", outside " + fixed(check.low, digits) +
                                                         " to " + fixed(check.high, digits);
  return check.what + ": " + fixed(check.value, digits) + unit + wanted + unit + "; " +
         check.advice;
}

Json segmentReport(const LungModel& model, const LungOptions& options, double readSeconds,
                   double findSeconds) {
  const LungSegmentation& lungs = *model.lungs;
  Json report = reportEnvelope("pneuma/segment/1", model.inputs, toJson(options), 0);
  report["lungs"] = {{"right", toJson(lungs.right)}, {"left", toJson(lungs.left)}};
  if (model.corrections) report["edits"] = model.corrections->edits.size();
  report["separated"] = lungs.separated;
  report["bridge_mm"] = lungs.bridgeMm;
  report["gas_removed_ml"] = lungs.gasRemovedMl;
  report["air_elsewhere_ml"] = lungs.airElsewhereMl;
  report["airways"] = airwaysJson(lungs);
  for (const SegmentationCheck& check : lungs.checks) {
    report["checks"].push_back({{"id", check.id},
                                {"what", check.what},
                                {"value", check.value},
                                {"low", check.low},
                                {"high", check.high},
                                {"unit", check.unit},
                                {"ok", check.ok()}});
  }
  report["warnings"] = model.warnings;
  report["timing_s"] = {{"read", readSeconds}, {"find", findSeconds}};
  report["peak_memory_mb"] = peakMemoryMb();
  return report;
}

std::string lungsText(const LungModel& model) {
  const LungSegmentation& lungs = *model.lungs;
  std::vector<std::vector<std::string>> rows = {
      {"lung", "volume", "with airways", "air alone", "mean density"}};
  const std::array<std::pair<const char*, const LungFinding*>, 2> both = {
      {{"right", &lungs.right}, {"left", &lungs.left}}};
  for (const auto& [name, lung] : both) {
    rows.push_back({name, fixed(lung->volumeMl, 1) + " ml",
                    fixed(lung->volumeWithAirwaysMl, 1) + " ml", fixed(lung->airMl, 1) + " ml",
                    fixed(lung->meanHu, 0) + " HU"});
  }
  std::string text = textTable(rows);
  if (model.corrections) {
    const std::size_t edits = model.corrections->edits.size();
    text += "corrected by hand: " + std::to_string(edits) + (edits == 1 ? " edit\n" : " edits\n");
  }
  if (lungs.gasRemovedMl > 0.0) {
    text += "gas of stomach or bowel taken out: " + fixed(lungs.gasRemovedMl, 1) + " ml\n";
  }
  if (!lungs.airways.found) return text + "airways: no trachea found\n";
  text += "airways: " + std::to_string(lungs.central.size()) + " branches, " +
          std::to_string(terminalCount(lungs.central)) + " ends, " +
          fixed(lungs.airways.volumeMl, 1) + " ml; " + std::to_string(lungs.airways.leaksUndone) +
          " leaks undone\n";
  if (lungs.names.carina) {
    const Vec3& p = *lungs.names.carina;
    text += "carina: " + std::string(p.x() < 0.0 ? "R " : "L ") + fixed(std::abs(p.x()), 1) +
            (p.y() < 0.0 ? "  A " : "  P ") + fixed(std::abs(p.y()), 1) +
            (p.z() < 0.0 ? "  I " : "  S ") + fixed(std::abs(p.z()), 1) + " mm\n";
  } else {
    text += "carina: not found\n";
  }
  rows = {{"bronchus", "length", "radius"}};
  for (const NamedBronchus& bronchus : namedBronchi(lungs.names)) {
    if (bronchus.from) {
      rows.push_back({bronchus.name,
                      fixed(lengthBetweenMm(lungs.central, *bronchus.from, bronchus.to), 0) + " mm",
                      fixed(lungs.central[*bronchus.from].radiusMm, 1) + " mm"});
    } else {
      rows.push_back({bronchus.name, "not found"});
    }
  }
  return text + textTable(rows);
}

}  // namespace pneuma
