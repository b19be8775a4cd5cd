#include "cli/slice_sheet.h"

#include <algorithm>
#include <cmath>

namespace pneuma::cli {
namespace {

constexpr int MostInARow = 3;
constexpr int SmallestTile = 16;

/// Up to three beside each other, more in a square.
int columnsFor(int tiles) {
  if (tiles <= MostInARow) return tiles;
  return static_cast<int>(std::ceil(std::sqrt(static_cast<double>(tiles))));
}

}  // namespace

Picture sliceSheet(const LungModel& model, const std::vector<WantedSlice>& wanted,
                   const std::vector<Vec3>& markers, const SliceLook& look, const PictureSize& size,
                   const ScenePicture& scene) {
  const int count = static_cast<int>(wanted.size()) + (scene ? 1 : 0);
  const int columns = columnsFor(count);
  const int rows = (count + columns - 1) / columns;
  const int width = (size.width - TileLine * (columns - 1)) / columns;
  const int height = (size.height - TileLine * (rows - 1)) / rows;
  if (std::min(width, height) < SmallestTile) {
    throw InvalidOption("--size " + std::to_string(size.width) + "x" + std::to_string(size.height) +
                        " has no room for " + std::to_string(count) + " pictures");
  }
  const SliceContents contents{model.ct.get(), model.labels.get(), markers, {}};
  std::vector<Picture> tiles;
  for (const WantedSlice& slice : wanted) {
    const ImageGeometry& geometry = model.ct->geometry;
    tiles.push_back(slicePicture(
        contents, framedSlice(geometry, slice.plane, positionMm(slice, geometry), width, height),
        look));
  }
  if (scene) tiles.insert(tiles.begin() + 1, scene({width, height}));
  return count == 1 ? tiles.front() : tiled(tiles, columns);
}

}  // namespace pneuma::cli
