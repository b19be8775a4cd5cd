#include <algorithm>
#include <array>
#include <iostream>
#include <memory>

#include "cli/arguments.h"
#include "cli/command.h"
#include "cli/files.h"
#include "cli/outline_picture.h"
#include "cli/text.h"
#include "io/json.h"
#include "io/tree_file.h"
#include "pipeline/report.h"

namespace pneuma::cli {
namespace {

struct OutlineArguments {
  OutlineAggregationOptions options;
  std::filesystem::path picture;
};

constexpr std::array<const char*, 3> Regions = {"upper", "middle", "lower"};

Json outlineReport(const OutlineAggregationOptions& options, const OutlineAggregate& aggregate) {
  Json report = reportEnvelope("pneuma/outline/1", {}, toJson(options), options.seed);
  const double particles = static_cast<double>(aggregate.cluster.positions.size());
  report["particles"] = aggregate.cluster.positions.size();
  report["walkers"] = aggregate.walkers;
  report["saturated"] = aggregate.end == AggregationEnd::Saturated;
  report["starved"] = aggregate.end == AggregationEnd::Starved;
  report["tips"] = aggregate.tips.all;
  for (std::size_t i = 0; i < Regions.size(); ++i) {
    report["regions"][Regions[i]] = {
        {"started_share", static_cast<double>(aggregate.started[i]) / std::max(particles, 1.0)},
        {"ended_share", static_cast<double>(aggregate.stuck[i]) / std::max(particles, 1.0)},
        {"reached_share", aggregate.reached[i]}};
  }
  if (aggregate.end == AggregationEnd::Saturated) {
    report["warnings"].push_back(
        "saturated: no key point is open any more; choose smaller pixels "
        "for more particles");
  }
  if (aggregate.end == AggregationEnd::Starved) {
    report["warnings"].push_back(
        "starved: walkers no longer arrive; let walls reflect, or allow "
        "more steps");
  }
  return report;
}

std::string summary(const Json& report) {
  std::string text = grouped(report.at("particles").get<double>()) + " particles of " +
                     grouped(report.at("walkers").get<double>()) + " walkers, " +
                     grouped(report.at("tips").get<double>()) + " tips\n";
  std::vector<std::vector<std::string>> rows = {
      {"region", "started from", "ended in", "within 10 pixels"}};
  const auto percent = [](const Json& share) {
    return fixed(100.0 * share.get<double>(), 1) + " %";
  };
  for (const char* region : Regions) {
    const Json& shares = report.at("regions").at(region);
    rows.push_back({region, percent(shares.at("started_share")), percent(shares.at("ended_share")),
                    percent(shares.at("reached_share"))});
  }
  return text + table(rows);
}

ExitCode runOutline(const OutlineArguments& arguments, const CommonOptions& common,
                    const Progress& progress) {
  if (!common.output.empty()) requireTreeOutput(common.output, common.existing());
  if (!arguments.picture.empty()) requirePngOutput(arguments.picture, common.existing());
  const OutlineAggregate aggregate = growInOutline(arguments.options, progress);
  const Json report = outlineReport(arguments.options, aggregate);
  OutputSet outputs;
  if (!common.output.empty()) {
    outputs.add(common.output);
    writeTree(common.output, aggregate.tree,
              {{"method", "dla in the outline of a right lung"},
               {"options", toJson(arguments.options).dump()},
               {"version", versionText()}});
  }
  if (!arguments.picture.empty()) {
    outputs.add(arguments.picture);
    writeFile(arguments.picture, pngText(outlinePicture(aggregate)), common.existing());
  }
  outputs.keep();
  if (!common.quiet) printWarnings(report.at("warnings").get<std::vector<std::string>>());
  if (common.json) {
    std::cout << jsonText(report);
  } else if (!common.quiet) {
    std::cout << summary(report);
  }
  return ExitCode::Done;
}

}  // namespace

Run declareOutline(CLI::App& app, CommonOptions& common) {
  const auto arguments = std::make_shared<OutlineArguments>();
  addFields(app, arguments->options);
  addOutput(app, common, "FILE", "Write the tree here: .vtp, .swc, .csv or .json.");
  app.add_option("--picture", arguments->picture, "Draw it into this PNG, like the paper's Fig. 1.")
      ->type_name("FILE");
  addJson(app, common);
  return [arguments, &common](const Progress& progress) {
    return runOutline(*arguments, common, progress);
  };
}

}  // namespace pneuma::cli
