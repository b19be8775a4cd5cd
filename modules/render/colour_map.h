#pragma once

#include <cstdint>

#include "anatomy/lobe.h"
#include "render/colour.h"
#include "render/scene.h"

namespace pneuma {

/// The colour of a lobe's surface.
Rgb lobeColour(Lobe lobe, Palette palette);

/// The colour of airways in a lobe: 75 % the lobe's, 25 % ivory; ivory where they are central.
Rgb airwayColour(Lobe lobe, Palette palette);

/// A colour of its own for each of the 18 bronchopulmonary segments (anatomy/segment.h); numbers
/// that are none share these, grey for 0.
Rgb segmentColour(std::uint8_t segment);

/// The colour at `t` in [0, 1] of the continuous scale, violet over teal to yellow. Its lightness
/// rises evenly, so that it reads in grey and with any colour blindness.
Rgb scaleColour(double t);

/// The colour as it is drawn opaque on a background: darker on light ones, where pale airways
/// would be lost.
Rgb onBackground(const Rgb& colour, Background background);

}  // namespace pneuma
