#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "core/clearance_grid.h"
#include "geometry/cell_triangles.h"
#include "geometry/wall_crossings.h"

namespace pneuma {

/// The cells of a grid that a closed surface passes through, each with a place known to lie inside
/// or outside and the triangles between that place and any other of the cell.
class WallCells {
 public:
  using Cell = Eigen::Vector3i;

  /// @pre the surface is closed and lies on the grid
  /// @throws InvalidInput if the surface is so crumpled that rounding decides about a whole cell
  WallCells(const TriangleMesh& mesh, const ClearanceGrid& grid);

  /// What every cell of the grid is, in the order of ClearanceGrid::index().
  const std::vector<ClearanceGrid::Cell>& kinds() const { return kinds_; }

  /// Is `p` inside? @pre `p` lies in `cell`, which is a wall cell
  bool contains(const Vec3& p, const Cell& cell) const;

  /// True if the segment certainly touches no triangle of the cell.
  bool keepsOff(const Vec3& a, const Vec3& b, const Cell& cell) const;

 private:
  /// A place of a cell known to lie inside or outside.
  struct Anchor {
    std::uint8_t place = 0;
    bool inside = false;
  };

  /// A triangle's plane as seen from the anchor: enough to pass over most triangles.
  struct Facet {
    Eigen::Vector3f normal;
    float side;   ///< signed distance of the anchor
    float doubt;  ///< smaller distances than this are left to WallCrossings
    std::uint32_t triangle;

    float sideOf(const Eigen::Vector3f& fromAnchor) const { return side + normal.dot(fromAnchor); }
  };

  std::uint32_t wallCellAt(const Cell& cell) const {
    return lists_.wallCellOf(grid_.index(cell.x(), cell.y(), cell.z()));
  }

  std::span<const Facet> facets(std::uint32_t wallCell) const {
    return std::span(facets_).subspan(lists_.begin(wallCell),
                                      lists_.begin(wallCell + 1) - lists_.begin(wallCell));
  }

  Vec3 placeIn(const Cell& cell, std::size_t place) const;
  void fillRow(int j, int k);
  Anchor nextAnchor(const Cell& cell, const Anchor& before, std::uint32_t wallBefore,
                    std::uint32_t wallHere) const;
  void setFacets(const Cell& cell, std::uint32_t wallCell);
  bool containsByDetour(const Vec3& p, const Cell& cell, std::uint32_t wallCell) const;

  const ClearanceGrid& grid_;
  WallCrossings wall_;
  CellTriangles lists_;
  std::vector<Anchor> anchors_;  // by wall cell
  std::vector<Facet> facets_;    // as the triangles in lists_
  std::vector<ClearanceGrid::Cell> kinds_;
};

}  // namespace pneuma
