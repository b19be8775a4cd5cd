#include <algorithm>
#include <array>
#include <cmath>
#include <sstream>

#include "core/error.h"
#include "render/colour.h"
#include "render/drawing.h"
#include "render/overlay.h"
#include "render/picture.h"

namespace pneuma {
namespace {

constexpr int SmallestFont = 9;
constexpr double SmallestShare = 0.65;  // of the largest font, before lines are cut
constexpr double LineHeight = 1.4;      // in font heights

void requireOneSize(const std::vector<Picture>& pictures, const Picture& legend) {
  if (pictures.empty()) throw InvalidInput("a contact sheet needs a picture or more");
  const Picture& first = pictures.front();
  for (const Picture& picture : pictures) {
    if (picture.width != first.width || picture.height != first.height) {
      throw InvalidInput("the pictures of a contact sheet must have one size");
    }
  }
  if (legend.width > 0 && legend.height != first.height) {
    throw InvalidInput("the legend of a contact sheet must be as high as its pictures");
  }
}

using Caption = std::vector<std::string>;

Caption linesOf(const std::string& text) {
  Caption lines;
  std::istringstream stream(text);
  for (std::string line; std::getline(stream, line);) lines.push_back(line);
  return lines;
}

/// The largest font up to `largest` in which no line is wider than `width`, as far as it can be
/// read.
int fittingFont(const std::vector<Caption>& captions, double width, int largest) {
  const int smallest = std::max(SmallestFont, static_cast<int>(SmallestShare * largest));
  int font = largest;
  for (const Caption& caption : captions) {
    for (const std::string& line : caption) {
      while (font > smallest && Overlay::textWidth(line, font) > width) --font;
    }
  }
  return font;
}

/// The line with as much of its middle left out as it is too wide; "" where there is no room.
std::string shortened(const std::string& line, double width, int font) {
  if (Overlay::textWidth(line, font) <= width) return line;
  std::vector<std::string> characters;  // of UTF-8, whose bytes 10xxxxxx continue one
  for (const char c : line) {
    if (characters.empty() || (static_cast<unsigned char>(c) & 0xC0U) != 0x80U) {
      characters.emplace_back();
    }
    characters.back() += c;
  }
  for (std::size_t kept = characters.size() - 1; kept > 0; --kept) {
    std::string result;
    for (std::size_t i = 0; i < (kept + 1) / 2; ++i) result += characters[i];
    result += "...";
    for (std::size_t i = characters.size() - kept / 2; i < characters.size(); ++i) {
      result += characters[i];
    }
    if (Overlay::textWidth(result, font) <= width) return result;
  }
  return {};
}

}  // namespace

Picture contactSheet(const std::vector<Picture>& pictures, int columns,
                     const std::vector<std::string>& captions, const Picture& legend) {
  requireOneSize(pictures, legend);
  if (columns < 1 || captions.size() != pictures.size()) {
    throw InvalidInput("a contact sheet needs a caption for each picture, and a column or more");
  }
  const int width = pictures.front().width;
  const int height = pictures.front().height;
  const int count = static_cast<int>(pictures.size());
  const int across = std::min(columns, count);
  const int rows = (count + across - 1) / across;
  std::vector<Caption> texts;
  std::size_t lines = 1;
  for (const std::string& caption : captions) {
    texts.push_back(linesOf(caption));
    lines = std::max(lines, texts.back().size());
  }
  const int largest = std::max(11, static_cast<int>(std::lround(0.035 * height)));
  const double room = width - largest;
  const int font = fittingFont(texts, room, largest);
  const auto lineTop = [&](std::size_t line) {
    return static_cast<int>(std::lround(LineHeight * font * static_cast<double>(line)));
  };
  const int cell = height + 2 * font + lineTop(lines - 1);
  Picture sheet{across * width + legend.width, rows * cell, {}};
  sheet.rgb.resize(static_cast<std::size_t>(sheet.width) * static_cast<std::size_t>(sheet.height) *
                   3);
  // The pictures' own ground goes on where there is none, and its lowest row below them.
  for (int y = 0; y < sheet.height; ++y) {
    const Rgb ground = pixel(pictures.front(), 0, std::min(y % cell, height - 1));
    for (int x = 0; x < sheet.width; ++x) setPixel(sheet, x, y, ground);
  }
  const Rgb ground = pixel(pictures.front(), 0, height - 1);
  const Rgb ink = labOf(ground).l > 50.0 ? rgbOfHex(0x1b2330) : rgbOfHex(0xdfe5ee);
  for (int i = 0; i < count; ++i) {
    const int left = i % across * width;
    const int top = i / across * cell;
    const std::size_t index = static_cast<std::size_t>(i);
    put(pictures[index], left, top, sheet);
    for (std::size_t line = 0; line < texts[index].size(); ++line) {
      const TextPlace place{left + 0.5 * width,
                            static_cast<double>(top + height + font + lineTop(line)), Align::Middle,
                            Align::Middle};
      drawText(sheet, shortened(texts[index][line], room, font), place, font, ink);
    }
  }
  for (int row = 0; row < rows; ++row) put(legend, across * width, row * cell, sheet);
  return sheet;
}

}  // namespace pneuma
