#pragma once

#include <array>
#include <string_view>

#include "render/picture.h"

namespace pneuma {

/// How two eyes get their pictures: by red and cyan glasses, side by side for a viewer (the left
/// eye's on the left), or for eyes that cross (the left eye's on the right).
enum class Stereo { None, Anaglyph, SideBySide, Crossed };

constexpr auto choices(Stereo) {
  return std::array<std::string_view, 4>{"none", "anaglyph", "side-by-side", "crossed"};
}

struct StereoOptions {
  Stereo stereo = Stereo::None;
  double eyeDistanceMm = 65.0;  ///< in the scene; people's is about 65 mm
};

/// Renders a scene for two eyes, as renderPicture() does for one. The eyes look straight ahead
/// through windows of their own (off-axis), so that nothing is shifted up or down between them and
/// what lies as deep as the camera's focus lies in the plane of the screen, annotations with it.
/// Half a width each if side by side. Anaglyphs are half-coloured: grey for the left eye.
/// @throws as renderPicture(); InvalidOption for a distance that is not above 0
Picture renderStereo(Scene& scene, int width, int height, const StereoOptions& options);

/// The pictures of both eyes as one.
/// @pre they have one size @throws InvalidInput otherwise
Picture stereoPicture(const Picture& left, const Picture& right, Stereo stereo);

}  // namespace pneuma
