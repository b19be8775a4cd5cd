#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "core/clearance_grid.h"
#include "geometry/wall_crossings.h"

namespace pneuma {

/// Which triangles pass through which cells of a grid. Cells count as larger by a millionth of
/// their side, so that rounding never loses a triangle; a cell may list one that only comes that
/// near.
class CellTriangles {
 public:
  /// @pre the triangles lie on the grid
  CellTriangles(const WallCrossings& wall, const ClearanceGrid& grid);

  /// Cells that a triangle passes through.
  std::size_t wallCells() const { return offsets_.size() - 1; }

  /// Number of the cell among the wall cells, or NotWall.
  std::uint32_t wallCellOf(std::size_t cell) const { return wallCellOf_[cell]; }

  static constexpr std::uint32_t NotWall = 0xffffffffU;

  /// Triangles that pass through a wall cell; none for NotWall.
  std::span<const std::uint32_t> of(std::uint32_t wallCell) const {
    if (wallCell == NotWall) return {};
    return std::span(triangles_).subspan(begin(wallCell), begin(wallCell + 1) - begin(wallCell));
  }

  /// Where a wall cell's triangles begin in a list of all of them; that of wallCells() is its size.
  std::size_t begin(std::uint32_t wallCell) const { return offsets_[wallCell]; }

 private:
  std::vector<std::uint32_t> wallCellOf_;
  std::vector<std::size_t> offsets_;
  std::vector<std::uint32_t> triangles_;
};

}  // namespace pneuma
