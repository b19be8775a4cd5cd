#include "render/stereo.h"

#include <algorithm>
#include <cmath>

#include "core/error.h"

namespace pneuma {
namespace {

/// What an eye behind a red glass sees of a colour, by its brightness.
std::uint8_t brightness(const std::uint8_t* rgb) {
  return static_cast<std::uint8_t>(std::lround(0.299 * rgb[0] + 0.587 * rgb[1] + 0.114 * rgb[2]));
}

Picture anaglyph(const Picture& left, const Picture& right) {
  Picture both = right;
  for (std::size_t n = 0; n < both.rgb.size(); n += 3) both.rgb[n] = brightness(&left.rgb[n]);
  return both;
}

Picture beside(const Picture& a, const Picture& b) {
  Picture both{a.width + b.width, a.height, {}};
  both.rgb.reserve(a.rgb.size() + b.rgb.size());
  const auto row = [&](const Picture& picture, int n) {
    const auto stride = static_cast<std::ptrdiff_t>(3) * picture.width;
    const auto from = picture.rgb.begin() + n * stride;
    both.rgb.insert(both.rgb.end(), from, from + stride);
  };
  for (int n = 0; n < a.height; ++n) {
    row(a, n);
    row(b, n);
  }
  return both;
}

}  // namespace

Picture stereoPicture(const Picture& left, const Picture& right, Stereo stereo) {
  if (left.width != right.width || left.height != right.height) {
    throw InvalidInput("the pictures of two eyes have one size");
  }
  switch (stereo) {
    case Stereo::Anaglyph:
      return anaglyph(left, right);
    case Stereo::SideBySide:
      return beside(left, right);
    case Stereo::Crossed:
      return beside(right, left);
    case Stereo::None:
      break;
  }
  return left;
}

}  // namespace pneuma
