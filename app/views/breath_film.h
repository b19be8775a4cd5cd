#pragma once

#include <string>

#include "core/progress.h"
#include "pipeline/breathe.h"
#include "render/scene.h"

namespace pneuma {

/// Pictures a second of breathFilm(): lungs move without steps.
inline constexpr int FilmRate = 25;

/// How many pictures the film of a breath has, at least 1.
int filmPictures(const BreathingLungs& lungs);

/// One breath as a film, as fast as it is breathed: Theora in Ogg (.ogv), 800 x 600. It begins
/// where it ends, so that players can repeat it.
/// @throws NoRendering where there is no OpenGL; OutputFailed without room for it; Cancelled
std::string breathFilm(const BreathingLungs& lungs, ViewDirection view,
                       const Progress& progress = {});

}  // namespace pneuma
