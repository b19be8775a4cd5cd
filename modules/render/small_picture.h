#pragma once

#include <string>

#include "render/picture.h"

namespace pneuma {

/// The picture of a PNG file's content.
/// @param name of where it is from, for the message, such as "the picture in 'case.pneuma'"
/// @throws InvalidInput
Picture pngPicture(const std::string& content, const std::string& name);

/// The picture so small that neither side is longer than `edge` pixels, each new pixel the mean of
/// what it covers; one that is small enough stays as it is.
Picture fitted(const Picture& picture, int edge);

}  // namespace pneuma
