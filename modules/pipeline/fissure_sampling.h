#pragma once

#include <map>
#include <string>
#include <tuple>
#include <vector>

#include "core/options.h"
#include "io/fissure_file.h"
#include "io/json.h"
#include "lobes/contact_sampling.h"
#include "pipeline/lung_model.h"

namespace pneuma {

struct SampleFissuresOptions {
  int points = 25;
  double noiseMm = 0.0;
  int seed = 0;

  static constexpr auto fields() {
    using O = SampleFissuresOptions;
    return std::tuple{
        Field{"points", &O::points, "", Range{3, 2000}, "Points upon each fissure."},
        Field{"noise", &O::noiseMm, "mm", Range{0.0, 50.0},
              "Standard deviation along each axis by which they miss it."},
        Field{"seed", &O::seed, "", Range{0, 1e9},
              "Draws the places and the noise; 0: no places by chance, each the farthest from "
              "those before."},
    };
  }

  bool operator==(const SampleFissuresOptions&) const = default;
};

struct SampledFissures {
  GivenFissures given;  ///< points upon each fissure
  std::map<Fissure, FissureContact> contacts;
  std::vector<LobePair> pairs;
  std::vector<std::string> warnings;  ///< whole sentences
};

/// Points upon the true fissures between lobes that touch.
/// @param model with surfaces of lobes
/// @throws InvalidInput if no fissure lies between the lobes, or one is too small for the points;
/// Cancelled
SampledFissures sampleFissures(const LungModel& model, const SampleFissuresOptions& options = {},
                               const Progress& progress = {});

/// The report of `pneuma fissures` ("pneuma/fissure-contacts/1").
Json fissureContactsReport(const LungModel& model, const SampledFissures& sampled,
                           const SampleFissuresOptions& options);

/// For people.
std::string fissureContactsText(const SampledFissures& sampled);

}  // namespace pneuma
