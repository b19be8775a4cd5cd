#pragma once

#include "core/options.h"
#include "io/json.h"
#include "pipeline/lung_model.h"

namespace pneuma {

/// Lungs, airways and checks of a model as JSON: part of the report of `pneuma segment`
/// ("pneuma/segment/1", resources/schemas/segment.schema.json).
/// @pre model.lungs is set
void addLungs(const LungModel& model, Json& report);

/// The same as a table for people.
std::string lungsText(const LungModel& model);

/// A check that failed as a sentence: what, its value, its limits, what to do.
std::string sentence(const SegmentationCheck& check);

}  // namespace pneuma
