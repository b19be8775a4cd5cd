#pragma once

#include <filesystem>

#include "pipeline/case_export.h"
#include "render/scene.h"

namespace pneuma {

/// To a tenth of a degree, as commands tell it: from there the film of a case is drawn.
ViewDirection toTenths(ViewDirection direction);

/// From where a project was looked at when it was saved; from the front if it does not say.
/// @param view of the project
ViewDirection savedView(const Json& view);

/// writePreset() with the presets that are drawn, too: lungs that breathe as glTF, and as a film.
/// @param view of the film
/// @throws as writePreset(); NoRendering for a film where there is no OpenGL
void exportCase(const std::filesystem::path& folder, ExportPreset preset, const ProjectState& state,
                ViewDirection view, Existing existing, const Progress& progress = {},
                const MadeBreath& breath = {}, const ExportFormat& format = {});

}  // namespace pneuma
