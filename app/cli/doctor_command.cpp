#include <algorithm>
#include <iostream>
#include <thread>

#include <sys/sysinfo.h>

#include "cli/arguments.h"
#include "cli/command.h"
#include "cli/library_versions.h"
#include "cli/text.h"
#include "pipeline/organs.h"
#include "pipeline/report.h"
#include "render/picture.h"

namespace pneuma::cli {
namespace {

constexpr std::uint64_t SelfTestPoints = 5000;

struct Finding {
  std::string id;
  std::string what;   ///< for people
  std::string value;  ///< what was found
  bool ok = true;
  bool needed = true;  ///< false: a warning, Pneuma works without
  std::string advice;  ///< what to do if it is not ok
};

Finding temporaryFolder() {
  std::error_code error;
  const std::filesystem::path folder = std::filesystem::temp_directory_path(error);
  Finding finding{"TEMP-FOLDER",
                  "temporary folder",
                  folder.string(),
                  true,
                  true,
                  "set TMPDIR to a folder that can be written"};
  try {
    requireWritable(folder / "pneuma-doctor");
  } catch (const OutputFailed&) {
    finding.ok = false;
  }
  return finding;
}

Finding display() {
  const bool can = canRender();
  return {"DISPLAY", "rendering", can ? "a picture can be made" : "no display that answers",
          can,       false,       "put 'xvfb-run -a' before commands that draw"};
}

/// Grows a small tree in the built-in lung: it must fill it and stay inside.
Finding selfTest(const Progress& progress) {
  CentroidSplittingOptions options;
  options.points = SelfTestPoints;
  const LungModel model = grow(openOrgan("right-lung"), options, progress);
  const Growth& growth = *model.growth;
  const std::size_t terminals = terminalCount(growth.result.tree);
  const std::size_t outside = growth.outside.ends + growth.outside.segments;
  return {"SELF-TEST",
          "self-test",
          grouped(static_cast<double>(terminals)) + " terminals grown in " +
              fixed(growth.growSeconds, 3) + " s, " + std::to_string(outside) + " outside",
          terminals > SelfTestPoints / 10 && outside == 0,
          true,
          "this build is broken, please report it"};
}

std::uint64_t memoryMb() {
  struct sysinfo machine = {};
  if (sysinfo(&machine) != 0) return 0;
  return static_cast<std::uint64_t>(machine.totalram) * machine.mem_unit / 1'000'000;
}

Json doctorReport(const std::vector<Finding>& findings) {
  Json report = reportEnvelope("pneuma/doctor/1", {}, Json::object(), 0);
  report["libraries"] = Json::object();
  for (const LibraryVersion& library : LibraryVersions) {
    report["libraries"][std::string(library.name)] = library.version;
  }
  report["machine"] = {{"processors", std::thread::hardware_concurrency()},
                       {"memory_mb", memoryMb()}};
  for (const Finding& finding : findings) {
    report["checks"].push_back({{"id", finding.id},
                                {"value", finding.value},
                                {"limit", nullptr},
                                {"ok", finding.ok || !finding.needed}});
    if (!finding.ok) report["warnings"].push_back(finding.what + ": " + finding.advice);
  }
  return report;
}

std::string doctorText(const std::vector<Finding>& findings) {
  std::string text = "pneuma " + versionText() + " (" + commitText() + ")\n\nbuilt with\n";
  for (const LibraryVersion& library : LibraryVersions) {
    text += "  " + std::string(library.name) + " " + std::string(library.version) + "\n";
  }
  text += "\nmachine\n  " + std::to_string(std::thread::hardware_concurrency()) + " processors, " +
          grouped(static_cast<double>(memoryMb())) + " MB of memory\n\nchecks\n";
  for (const Finding& finding : findings) {
    text += std::string(finding.ok       ? "  ok    "
                        : finding.needed ? "  FAIL  "
                                         : "  warn  ") +
            finding.what + ": " + finding.value + "\n";
    if (!finding.ok) text += "        " + finding.advice + "\n";
  }
  return text;
}

}  // namespace

Run declareDoctor(CLI::App& app, CommonOptions& common) {
  addJson(app, common);
  return [&common](const Progress& progress) {
    const std::vector<Finding> findings = {temporaryFolder(), display(),
                                           selfTest(progress.part(0.0, 1.0, "self-test"))};
    progress.report(1.0);
    std::cout << (common.json ? jsonText(doctorReport(findings)) : doctorText(findings));
    const bool healthy = std::all_of(findings.begin(), findings.end(), [](const Finding& finding) {
      return finding.ok || !finding.needed;
    });
    return healthy ? ExitCode::Done : ExitCode::CheckFailed;
  };
}

}  // namespace pneuma::cli
