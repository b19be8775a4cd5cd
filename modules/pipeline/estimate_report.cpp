#include <algorithm>
#include <cmath>

#include "core/units.h"
#include "pipeline/estimate.h"
#include "pipeline/lobe_checks.h"
#include "pipeline/report.h"

namespace pneuma {
namespace {

Json errorJson(const LandmarkErrors& errors) {
  const auto json = [](const LandmarkError& error) -> Json {
    return {{"mean_mm", error.meanMm}, {"sd_mm", error.sdMm}};
  };
  return {{"raw", json(errors.raw)},
          {"shift_taken_out", json(errors.shifted)},
          {"shift_and_turn_taken_out", json(errors.rigid)}};
}

/// Infinity has no number in JSON.
Json numberOrNull(double value) { return std::isfinite(value) ? Json(value) : Json(nullptr); }

/// "X qX" ..., or the paper's names.
std::vector<std::string> constantNames(FormKind kind) {
  if (kind == FormKind::Published) {
    return {"c1", "c3", "c2", "c4", "c6", "constant", "c7", "c8", "c9"};
  }
  std::vector<std::string> names;
  const TermChoice terms = termsOf(kind);
  for (int k = 0; k < 3; ++k) {
    for (int j = 0; j < PolynomialForm::Terms; ++j) {
      if (!terms(k, j)) continue;
      names.push_back(std::string(1, "XYZ"[k]) + " " +
                      std::string(PolynomialForm::TermNames[static_cast<std::size_t>(j)]));
    }
  }
  return names;
}

const MotionErrors& errorsOf(const MotionEstimate& estimate, const std::string& motion) {
  return *std::ranges::find(estimate.errors, motion, &MotionErrors::motion);
}

/// On landmarks that were not fitted, where there are some.
const LandmarkErrors& told(const MotionErrors& errors) {
  return errors.heldOut ? *errors.heldOut : errors.fitted;
}

const char* sourceName(StrainSource source) {
  switch (source) {
    case StrainSource::Surfaces:
      return "later surfaces";
    case StrainSource::Gain:
      return "volume taken in";
    case StrainSource::Landmarks:
      return "landmarks";
  }
  return "";
}

}  // namespace

Json estimateReport(std::span<const InputFile> inputs, const EstimateOptions& options,
                    const MotionEstimate& estimate) {
  Json report = reportEnvelope("pneuma/estimate/1", inputs, toJson(options), options.seed);
  const FormFit& fit = estimate.fit;
  report["form"] = textOf(fit.kind);
  report["constants"] = Json::array();
  const std::vector<std::string> names = constantNames(fit.kind);
  const std::vector<double> constants = constantsOf(fit.form, fit.kind);
  for (std::size_t n = 0; n < names.size(); ++n) {
    report["constants"].push_back({{"name", names[n]},
                                   {"value", constants[n]},
                                   {"standard_error", numberOrNull(fit.standardErrors[n])}});
  }
  report["shift_mm"] = {fit.shift.x(), fit.shift.y(), fit.shift.z()};
  report["landmarks"] = {{"fitted", estimate.fittedCount}, {"held_out", estimate.heldOutCount}};
  report["boxes"] = estimate.restMm3.empty() ? "landmarks" : "lungs";
  report["strains_from"] = sourceName(estimate.strainSource);
  report["lungs"] = Json::array();
  for (const auto& [side, lung] : estimate.lungs) {
    Json json = {{"lung", name(side)}, {"strain", lung.strain}};
    const auto rest = estimate.restMm3.find(side);
    if (rest != estimate.restMm3.end()) {
      json["rest_ml"] = millilitres(rest->second);
      json["moved_ml"] = millilitres(rest->second) * std::pow(1.0 + lung.strain, 3.0);
    }
    report["lungs"].push_back(std::move(json));
  }
  report["errors"] = Json::array();
  for (const MotionErrors& row : estimate.errors) {
    Json json = {
        {"motion", row.motion}, {"of_person", row.ofPerson}, {"fitted", errorJson(row.fitted)}};
    if (row.heldOut) json["held_out"] = errorJson(*row.heldOut);
    report["errors"].push_back(std::move(json));
  }
  report["surfaces"] = Json::array();
  for (const WallAgreement& wall : estimate.walls) {
    report["surfaces"].push_back({{"later", wall.later},
                                  {"lung", name(wall.side)},
                                  {"strain", wall.strain},
                                  {"still_mm", wall.stillMm},
                                  {"fitted_mm", wall.fittedMm}});
  }
  report["basis"] =
      "Errors of landmarks that were held out are this person's alone, mostly of vessels deep in "
      "the lung. Surfaces are a weak hint: that they agree does not tell that points move rightly. "
      "Single constants are weakly determined; only the field counts.";
  const std::vector<LobeCheck> checks = {{"BETTER-THAN-SHIFT",
                                          told(errorsOf(estimate, "these constants")).raw.meanMm,
                                          told(errorsOf(estimate, "a shift alone")).raw.meanMm}};
  report["checks"] = toJson(checks);
  report["warnings"] = estimate.warnings;
  return report;
}

}  // namespace pneuma
