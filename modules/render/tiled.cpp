#include <algorithm>

#include "core/error.h"
#include "render/drawing.h"
#include "render/picture.h"

namespace pneuma {
namespace {

constexpr Rgb LineColour = rgbOfHex(0x2c3340);

}  // namespace

Picture tiled(const std::vector<Picture>& pictures, int columns) {
  if (pictures.empty() || columns < 1) {
    throw InvalidInput("tiles need a picture or more, and a column or more");
  }
  const int width = pictures.front().width;
  const int height = pictures.front().height;
  const int count = static_cast<int>(pictures.size());
  const int across = std::min(columns, count);
  const int rows = (count + across - 1) / across;
  Picture sheet = blank(across * (width + TileLine) - TileLine,
                        rows * (height + TileLine) - TileLine, LineColour);
  const Picture empty = blank(width, height, {});
  for (int i = 0; i < across * rows; ++i) {
    const Picture& tile = i < count ? pictures[static_cast<std::size_t>(i)] : empty;
    if (tile.width != width || tile.height != height) {
      throw InvalidInput("the pictures of a sheet must have one size");
    }
    put(tile, i % across * (width + TileLine), i / across * (height + TileLine), sheet);
  }
  return sheet;
}

}  // namespace pneuma
