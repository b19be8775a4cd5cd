#include "pipeline/measure_report.h"

#include <algorithm>

#include "pipeline/figure_table.h"

namespace pneuma {
namespace {

/// null where fewer than two orders occur.
Json numberOrNull(double value, bool known) { return known ? Json(value) : Json(); }

Json toJson(const OrderRatios& ratios) {
  const auto ratio = [](const OrderRatio& r) { return numberOrNull(r.ratio, r.ratio > 0.0); };
  const auto fit = [](const OrderRatio& r) { return numberOrNull(r.r2, r.ratio > 0.0); };
  return {{"Rb", ratio(ratios.branching)},   {"Rl", ratio(ratios.length)},
          {"Rd", ratio(ratios.diameter)},    {"r2", fit(ratios.branching)},
          {"r2_length", fit(ratios.length)}, {"r2_diameter", fit(ratios.diameter)},
          {"counts", ratios.counts}};
}

void appendCsv(std::string_view region, const Morphometry& morphometry,
               std::span<const PublishedBand> bands, std::string& csv) {
  for (const auto& [key, value] : figuresOf(morphometry)) {
    csv += std::string(region) + "," + key + "," + textOf(value) + "," + csvBand(bands, key) + "\n";
  }
}

}  // namespace

Json toJson(const Summary& summary) {
  const bool known = summary.count > 0;
  return {{"count", summary.count},
          {"mean", numberOrNull(summary.mean, known)},
          {"sd", numberOrNull(summary.sd, known)},
          {"min", numberOrNull(summary.min, known)},
          {"max", numberOrNull(summary.max, known)}};
}

Json toJson(const Morphometry& m) {
  Json json;
  json["branches"] = m.branches;
  json["branches_contracted"] = m.branchesContracted;
  json["terminals"] = m.terminals;
  json["terminal_generation"] = toJson(m.terminalGeneration);
  json["terminal_length_mm"] = toJson(m.terminalLengthMm);
  json["path_length_mm"] = toJson(m.pathLengthMm);
  json["branching_angle_deg"] = toJson(m.branchingAngleDeg);
  json["branching_angle_major_deg"] = toJson(m.branchingAngleMajorDeg);
  json["branching_angle_minor_deg"] = toJson(m.branchingAngleMinorDeg);
  Json& byDiameter = json["branching_angle_by_parent_diameter_deg"];
  byDiameter = Json::object();
  for (const auto& [name, angles] : m.branchingAngleByParentDiameterDeg) {
    byDiameter[name] = toJson(angles);
  }
  json["rotation_angle_deg"] = toJson(m.rotationAngleDeg);
  json["length_to_diameter"] = toJson(m.lengthToDiameter);
  json["length_to_parent"] = toJson(m.lengthToParent);
  json["length_to_parent_below_one"] =
      numberOrNull(m.lengthToParentBelowOne, m.lengthToParent.count > 0);
  json["diameter_to_parent"] = toJson(m.diameterToParent);
  json["diameter_minor_to_major"] = toJson(m.diameterMinorToMajor);
  json["strahler"] = toJson(m.strahler);
  json["horsfield"] = toJson(m.horsfield);
  json["dead_space_ml"] = m.deadSpaceMl;
  if (m.gap.has_value()) {
    json["gap_mean"] = m.gap->mean;
    json["gap_p95"] = m.gap->p95;
    json["gap_max"] = m.gap->max;
    json["spacing_mm"] = m.gap->spacingMm;
  }
  json["box_dimension"] = Json::array();
  for (const BoxDimension& octave : m.boxDimension) {
    json["box_dimension"].push_back({{"box_mm", octave.boxMm}, {"dimension", octave.dimension}});
  }
  json["crossings"] = m.crossings;
  return json;
}

Json publishedJson(const Morphometry& whole) {
  const Figures figures = figuresOf(whole);
  Json json = Json::array();
  for (const PublishedBand& band : publishedBands()) {
    const auto figure = std::ranges::find(figures, band.quantity, &Figures::value_type::first);
    if (figure == figures.end()) continue;
    json.push_back({{"quantity", band.quantity},
                    {"value", figure->second},
                    {"low", band.low},
                    {"high", band.high},
                    {"source", band.source}});
  }
  return json;
}

std::string measureCsv(const Morphometry& whole, const std::map<Lobe, Morphometry>& byLobe) {
  std::string csv = "region,quantity,value,published_low,published_high,source\n";
  appendCsv("all", whole, publishedBands(), csv);
  for (const auto& [lobe, morphometry] : byLobe) appendCsv(shortName(lobe), morphometry, {}, csv);
  return csv;
}

}  // namespace pneuma
