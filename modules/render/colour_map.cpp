#include "render/colour_map.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "anatomy/segment.h"

namespace pneuma {
namespace {

constexpr Rgb Ivory = {0.94, 0.91, 0.86};
constexpr Rgb Neutral = rgbOfHex(0x9fb0c3);

// Control points of the scale in L*a*b*, equally spaced; lightness rises by 11 each.
constexpr std::array<Lab, 6> Scale = {{{38.0, 38.0, -62.0},
                                       {49.0, 6.0, -46.0},
                                       {60.0, -20.0, -22.0},
                                       {71.0, -40.0, 12.0},
                                       {82.0, -30.0, 56.0},
                                       {93.0, -8.0, 82.0}}};

// Neighbouring segments differ in hue and in lightness.
constexpr std::array<std::uint32_t, 18> SegmentColours = {
    0x4aa8ff, 0xf2b544, 0x2fbf8f, 0xe4572e, 0xb58cf0, 0xd9e650, 0x1f78d8, 0xff9ecf, 0x7a9a3c,
    0x8fe3f5, 0xb8543f, 0x5f6fd0, 0xffd9a0, 0x2b8f8a, 0xe23d80, 0x9fd98a, 0x9a6ab0, 0xc9a227};

}  // namespace

Rgb lobeColour(Lobe lobe, Palette palette) {
  if (palette == Palette::Huang) {
    // Huang 2004, Fig. 5: upper lobes red, middle lobe green, lower lobes blue.
    switch (lobe) {
      case Lobe::RightUpper:
      case Lobe::LeftUpper:
        return rgbOfHex(0xe8483f);
      case Lobe::RightMiddle:
        return rgbOfHex(0x3fc25a);
      case Lobe::RightLower:
      case Lobe::LeftLower:
        return rgbOfHex(0x4a74f0);
      default:
        break;
    }
  }
  switch (lobe) {
    case Lobe::RightUpper:
      return rgbOfHex(0x66c2f0);
    case Lobe::RightMiddle:
      return rgbOfHex(0xfacc6b);
    case Lobe::RightLower:
      return rgbOfHex(0x73d49e);
    case Lobe::LeftUpper:
      return rgbOfHex(0xe68c9e);
    case Lobe::LeftLower:
      return rgbOfHex(0xad99eb);
    case Lobe::Central:
      return Ivory;
    // Whole lungs, before they are split: none of the lobes' colours, dark right and light left.
    case Lobe::RightLung:
      return rgbOfHex(0x3d8fe0);
    case Lobe::LeftLung:
      return rgbOfHex(0xffb385);
    case Lobe::Whole:
      break;
  }
  return Neutral;
}

Rgb airwayColour(Lobe lobe, Palette palette) {
  return mixed(lobeColour(lobe, palette), Ivory, 0.25);
}

Rgb segmentColour(std::uint8_t segment) {
  if (segment == 0) return Neutral;
  const auto named = segments();
  const auto found = std::ranges::find(named, segment, &Segment::number);
  const std::size_t place =
      found != named.end() ? static_cast<std::size_t>(found - named.begin()) : segment - 1U;
  return rgbOfHex(SegmentColours[place % SegmentColours.size()]);
}

Rgb scaleColour(double t) {
  const double position = std::clamp(t, 0.0, 1.0) * (Scale.size() - 1);
  const std::size_t i = std::min(static_cast<std::size_t>(position), Scale.size() - 2);
  const double share = position - static_cast<double>(i);
  const Lab& a = Scale[i];
  const Lab& b = Scale[i + 1];
  return rgbOf(
      Lab{std::lerp(a.l, b.l, share), std::lerp(a.a, b.a, share), std::lerp(a.b, b.b, share)});
}

Rgb onBackground(const Rgb& colour, Background background) {
  if (background == Background::Dark) return colour;
  Lab lab = labOf(colour);
  lab.l *= 0.80;
  return rgbOf(lab);
}

}  // namespace pneuma
