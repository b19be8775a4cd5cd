#include "render/drawing.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include <vtkImageData.h>
#include <vtkNew.h>
#include <vtkStdString.h>
#include <vtkTextProperty.h>
#include <vtkTextRenderer.h>

#include "render/font.h"
#include "render/tube_mesh.h"
#include "render/vtk_globals.h"

namespace pneuma {
namespace {

constexpr int LogicalDpi = 72;
constexpr Rgb HaloColour = {0.0, 0.0, 0.0};
constexpr double HaloShare = 0.8;
constexpr double PlateShare = 0.5;

std::uint8_t* bytesAt(Picture& picture, int x, int y) {
  return picture.rgb.data() +
         (static_cast<std::size_t>(y) * static_cast<std::size_t>(picture.width) +
          static_cast<std::size_t>(x)) *
             3;
}

bool contains(const Picture& picture, int x, int y) {
  return x >= 0 && y >= 0 && x < picture.width && y < picture.height;
}

void mix(Picture& picture, int x, int y, const std::array<std::uint8_t, 3>& colour, double share) {
  if (!contains(picture, x, y)) return;
  std::uint8_t* bytes = bytesAt(picture, x, y);
  for (std::size_t c = 0; c < 3; ++c) {
    bytes[c] = static_cast<std::uint8_t>(std::lround(bytes[c] + (colour[c] - bytes[c]) * share));
  }
}

/// How much of each pixel a text covers, 0 .. 255, row by row from the top.
struct TextMask {
  int width = 0;
  int height = 0;
  std::vector<std::uint8_t> cover;

