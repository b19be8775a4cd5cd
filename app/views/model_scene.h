#pragma once

#include <memory>
#include <vector>

#include "pipeline/lung_model.h"
#include "render/scene.h"

namespace pneuma {

/// What a surface of a model is called that is no lung but the chest wall around one.
inline constexpr const char* ChestWallName = "chest wall";

/// A model's surfaces as they are drawn, in their order; none of null.
std::vector<SceneSurface> sceneSurfaces(
    const std::shared_ptr<const std::vector<LobeSurface>>& surfaces);

/// Puts a model's surfaces, but for the `hidden` ones, and its tree into a scene. A chest wall is
/// drawn by its rim alone.
void showModel(Scene& scene, const LungModel& model, const std::vector<Lobe>& hidden = {});

}  // namespace pneuma
