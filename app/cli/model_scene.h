#pragma once

#include <vector>

#include "pipeline/lung_model.h"
#include "render/scene.h"

namespace pneuma::cli {

/// What a surface of a model is called that is no lung but the chest wall around one.
inline constexpr const char* ChestWallName = "chest wall";

/// Puts a model's surfaces, but for the `hidden` ones, and its tree into a scene. A chest wall is
/// drawn by its rim alone.
void showModel(Scene& scene, const LungModel& model, const std::vector<Lobe>& hidden = {});

}  // namespace pneuma::cli