  int at(int x, int y) const {
    return x < 0 || y < 0 || x >= width || y >= height
               ? 0
               : cover[static_cast<std::size_t>(y) * static_cast<std::size_t>(width) +
                       static_cast<std::size_t>(x)];
  }
};

/// As high for every text of one font.
TextMask maskOf(const std::string& text, int fontPixels) {
  TextMask mask;
  prepareVtk();
  vtkTextRenderer* renderer = vtkTextRenderer::GetInstance();
  if (renderer == nullptr || text.empty()) return mask;
  vtkNew<vtkTextProperty> property;
  setFont(property, fontPixels);
  property->SetColor(1.0, 1.0, 1.0);
  vtkNew<vtkImageData> image;
  std::array<int, 2> size{};
  if (!renderer->RenderString(property, text, image, size.data(), LogicalDpi)) return mask;
  const int* first = image->GetExtent();
  mask.width = size[0];
  mask.height = size[1];
  for (int y = size[1] - 1; y >= 0; --y) {
    for (int x = 0; x < size[0]; ++x) {
      mask.cover.push_back(static_cast<const std::uint8_t*>(
          image->GetScalarPointer(first[0] + x, first[2] + y, 0))[3]);
    }
  }
  return mask;
}

/// Rows of a font's masks between which its capitals stand.
struct Capitals {
  int top = 0;
  int bottom = 0;
};

Capitals capitalsOf(int fontPixels) {
  const TextMask mask = maskOf("H", fontPixels);
  Capitals capitals{mask.height, 0};
  for (int y = 0; y < mask.height; ++y) {
    for (int x = 0; x < mask.width; ++x) {
      if (mask.at(x, y) < 128) continue;
      capitals.top = std::min(capitals.top, y);
      capitals.bottom = std::max(capitals.bottom, y + 1);
    }
  }
  return capitals;
}

double aligned(double at, double size, Align align) {
  return align == Align::Low ? at : align == Align::Middle ? at - 0.5 * size : at - size;
}

}  // namespace

Picture blank(int width, int height, const Rgb& colour) {
  Picture picture{width, height, {}};
  picture.rgb.resize(static_cast<std::size_t>(width) * static_cast<std::size_t>(height) * 3);
  const std::array<std::uint8_t, 3> bytes = bytesOf(colour);
  for (std::size_t i = 0; i < picture.rgb.size(); ++i) picture.rgb[i] = bytes[i % 3];
  return picture;
}

Rgb pixel(const Picture& picture, int x, int y) {
  const std::size_t at = (static_cast<std::size_t>(y) * static_cast<std::size_t>(picture.width) +
                          static_cast<std::size_t>(x)) *
                         3;
  return {picture.rgb[at] / 255.0, picture.rgb[at + 1] / 255.0, picture.rgb[at + 2] / 255.0};
}

void setPixel(Picture& picture, int x, int y, const Rgb& colour) {
  if (contains(picture, x, y)) std::ranges::copy(bytesOf(colour), bytesAt(picture, x, y));
}

void put(const Picture& picture, int left, int top, Picture& into) {
  for (int y = 0; y < picture.height; ++y) {
    for (int x = 0; x < picture.width; ++x) {
      setPixel(into, left + x, top + y, pixel(picture, x, y));
    }
  }
}

void fillBox(Picture& picture, double left, double top, double right, double bottom,
             const Rgb& colour, double share) {
  const std::array<std::uint8_t, 3> bytes = bytesOf(colour);
  const int firstX = std::max(0, static_cast<int>(std::lround(left)));
  const int firstY = std::max(0, static_cast<int>(std::lround(top)));
  const int endX = std::min(picture.width, static_cast<int>(std::lround(right)));
  const int endY = std::min(picture.height, static_cast<int>(std::lround(bottom)));
  for (int y = firstY; y < endY; ++y) {
    for (int x = firstX; x < endX; ++x) mix(picture, x, y, bytes, share);
  }
}

void drawRing(Picture& picture, double x, double y, double radius, double thickness,
              const Rgb& colour, double share) {
  const std::array<std::uint8_t, 3> bytes = bytesOf(colour);
  const int reach = static_cast<int>(std::ceil(radius + thickness)) + 1;
  const int middleX = static_cast<int>(std::floor(x));
  const int middleY = static_cast<int>(std::floor(y));
  for (int row = middleY - reach; row <= middleY + reach; ++row) {
    for (int column = middleX - reach; column <= middleX + reach; ++column) {
      const double distance = std::hypot(column + 0.5 - x, row + 0.5 - y);
      const double cover =
          std::clamp(0.5 * thickness + 0.5 - std::abs(distance - radius), 0.0, 1.0);
      if (cover > 0.0) mix(picture, column, row, bytes, cover * share);
    }
  }
}

void drawPolyline(Picture& picture, std::span<const std::array<double, 2>> points, double thickness,
                  const Rgb& colour) {
  const auto width = static_cast<std::size_t>(picture.width);
  std::vector<double> cover(width * static_cast<std::size_t>(picture.height), 0.0);
  const double reach = 0.5 * thickness + 1.0;
  for (std::size_t n = 1; n < points.size(); ++n) {
    const auto [ax, ay] = points[n - 1];
    const auto [bx, by] = points[n];
    const double squared = (bx - ax) * (bx - ax) + (by - ay) * (by - ay);
    const int firstX = std::max(0, static_cast<int>(std::floor(std::min(ax, bx) - reach)));
    const int firstY = std::max(0, static_cast<int>(std::floor(std::min(ay, by) - reach)));
    const int endX = std::min(picture.width, static_cast<int>(std::ceil(std::max(ax, bx) + reach)));
    const int endY =
        std::min(picture.height, static_cast<int>(std::ceil(std::max(ay, by) + reach)));
    for (int y = firstY; y < endY; ++y) {
      for (int x = firstX; x < endX; ++x) {
        const double dx = x + 0.5 - ax;
        const double dy = y + 0.5 - ay;
        const double along =
            squared > 0.0 ? std::clamp((dx * (bx - ax) + dy * (by - ay)) / squared, 0.0, 1.0) : 0.0;
        const double distance = std::hypot(dx - along * (bx - ax), dy - along * (by - ay));
        double& most = cover[static_cast<std::size_t>(y) * width + static_cast<std::size_t>(x)];
        most = std::max(most, std::clamp(0.5 * thickness + 0.5 - distance, 0.0, 1.0));
      }
    }
  }
  const std::array<std::uint8_t, 3> bytes = bytesOf(colour);
  for (std::size_t n = 0; n < cover.size(); ++n) {
    if (cover[n] > 0.0) {
      mix(picture, static_cast<int>(n % width), static_cast<int>(n / width), bytes, cover[n]);
    }
  }
}

void drawText(Picture& picture, const std::string& text, const TextPlace& place, int fontPixels,
              const Rgb& ink, int halo) {
  const TextMask mask = maskOf(text, fontPixels);
  if (mask.cover.empty()) return;
  const Capitals capitals = capitalsOf(fontPixels);
  const int firstX = static_cast<int>(std::lround(aligned(place.x, mask.width, place.horizontal)));
  const int firstY = static_cast<int>(std::lround(
                         aligned(place.y, capitals.bottom - capitals.top, place.vertical))) -
                     capitals.top;
  if (halo > 0) {
    const double pad = 3.0 * halo;
    fillBox(picture, firstX - pad, firstY + capitals.top - pad, firstX + mask.width + pad,
            firstY + capitals.bottom + pad, HaloColour, PlateShare);
    for (int y = -halo; y < mask.height + halo; ++y) {
      for (int x = -halo; x < mask.width + halo; ++x) {
        int most = 0;
        for (int dy = -halo; dy <= halo; ++dy) {
          for (int dx = -halo; dx <= halo; ++dx) most = std::max(most, mask.at(x + dx, y + dy));
        }
        if (most > 0) {
          mix(picture, firstX + x, firstY + y, bytesOf(HaloColour), HaloShare * most / 255.0);
        }
      }
    }
  }
  const std::array<std::uint8_t, 3> colour = bytesOf(ink);
  for (int y = 0; y < mask.height; ++y) {
    for (int x = 0; x < mask.width; ++x) {
      if (mask.at(x, y) > 0) {
        mix(picture, firstX + x, firstY + y, colour, mask.at(x, y) / 255.0);
      }
    }
  }
}

}  // namespace pneuma
