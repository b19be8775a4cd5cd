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

/// How frames of a breath are drawn.
struct FrameArguments {
  PictureArguments look;
  bool onionSkin = false;  ///< the ends of expiration and inspiration, too
};

/// Draws every frame of a breath, all of them from the same place, and hands them on one by one.
/// @throws NoRendering, Cancelled
void drawBreath(const BreathingLungs& lungs, const FrameArguments& arguments,
                const std::function<void(int frame, const Picture& picture)>& take,
                const Progress& progress);

}  // namespace pneuma::cli
