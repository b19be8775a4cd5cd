#include <algorithm>
#include <array>
#include <cmath>

#include <vtkImageData.h>
#include <vtkNew.h>
#include <vtkStdString.h>
#include <vtkTextProperty.h>
#include <vtkTextRenderer.h>

#include "core/error.h"
#include "render/colour.h"
#include "render/font.h"
#include "render/picture.h"

namespace pneuma {
namespace {

constexpr int LogicalDpi = 72;

Rgb pixel(const Picture& picture, int x, int y) {
  const std::size_t at = (static_cast<std::size_t>(y) * static_cast<std::size_t>(picture.width) +
                          static_cast<std::size_t>(x)) *
                         3;
  return {picture.rgb[at] / 255.0, picture.rgb[at + 1] / 255.0, picture.rgb[at + 2] / 255.0};
}

void setPixel(Picture& picture, int x, int y, const Rgb& colour) {
  if (x < 0 || y < 0 || x >= picture.width || y >= picture.height) return;
  const std::size_t at = (static_cast<std::size_t>(y) * static_cast<std::size_t>(picture.width) +
                          static_cast<std::size_t>(x)) *
                         3;
  const std::array<double, 3> channels = {colour.r, colour.g, colour.b};
  for (std::size_t channel = 0; channel < 3; ++channel) {
    picture.rgb[at + channel] = static_cast<std::uint8_t>(std::lround(channels[channel] * 255.0));
  }
}

/// Writes a line of text, centred on `centreX` with its baseline region round `centreY`.
void drawText(Picture& picture, const std::string& text, int centreX, int centreY, int fontPixels,
              const Rgb& ink) {
  vtkTextRenderer* renderer = vtkTextRenderer::GetInstance();
  if (renderer == nullptr || text.empty()) return;
  vtkNew<vtkTextProperty> property;
  setFont(property, fontPixels);
  property->SetColor(ink.r, ink.g, ink.b);
  vtkNew<vtkImageData> image;
  std::array<int, 2> size{};
  if (!renderer->RenderString(property, text, image, size.data(), LogicalDpi)) return;
  for (int y = 0; y < size[1]; ++y) {
    for (int x = 0; x < size[0]; ++x) {
      const auto* rgba = static_cast<const std::uint8_t*>(image->GetScalarPointer(x, y, 0));
      const int column = centreX - size[0] / 2 + x;
      const int row = centreY + size[1] / 2 - y;
      if (rgba[3] == 0 || column < 0 || row < 0 || column >= picture.width ||
          row >= picture.height) {
        continue;
      }
      setPixel(picture, column, row, mixed(pixel(picture, column, row), ink, rgba[3] / 255.0));
    }
  }
}

}  // namespace

Picture contactSheet(const std::vector<Picture>& pictures, int columns,
                     const std::vector<std::string>& captions) {
  if (pictures.empty() || columns < 1 || captions.size() != pictures.size()) {
    throw InvalidInput("a contact sheet needs pictures, a caption for each, and a column or more");
  }
  const int width = pictures.front().width;
  const int height = pictures.front().height;
  for (const Picture& picture : pictures) {
    if (picture.width != width || picture.height != height) {
      throw InvalidInput("the pictures of a contact sheet must have one size");
    }
  }
  const int count = static_cast<int>(pictures.size());
  const int across = std::min(columns, count);
  const int rows = (count + across - 1) / across;
  const int font = std::max(11, static_cast<int>(std::lround(0.035 * height)));
  const int cell = height + 2 * font;
  Picture sheet{across * width, rows * cell, {}};
  sheet.rgb.resize(static_cast<std::size_t>(sheet.width) * static_cast<std::size_t>(sheet.height) *
                   3);
  const Rgb ground = pixel(pictures.front(), 0, height - 1);
  for (int y = 0; y < sheet.height; ++y) {
    for (int x = 0; x < sheet.width; ++x) setPixel(sheet, x, y, ground);
  }
  const Rgb ink = labOf(ground).l > 50.0 ? rgbOfHex(0x1b2330) : rgbOfHex(0xdfe5ee);
  for (int i = 0; i < count; ++i) {
    const int left = i % across * width;
    const int top = i / across * cell;
    const std::size_t index = static_cast<std::size_t>(i);
    for (int y = 0; y < height; ++y) {
      for (int x = 0; x < width; ++x) {
        setPixel(sheet, left + x, top + y, pixel(pictures[index], x, y));
      }
    }
    drawText(sheet, captions[index], left + width / 2, top + height + font, font, ink);
  }
  return sheet;
}

}  // namespace pneuma
