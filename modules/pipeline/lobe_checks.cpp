#include "pipeline/lobe_checks.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "anatomy/fissure.h"
#include "core/error.h"
#include "core/units.h"
#include "geometry/mesh_topology.h"
#include "geometry/surface_voxels.h"
#include "io/atomic_file.h"
#include "io/input_files.h"
#include "io/surface_file.h"
#include "io/volume_file.h"
#include "lobes/contact_sampling.h"
#include "lobes/lobe_splitting.h"
#include "lobes/welding.h"
#include "pipeline/figure_table.h"
#include "pipeline/lobe_files.h"
#include "pipeline/report.h"

namespace pneuma {
namespace {

namespace fs = std::filesystem;

constexpr double MostVolumeError = 1e-9;  ///< what decimal numbers of a report keep
constexpr double MostOtherVoxels = 1e-4;
constexpr std::size_t MostReportBytes = std::size_t{64} << 20;

/// Lobes of one lung that are there.
using Lobes = std::vector<const LobeSurface*>;

class Checker {
 public:
  Checker(const fs::path& folder, const LungModel& model, LobeFolder& result)
      : folder_(folder), model_(model), result_(result) {}

  void check(const Progress& progress) {
    for (const LobeSurface& surface : *model_.surfaces) {
      const MeshReport& health = surface.health;
      const double faults =
          static_cast<double>(health.openEdges + health.nonManifoldEdges + health.misorientedEdges +
                              health.nonManifoldVertices + health.degenerateTriangles) +
          (health.closed && !health.orientedOutwards ? 1.0 : 0.0);
      add("CLOSED-" + std::string(shortName(surface.lobe)), faults, 0.0);
      add("CUTS-" + std::string(shortName(surface.lobe)),
          static_cast<double>(health.selfIntersections), 0.0);
      if (!health.selfIntersectionsCounted) {
        result_.warnings.push_back(surface.name +
                                   " is too broken to look for triangles that cut each other");
      }
    }
    for (const Side of : {Side::Right, Side::Left}) {
      Lobes lobes;
      for (const LobeSurface& surface : *model_.surfaces) {
        if (std::ranges::count(lobesOf(of), surface.lobe) > 0) lobes.push_back(&surface);
      }
      if (lobes.size() < 2) continue;
      checkLung(of, lobes);
      progress.throwIfStopped();
    }
    checkReportBeside();
    checkLabels(progress);
  }

 private:
  void add(std::string id, double value, double limit) {
    result_.checks.push_back({std::move(id), value, limit});
  }

  void checkLung(Side of, const Lobes& lobes) {
    const std::string letter = of == Side::Right ? "R" : "L";
    std::vector<std::pair<RegionId, const TriangleMesh*>> surfaces;
    for (const LobeSurface* lobe : lobes) {
      surfaces.emplace_back(static_cast<RegionId>(lobe->lobe), lobe->mesh.get());
    }
    const Welding welding = weld(surfaces);
    const TriangleMesh outer = outerSurface(welding.complex);
    add("LUNG-" + letter, static_cast<double>(topology(outer).faults()), 0.0);
    add("OVERLAP-" + letter, static_cast<double>(welding.conflicts), 0.0);
    if (welding.sharedTriangles == 0) {
      result_.warnings.push_back("the lobes of the " + std::string(name(of)) +
                                 " lung share no triangles; there are gaps or overlaps between "
                                 "them");
    }
    double sum = 0.0;
    for (const LobeSurface* lobe : lobes) {
      sum += volumeMm3(welding.complex, static_cast<RegionId>(lobe->lobe));
    }
    const double whole = volumeMm3(complexOf(outer, 1), 1);
    add("PARTITION-" + letter, std::abs(sum / whole - 1.0), MostPartitionError);
    for (const Fissure fissure : fissuresOf(of)) checkPatch(fissure, lobes);
  }

  /// Every triangle of the patch has to be one of the lobe below, and of a lobe above turned over.
  void checkPatch(Fissure fissure, const Lobes& lobes) {
    const fs::path path = folder_ / patchFile(fissure);
    std::error_code error;
    if (!fs::exists(path, error)) return;
    const TriangleMesh patch = readSurface(path).mesh;
    result_.inputs.push_back({path.string(), sha256OfFile(path)});
    std::size_t found = 0;
    Lobe last = Lobe::Whole;
    const auto sharedWith = [&](Lobe which, bool isBelow) {
      const auto lobe = std::ranges::find_if(
          lobes, [&](const LobeSurface* surface) { return surface->lobe == which; });
      if (lobe == lobes.end()) return;
      const std::array<std::pair<RegionId, const TriangleMesh*>, 2> both = {
          {{RegionId{1}, (*lobe)->mesh.get()}, {RegionId{2}, &patch}}};
      const Welding welding = weld(both);
      found += isBelow ? welding.conflicts : welding.sharedTriangles;
    };
    for (const auto& [below, above] : lobesBeside(fissure)) {
      if (below != last) sharedWith(below, true);
      sharedWith(above, false);
      last = below;
    }
    add("SHARED-" + std::string(shortName(fissure)),
        std::abs(2.0 * static_cast<double>(patch.triangles.size()) - static_cast<double>(found)),
        0.0);
  }

