#pragma once

#include <string>

#include "render/picture.h"

namespace pneuma {

/// The longest side of a picture that is read unless somebody says otherwise, pixels.
constexpr int LargestPictureSide = 16384;

/// The picture of a PNG file's content.
/// @param name of where it is from, for the message, such as "the picture in 'case.pneuma'"
/// @param largestSide pixels; a small file may state a picture of gigabytes
/// @throws InvalidInput; Error (OutOfMemory) before anything is decoded
Picture pngPicture(const std::string& content, const std::string& name,
                   int largestSide = LargestPictureSide);

/// The picture so small that neither side is longer than `edge` pixels, each new pixel the mean of
/// what it covers; one that is small enough stays as it is.
Picture fitted(const Picture& picture, int edge);

}  // namespace pneuma
