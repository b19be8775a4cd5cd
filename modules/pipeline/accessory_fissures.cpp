#include "pipeline/accessory_fissures.h"

#include <cmath>

#include "core/error.h"
#include "core/units.h"
#include "geometry/mesh_topology.h"
#include "io/surface_file.h"
#include "pipeline/lobe_checks.h"

namespace pneuma {
namespace {

constexpr RegionId Below = 1;
constexpr RegionId Above = 2;

TriangleMesh lobeSurface(const std::vector<SplitLung>& lungs, const AccessoryFissure& fissure) {
  for (const SplitLung& lung : lungs) {
    if (lung.side != side(fissure.lobe)) continue;
    return surfaceOf(lung.complex, static_cast<RegionId>(fissure.lobe)).mesh;
  }
  throw InvalidInput("the accessory fissure " + fissure.name + " parts the " +
                     std::string(longName(fissure.lobe)) + ", but there is no such lung to split");
}

PartedLobe parted(const TriangleMesh& lobe, const AccessoryFissure& fissure,
                  const LobeOptions& options, std::vector<std::string>& warnings,
                  const Progress& progress) {
  PartedLobe result;
  result.name = fissure.name;
  result.lobe = fissure.lobe;
  result.used = accessorySurface(fissure, lobe, options, warnings);
  RegionComplex complex = complexOf(lobe, Below);
  result.lobeMm3 = volumeMm3(complex, Below);
  const SplitRegion settings{
      .region = Below, .below = Below, .above = Above, .capSpacingMm = options.capSpacingMm};
  const std::string what = "accessory fissure " + fissure.name;
  result.report = result.used.sheet
                      ? splitRegion(complex, *result.used.sheet, settings, what, progress)
                      : splitRegion(complex, result.used.surface, settings, what, progress);
  result.below = surfaceOf(complex, Below).mesh;
  result.above = surfaceOf(complex, Above).mesh;
  result.patch = contactOf(complex, Below, Above);
  result.belowMm3 = volumeMm3(complex, Below);
  result.aboveMm3 = volumeMm3(complex, Above);
  return result;
}

std::filesystem::path partFile(const std::string& name, const char* part) {
  return std::filesystem::path("accessory") / (name + "_" + part + ".vtp");
}

std::filesystem::path patchFile(const std::string& name) {
  return std::filesystem::path("fissures") / (name + ".vtp");
}

}  // namespace

std::vector<PartedLobe> partedLobes(const std::vector<SplitLung>& lungs,
                                    const std::vector<AccessoryFissure>& fissures,
                                    const LobeOptions& options, std::vector<std::string>& warnings,
                                    const Progress& progress) {
  std::vector<PartedLobe> lobes;
  for (const AccessoryFissure& fissure : fissures) {
    progress.report(static_cast<double>(lobes.size()) / static_cast<double>(fissures.size()));
    lobes.push_back(parted(lobeSurface(lungs, fissure), fissure, options, warnings, progress));
  }
  return lobes;
}

std::vector<std::filesystem::path> partedLobeFiles(const std::vector<AccessoryFissure>& fissures) {
  std::vector<std::filesystem::path> files;
  for (const AccessoryFissure& fissure : fissures) {
    files.push_back(partFile(fissure.name, "below"));
    files.push_back(partFile(fissure.name, "above"));
    files.push_back(patchFile(fissure.name));
  }
  return files;
}

void writePartedLobes(const std::filesystem::path& folder, const std::vector<PartedLobe>& lobes) {
  for (const PartedLobe& lobe : lobes) {
    writeSurface(folder / partFile(lobe.name, "below"), lobe.below);
    writeSurface(folder / partFile(lobe.name, "above"), lobe.above);
    writeSurface(folder / patchFile(lobe.name), lobe.patch);
  }
}

void addPartedLobes(Json& report, const std::vector<PartedLobe>& lobes) {
  std::vector<LobeCheck> checks;
  for (const PartedLobe& lobe : lobes) {
    report["accessory"].push_back({{"name", lobe.name},
                                   {"lobe", shortName(lobe.lobe)},
                                   {"source", textOf(lobe.used.source)},
                                   {"points", lobe.used.points},
                                   {"mean_mm", lobe.used.meanMm},
                                   {"largest_mm", lobe.used.largestMm},
                                   {"left_out_mm", lobe.used.leftOutMm},
                                   {"contact_cm2", lobe.report.contactMm2 / 100.0},
                                   {"below_ml", millilitres(lobe.belowMm3)},
                                   {"above_ml", millilitres(lobe.aboveMm3)}});
    if (lobe.report.movedMm != 0.0) {
      report["accessory"].back()["moved_mm"] = lobe.report.movedMm;
    }
    checks.push_back({"PARTITION-" + lobe.name,
                      std::abs((lobe.belowMm3 + lobe.aboveMm3) / lobe.lobeMm3 - 1.0),
                      MostPartitionError});
    const std::size_t faults = topology(lobe.below).faults() + topology(lobe.above).faults();
    checks.push_back({"CLOSED-" + lobe.name, static_cast<double>(faults), 0.0});
  }
  for (Json& check : toJson(checks)) report["checks"].push_back(std::move(check));
}

}  // namespace pneuma
