#include "pipeline/fissure_sampling.h"

#include <algorithm>
#include <iterator>

#include "core/error.h"
#include "pipeline/figure_table.h"
#include "pipeline/report.h"

namespace pneuma {
namespace {

std::map<Lobe, TriangleMesh> lobesIn(const LungModel& model) {
  std::map<Lobe, TriangleMesh> lobes;
  for (const LobeSurface& surface : *model.surfaces) lobes[surface.lobe] = *surface.mesh;
  return lobes;
}

Json toJson(const FissureContact& contact) {
  return {{"area_cm2", contact.areaMm2 / 100.0},
          {"triangles", contact.points.size()},
          {"shared", contact.shared},
          {"gap_mean_mm", contact.gapMeanMm},
          {"gap_largest_mm", contact.gapLargestMm}};
}

std::vector<std::string> rowOf(const std::string& name, std::size_t points,
                               const FissureContact& contact) {
  return {name,
          points > 0 ? std::to_string(points) : "",
          fixed(contact.areaMm2 / 100.0, 1) + " cm2",
          fixed(contact.gapMeanMm, 2) + " mm",
          fixed(contact.gapLargestMm, 2) + " mm",
          contact.shared ? "shared" : "near each other"};
}

}  // namespace

SampledFissures sampleFissures(const LungModel& model, const SampleFissuresOptions& options,
                               const Progress& progress) {
  requireValid(options);
  const std::map<Lobe, TriangleMesh> lobes = lobesIn(model);
  SampledFissures sampled;
  Random random(static_cast<std::uint64_t>(options.seed));
  for (const Fissure fissure : ThreeFissures) {
    progress.report(static_cast<double>(fissure) / ThreeFissures.size());
    std::vector<LobePair> pairs = pairsBeside(fissure, lobes);
    if (pairs.empty()) continue;
    FissureContact contact = joined(pairs);
    std::string between;
    for (const LobePair& pair : pairs) {
      between += (between.empty() ? "" : " or ") + std::string(shortName(pair.below)) + " and " +
                 std::string(shortName(pair.above));
    }
    std::ranges::move(pairs, std::back_inserter(sampled.pairs));
    if (contact.points.empty()) {
      sampled.warnings.push_back(between + " do not touch: there is no " +
                                 std::string(longName(fissure)) + " between them");
      continue;
    }
    const auto count = static_cast<std::size_t>(options.points);
    const std::vector<Vec3> places =
        options.seed == 0 ? farthestPoints(contact, count) : spreadPoints(contact, count, random);
    sampled.given[fissure].points = withNoise(places, options.noiseMm, random);
    sampled.contacts[fissure] = std::move(contact);
  }
  if (sampled.given.empty()) {
    throw InvalidInput(sampled.warnings.empty()
                           ? "there are no lobes beside a whole fissure: RUL, RML and RLL, or LUL "
                             "and LLL, are needed"
                           : sampled.warnings.front() +
                                 "; lobes must lie within 5 mm of each other, face to face");
  }
  progress.report(1.0);
  return sampled;
}

Json fissureContactsReport(const LungModel& model, const SampledFissures& sampled,
                           const SampleFissuresOptions& options) {
  Json report = reportEnvelope("pneuma/fissure-contacts/1", model.inputs, toJson(options),
                               static_cast<std::uint64_t>(options.seed));
  for (const auto& [fissure, contact] : sampled.contacts) {
    Json entry = {{"fissure", shortName(fissure)},
                  {"points", sampled.given.at(fissure).points.size()}};
    entry.update(toJson(contact));
    report["fissures"].push_back(std::move(entry));
  }
  for (const LobePair& pair : sampled.pairs) {
    Json entry = {{"below", shortName(pair.below)}, {"above", shortName(pair.above)}};
    entry.update(toJson(pair.contact));
    report["contacts"].push_back(std::move(entry));
  }
  report["warnings"] = model.warnings;
  for (const std::string& warning : sampled.warnings) report["warnings"].push_back(warning);
  return report;
}

std::string fissureContactsText(const SampledFissures& sampled) {
  std::vector<std::vector<std::string>> rows = {
      {"fissure", "points", "contact", "mean gap", "largest", "triangles"}};
  for (const auto& [fissure, contact] : sampled.contacts) {
    rows.push_back(
        rowOf(std::string(shortName(fissure)), sampled.given.at(fissure).points.size(), contact));
  }
  for (const LobePair& pair : sampled.pairs) {
    rows.push_back(
        rowOf(std::string(shortName(pair.below)) + " " + std::string(shortName(pair.above)), 0,
              pair.contact));
  }
  return textTable(rows);
}

}  // namespace pneuma
