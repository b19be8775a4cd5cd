#include "pipeline/tree_measurement.h"

#include "pipeline/efficiency_report.h"
#include "pipeline/measure_report.h"

namespace pneuma {
namespace {

Json atMostZero(const char* id, std::size_t value) {
  return {{"id", id}, {"value", value}, {"limit", 0}, {"ok", value == 0}};
}

}  // namespace

TreeMeasurement measureTree(const AirwayTree& tree, const LungModel& organ, std::uint64_t seed,
                            const Progress& progress) {
  MorphometryInput input{.lobes = {}, .seed = seed};
  if (organ.regions) input.lobes = *organ.regions;
  TreeMeasurement measured;
  measured.problems = problems(tree).size();
  measured.whole = measure(tree, input, progress.part(0.0, 0.55, "measuring"));
  measured.byLobe = measureByLobe(tree, input, progress.part(0.55, 0.9, "measuring"));
  if (!input.lobes.empty()) {
    measured.outside = outsideTheirLobe(tree, input.lobes);
    measured.efficiency =
        efficiency(tree, input.lobes, organ.cubes, progress.part(0.9, 1.0, "measuring"));
  }
  progress.report(1.0);
  return measured;
}

Json toJson(const TreeMeasurement& measured) {
  Json json = Json::object();
  if (measured.outside.has_value()) {
    json["outside"] = {{"ends", measured.outside->ends}, {"segments", measured.outside->segments}};
  }
  json["branches"] = measured.whole.branches;
  json["terminals"] = measured.whole.terminals;
  json["morphometry"] = toJson(measured.whole);
  if (measured.efficiency.has_value()) json["efficiency"] = toJson(*measured.efficiency);
  json["lobes"] = Json::object();
  for (const auto& [lobe, morphometry] : measured.byLobe) {
    json["lobes"][std::string(shortName(lobe))] = toJson(morphometry);
  }
  return json;
}

Json checksOf(const TreeMeasurement& measured) {
  Json checks = Json::array({atMostZero("TREE-PROBLEMS", measured.problems)});
  if (measured.outside.has_value()) {
    checks.push_back(atMostZero("OUTSIDE-ENDS", measured.outside->ends));
  }
  return checks;
}

}  // namespace pneuma
