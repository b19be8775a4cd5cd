#pragma once

#include <chrono>
#include <map>
#include <string>

#include "anatomy/morphometry.h"
#include "io/json.h"
#include "pipeline/lung_model.h"

namespace pneuma {

/// "0.1.0" and the commit it was built from ("unknown" outside a checkout).
std::string versionText();
std::string commitText();

/// The envelope every JSON report starts with: schema, app, inputs, parameters, seed, frame, units,
/// checks and warnings (both empty arrays), to be filled by the caller.
Json reportEnvelope(std::string_view schema, std::span<const InputFile> inputs, Json parameters,
                    std::uint64_t seed);

/// Largest resident memory of this process so far, MB.
double peakMemoryMb();

/// The report of `pneuma grow` ("pneuma/growth/1", resources/schemas/growth.schema.json).
/// @param measureSeconds, writeSeconds for "timing_s"
Json growthReport(const LungModel& model, const Morphometry& whole,
                  const std::map<Lobe, Morphometry>& byLobe, double measureSeconds,
                  double writeSeconds);

/// Field data of a tree file: method, options, seed, version; of one that was not grown the version
/// alone.
std::map<std::string, std::string> treeMetadata(const LungModel& model);

}  // namespace pneuma
