#pragma once

#include "pipeline/split_lobes.h"

namespace pneuma {

/// The surfaces of whole lungs that a model has: those that it shows, or those that were split into
/// the lobes that it shows. Null if it has none.
std::shared_ptr<const std::vector<LobeSurface>> wholeLungsOf(const LungModel& model);

/// The same with its whole lungs in lobes, to grow in; a model in lobes is split anew. What was
/// grown before stays, in the lobes that were there.
/// @throws as splitLobes()
LungModel withLobes(const LungModel& model, const LobeInputs& inputs,
                    const LobeOptions& options = {}, const Progress& progress = {});

}  // namespace pneuma
