#pragma once

#include "core/options.h"
#include "io/json.h"
#include "pipeline/lung_model.h"

namespace pneuma {

/// The report of `pneuma segment` ("pneuma/segment/1", resources/schemas/segment.schema.json):
/// lungs, airways and checks of a model. @pre model.lungs is set
/// @param readSeconds, findSeconds for "timing_s"
Json segmentReport(const LungModel& model, const LungOptions& options, double readSeconds,
                   double findSeconds);

/// The same as a table for people.
std::string lungsText(const LungModel& model);

/// A check that failed as a sentence: what, its value, its limits, what to do.
std::string sentence(const SegmentationCheck& check);

}  // namespace pneuma
