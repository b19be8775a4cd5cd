#pragma once

#include <filesystem>
#include <functional>

#include "cli/picture_arguments.h"
#include "core/progress.h"
#include "pipeline/breathe.h"
#include "render/picture.h"

namespace pneuma::cli {

/// "breath.pvd" -> "breath_0007.png"
std::filesystem::path framePicture(const std::filesystem::path& pvd, int frame);

/// Draws every frame of a breath, all of them from the same place, and hands them on one by one.
/// @throws NoRendering, Cancelled
void drawBreath(const BreathingLungs& lungs, const PictureArguments& arguments,
                const std::function<void(int frame, const Picture& picture)>& take,
                const Progress& progress);

}  // namespace pneuma::cli
