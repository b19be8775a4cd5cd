#include <algorithm>
#include <cmath>

#include "core/parallel.h"
#include "pipeline/breathe.h"
#include "pipeline/lobe_checks.h"
#include "pipeline/report.h"

namespace pneuma {
namespace {

constexpr double MostVolumeErrorMl = 1e-6;
constexpr double PaperRms = 0.01;  // of the tidal volume, for five control parameters

Json fitJson(const BreathFit& fit) {
  return {{"resistance_cmH2O_s_per_l", fit.resistance},
          {"compliance_l_per_cmH2O", fit.compliance},
          {"offset_cmH2O", fit.offset},
          {"inertance_cmH2O_s2_per_l", fit.inertance},
          {"measured_tidal_ml", 1000.0 * fit.tidal},
          {"rms_percent", 100.0 * fit.rms},
          {"simulations", fit.simulations}};
}

/// How far the moved surfaces' volumes of a lung are from the curve's, at most, ml.
double volumeErrorMl(const BreathingLungs& lungs, Side side) {
  std::vector<double> errors(lungs.frames.size());
  parallelFor(errors.size(), [&](std::size_t n) {
    const BreathFrame& frame = lungs.frames[n];
    double sum = 0.0;
    for (const MovingSurface& surface : lungs.surfaces) {
      if (surface.side != side) continue;
      sum += movedVolumeMm3(*surface.surface.mesh, surface.displacement, frame.scale.at(side)) /
             1000.0;
    }
    errors[n] = std::abs(sum - frame.volumeMl.at(side));
  });
  return errors.empty() ? 0.0 : *std::ranges::max_element(errors);
}

/// What the displacements rest upon, in whole sentences.
std::string basisOf(const BreatheOptions& options) {
  const std::string values =
      " Pressures, flows and diseases are plausible values, reasoned and not measured.";
  if (options.model != MotionModel::Preset) {
    const std::string response =
        options.model == MotionModel::Published
            ? "the spring network of Santhanam 2008"
            : "an elastic surface in place of the springs of Santhanam 2008";
    return "Displacements by " + response +
           ", its force law and its directions, whose constants are not in print: reasoned, not "
           "measured. Landmarks of people in a deep breath end further from their places than "
           "without any motion." +
           values;
  }
  if (options.posture != Posture::Supine) {
    return "Displacements by " +
           (options.person ? basisOf(*options.person)
                           : std::string("constants fitted to landmarks of people (supine)")) +
           ", and the difference that an elastic surface makes between supine and " +
           std::string(choices(Posture{})[static_cast<std::size_t>(options.posture)]) +
           ": reasoned, not measured." + values;
  }
  if (options.person) return "Displacements by " + basisOf(*options.person) + "." + values;
  return "Displacements by constants fitted to landmarks of people (supine); typical error 3 to 4 "
         "mm "
         "in quiet breathing, 7 to 10 mm in a deep breath." +
         values;
}

}  // namespace

Json breatheReport(const LungModel& model, const BreathingLungs& lungs,
                   const BreatheOptions& options) {
  Json report = reportEnvelope("pneuma/breathe/1", model.inputs, toJson(options), 0);
  report["scenario"] = scenarioOf(options.scenario).title;
  report["basis"] = basisOf(options);
  if (!options.regions.empty()) {
    report["regions"] = toJson(options.regions);
    report["basis"] = report["basis"].get<std::string>() +
                      " So are stiff and soft regions, and how they change compliance.";
  }
  report["breath"] = {{"period_s", lungs.drive.period},
                      {"drive_cmH2O", lungs.drive.peak},
                      {"tidal_ml", 1000.0 * lungs.cycle.tidal},
                      {"trapped_ml", 1000.0 * lungs.cycle.trapped},
                      {"peak_inspiratory_ml_per_s", 1000.0 * lungs.cycle.peakInspiratory},
                      {"peak_expiratory_ml_per_s", 1000.0 * lungs.cycle.peakExpiratory}};
  if (options.fit) {
    report["scenario"] = "Measured breath";
    report["fit"] = fitJson(*options.fit);
    if (options.fit->rms > PaperRms) {
      report["warnings"].push_back(
          "The fitted curve differs by more than 1 % of the volume of the measured breath; look at "
          "it with --curve.");
    }
  }
  if (options.person) report["constants"] = toJson(*options.person);
  report["lungs"] = Json::array();
  std::vector<LobeCheck> checks;
  for (const auto& [of, motion] : lungs.motion) {
    const auto volume = [&](const BreathFrame& frame) { return frame.volumeMl.at(of); };
    const auto [least, most] = std::ranges::minmax_element(lungs.frames, {}, volume);
    report["lungs"].push_back({{"lung", name(of)},
                               {"rest_ml", lungs.volume.at(of).a[0] / 1000.0},
                               {"least_ml", volume(*least)},
                               {"most_ml", volume(*most)},
                               {"layer_mm", motion.layerMm()},
                               {"fold_scale", LungMotion::SafeTimes * motion.maxScale()},
                               {"least_determinant", lungs.leastDeterminant.at(of)}});
    const std::string suffix = of == Side::Right ? "-R" : "-L";
    checks.push_back({"VOLUME" + suffix, volumeErrorMl(lungs, of), MostVolumeErrorMl});
    checks.push_back({"INVERTED" + suffix, lungs.leastDeterminant.at(of) > 0.0 ? 0.0 : 1.0, 0.0});
  }
  if (lungs.chestWall) {
    report["pleural_gap"] = {{"lung", name(lungs.chestWall->side())},
                             {"gap_ml", pleuralGapMl(lungs)},
                             {"chest_wall_rest_ml", lungs.chestWall->restMm3() / 1000.0}};
  }
  report["checks"] = toJson(checks);
  for (const std::string& warning : lungs.warnings) report["warnings"].push_back(warning);
  report["peak_memory_mb"] = peakMemoryMb();
  return report;
}

}  // namespace pneuma
