#pragma once

#include <vector>

#include "pipeline/lung_model.h"
#include "render/scene.h"

namespace pneuma::cli {

/// Puts a model's surfaces, but for the `hidden` ones, and its tree into a scene.
void showModel(Scene& scene, const LungModel& model, const std::vector<Lobe>& hidden = {});

}  // namespace pneuma::cli
