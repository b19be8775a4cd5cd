#pragma once

#include <array>
#include <span>
#include <string>

#include "render/colour.h"
#include "render/picture.h"

namespace pneuma {

/// Drawing on pictures pixel by pixel, in pixels from the upper left corner. What lies outside a
/// picture is left out.

enum class Align { Low, Middle, High };

/// Where a text stands: left of, centred on or right of x; above, centred on or below y.
struct TextPlace {
  double x = 0.0;
  double y = 0.0;
  Align horizontal = Align::Low;
  Align vertical = Align::Low;  ///< Low: y is the text's top
};

/// Picture of one colour.
Picture blank(int width, int height, const Rgb& colour);

Rgb pixel(const Picture& picture, int x, int y);
void setPixel(Picture& picture, int x, int y, const Rgb& colour);

/// Copies a picture into another.
void put(const Picture& picture, int left, int top, Picture& into);

/// Fills the pixels whose centres lie in a box, `share` of the colour over what was there.
void fillBox(Picture& picture, double left, double top, double right, double bottom,
             const Rgb& colour, double share = 1.0);

/// A ring about a point. @param share of the colour
void drawRing(Picture& picture, double x, double y, double radius, double thickness,
              const Rgb& colour, double share = 1.0);

/// A line through points (x, y), as thick at its joints as anywhere.
void drawPolyline(Picture& picture, std::span<const std::array<double, 2>> points, double thickness,
                  const Rgb& colour);

/// A line of text in the picture's font, placed by the height of its capitals.
/// @param halo pixels of shadow round it, on a darkened plate, so that it can be read on any ground
void drawText(Picture& picture, const std::string& text, const TextPlace& place, int fontPixels,
              const Rgb& ink, int halo = 0);

}  // namespace pneuma
