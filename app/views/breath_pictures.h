#pragma once

#include <functional>
#include <span>

#include "core/progress.h"
#include "pipeline/breathe.h"
#include "render/picture.h"
#include "render/scene.h"

namespace pneuma {

/// How moments of a breath are drawn.
struct BreathLook {
  SceneOptions options{};
  ViewDirection view{};
  int width = 1200;        ///< pixels
  int height = 900;        ///< pixels
  bool onionSkin = false;  ///< the ends of expiration and inspiration, too
};

/// s of each lung, and of the chest wall, at a moment.
BreathScale breathScale(const BreathFrame& frame);

/// Draws moments of a breath, all of them from the same place, and hands them on one by one.
/// @param take gets each with its place in `frames`; may throw
/// @throws NoRendering; InvalidOption for a size that renderPicture() refuses; Cancelled
void drawBreath(const BreathingLungs& lungs, std::span<const BreathFrame> frames,
                const BreathLook& look,
                const std::function<void(int frame, const Picture& picture)>& take,
                const Progress& progress = {});

}  // namespace pneuma
