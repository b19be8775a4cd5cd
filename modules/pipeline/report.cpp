#include "pipeline/report.h"

#include <algorithm>

#include <sys/resource.h>

#include "core/units.h"
#include "pipeline/efficiency_report.h"
#include "pipeline/measure_report.h"
#include "version.h"

namespace pneuma {
namespace {

Json optionsJson(const GrowthOptions& options) {
  return std::visit([](const auto& o) { return toJson(o); }, options);
}

Json check(std::string_view id, double value, double limit) {
  return {{"id", id}, {"value", value}, {"limit", limit}, {"ok", value <= limit}};
}

Json lobesJson(const LungModel& model, const std::map<Lobe, Morphometry>& byLobe) {
  Json lobes = Json::object();
  for (const LobeRegion& region : *model.regions) {
    Json& lobe = lobes[std::string(shortName(region.lobe))];
    const auto measured = byLobe.find(region.lobe);
    const bool found = measured != byLobe.end();
    lobe["terminals"] = found ? measured->second.terminals : 0;
    lobe["branches"] = found ? measured->second.branches : 0;
    lobe["volume_ml"] = millilitres(region.domain->volumeMm3());
  }
  return lobes;
}

}  // namespace

std::string versionText() { return ProjectVersion; }

std::string commitText() { return ProjectCommit; }

double peakMemoryMb() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return static_cast<double>(usage.ru_maxrss) / 1024.0;
}

Json reportEnvelope(std::string_view schema, std::span<const InputFile> inputs, Json parameters,
                    std::uint64_t seed) {
  Json files = Json::array();
  for (const InputFile& input : inputs) {
    files.push_back({{"path", input.path}, {"sha256", input.sha256}});
  }
  return {{"schema", schema},
          {"app", {{"name", "pneuma"}, {"version", versionText()}, {"commit", commitText()}}},
          {"inputs", std::move(files)},
          {"parameters", std::move(parameters)},
          {"seed", seed},
          {"frame", "LPS"},
          {"units", {{"length", "mm"}, {"volume", "mL"}}},
          {"checks", Json::array()},
          {"warnings", Json::array()}};
}

Json growthReport(const LungModel& model, const Morphometry& whole,
                  const std::map<Lobe, Morphometry>& byLobe, double measureSeconds,
                  double writeSeconds) {
  const Growth& growth = *model.growth;
  Json options = optionsJson(growth.options);
  Json report = reportEnvelope("pneuma/growth/1", model.inputs, options, seedOf(growth.options));
  report["method"] = growthMethod(growth.options).name;
  report["options"] = std::move(options);
  for (const auto& [name, value] : growth.result.figures) report["figures"][name] = value;
  report["branches"] = whole.branches;
  report["branches_contracted"] = whole.branchesContracted;
  report["terminals"] = whole.terminals;
  report["outside"] = {{"ends", growth.outside.ends}, {"segments", growth.outside.segments}};

  Json& checks = report["checks"];
  checks.push_back(
      check("TREE-PROBLEMS", static_cast<double>(problems(growth.result.tree).size()), 0.0));
  if (growth.result.endsContained) {
    checks.push_back(check("TREE-ENDS-OUTSIDE", static_cast<double>(growth.outside.ends), 0.0));
  }
  if (growth.result.branchesContained) {
    checks.push_back(
        check("TREE-SEGMENTS-OUTSIDE", static_cast<double>(growth.outside.segments), 0.0));
  }
  for (const std::string& warning : model.warnings) report["warnings"].push_back(warning);
  for (const std::string& warning : growth.result.warnings) report["warnings"].push_back(warning);

  report["timing_s"] = {{"read", model.readSeconds},
                        {"domain", growth.domainSeconds},
                        {"grow", growth.growSeconds},
                        {"measure", measureSeconds},
                        {"write", writeSeconds}};
  report["elapsed_s"] =
      model.readSeconds + growth.domainSeconds + growth.growSeconds + measureSeconds + writeSeconds;
  report["peak_memory_mb"] = peakMemoryMb();
  report["lobes"] = lobesJson(model, byLobe);
  report["efficiency"] = toJson(growth.efficiency);
  report["morphometry"] = toJson(whole);
  return report;
}

std::map<std::string, std::string> treeMetadata(const LungModel& model) {
  if (!model.growth) return {{"version", versionText()}};
  const Growth& growth = *model.growth;
  return {{"method", std::string(growthMethod(growth.options).name)},
          {"options", optionsJson(growth.options).dump()},
          {"seed", std::to_string(seedOf(growth.options))},
          {"version", versionText()}};
}

}  // namespace pneuma