  void checkReportBeside() {
    const fs::path path = folder_ / LobesReportFile;
    std::error_code error;
    if (!fs::exists(path, error)) return;
    result_.inputs.push_back({path.string(), sha256OfFile(path)});
    const Json report = Json::parse(readFile(path, MostReportBytes), nullptr, false);
    if (!report.is_object() || !report.contains("lobes") || !report["lobes"].is_array()) {
      throw InvalidInput("'" + path.string() + "' is no report of 'pneuma lobes'");
    }
    for (const Json& entry : report["lobes"]) {
      if (!entry.is_object()) continue;
      const std::string which = entry.value("lobe", "");
      const double said = entry.value("volume_ml", 0.0);
      const auto found = std::ranges::find_if(*model_.surfaces, [&](const LobeSurface& surface) {
        return shortName(surface.lobe) == which;
      });
      if (found == model_.surfaces->end()) {
        throw InvalidInput("'" + path.string() + "' speaks of " + which +
                           ", of which there is no surface in the folder");
      }
      const double volume = millilitres(volumeMm3(complexOf(*found->mesh, 1), 1));
      add("VOLUME-" + which, std::abs(volume / said - 1.0), MostVolumeError);
    }
  }

  void checkLabels(const Progress& progress) {
    const fs::path path = folder_ / LobeLabelsFile;
    std::error_code error;
    if (!fs::exists(path, error)) return;
    result_.inputs.push_back({path.string(), sha256OfFile(path)});
    const LabelImage labels = readLabelVolume(path, progress);
    std::size_t inLobes = 0;
    std::size_t other = 0;
    for (const LobeSurface& surface : *model_.surfaces) {
      const auto lobe = static_cast<std::uint8_t>(surface.lobe);
      const std::vector<std::uint8_t> inside =
          voxelsInside(*surface.mesh, labels.geometry, progress);
      for (std::size_t v = 0; v < inside.size(); ++v) {
        const std::uint8_t label = labels.voxels[v];
        if (inside[v] == 0 || label < 1 || label > 5) continue;
        ++inLobes;
        if (label != lobe) ++other;
      }
    }
    add("LABELS", inLobes == 0 ? 1.0 : static_cast<double>(other) / static_cast<double>(inLobes),
        MostOtherVoxels);
  }

  const fs::path& folder_;
  const LungModel& model_;
  LobeFolder& result_;
};

}  // namespace

Json toJson(std::span<const LobeCheck> checks) {
  Json list = Json::array();
  for (const LobeCheck& check : checks) {
    list.push_back(
        {{"id", check.id}, {"value", check.value}, {"limit", check.limit}, {"ok", check.ok()}});
  }
  return list;
}

LobeFolder checkLobes(const fs::path& folder, const Progress& progress) {
  const LungModel model =
      openLobes({&folder, 1}, progress.part(0.0, 0.7, "reading and examining surfaces"));
  LobeFolder result;
  result.inputs = model.inputs;
  result.warnings = model.warnings;
  const auto isLobe = [](const LobeSurface& surface) {
    return std::ranges::count(FiveLobes, surface.lobe) > 0;
  };
  if (std::ranges::none_of(*model.surfaces, isLobe)) {
    throw InvalidInput("'" + folder.string() +
                       "' holds no lobes; their files are called rul, rml, rll, lul and lll");
  }
  Checker(folder, model, result).check(progress.part(0.7, 1.0, "checking lobes"));
  progress.report(1.0);
  return result;
}

Json checkReport(const LobeFolder& folder) {
  Json report = reportEnvelope("pneuma/check/1", folder.inputs, Json::object(), 0);
  report["checks"] = toJson(folder.checks);
  report["warnings"] = folder.warnings;
  report["peak_memory_mb"] = peakMemoryMb();
  return report;
}

std::string checkText(const LobeFolder& folder) {
  std::vector<std::vector<std::string>> rows = {{"check", "found", "at most", ""}};
  const auto number = [](double value) {
    std::array<char, 32> text{};
    std::snprintf(text.data(), text.size(), "%.3g", value);
    return std::string(text.data());
  };
  for (const LobeCheck& check : folder.checks) {
    rows.push_back(
        {check.id, number(check.value), number(check.limit), check.ok() ? "right" : "WRONG"});
  }
  return textTable(rows);
}

}  // namespace pneuma
