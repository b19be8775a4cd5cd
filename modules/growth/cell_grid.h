#pragma once

#include <array>
#include <functional>
#include <optional>
#include <utility>

#include "growth/region.h"
#include "growth/row_kernels.h"
#include "growth/turn.h"

namespace pneuma {

/// The grid that is laid anew on the region of every branch (Kitaoka 1999, "Data Structure and
/// Algorithm"): n x n x n equal cells in the region's box. A cell belongs to the region if its
/// centre does. One grid serves many regions, one after the other; not for several threads at once.
class CellGrid {
 public:
  /// @pre 5 <= cells <= 30
  explicit CellGrid(int cells);

  /// Lays the grid on `region` and returns the number of its cells. Drops from `region` what has
  /// nothing to do with its box, once and for all that descend from it.
  int lay(Region& region);

  int cellsAcross() const { return cells_; }

  int count() const { return count_; }

  /// Volume of a cell, mm^3.
  double cellMm3() const { return step_.prod(); }

  const RowMasks& cells() const { return masks_; }

  /// Number of some cells.
  int countAll(const RowMasks& cells) const;

  /// Number of cells in `wedge`.
  int countIn(const Wedge& wedge) const;

  /// Of the cells in `from`, those in `wedge`. Returns their number.
  int select(const Wedge& wedge, const RowMasks& from, RowMasks& out) const;

  /// Of the region's cells, those not in `taken`.
  void selectRest(const RowMasks& taken, RowMasks& out) const;

  /// Number of cells of `from` in `wedge`.
  int countIn(const Wedge& wedge, const RowMasks& from) const;

  /// The box of some cells, one cell wider on each side, within the grid's own. @pre any cell
  Box3 boxOf(const RowMasks& cells) const;

  /// Mean of the centres of some cells. @pre any cell
  Vec3 centroidOf(const RowMasks& cells) const;

  /// Of some cells' centres, the one farthest from `from`. @pre any cell
  Vec3 farthestCentre(const RowMasks& cells, const Vec3& from) const;

  /// Of some cells' centres, in order of their distance from `from`, the first that `accepts`.
  std::optional<Vec3> nearestCentre(const RowMasks& cells, const Vec3& from,
                                    const std::function<bool(const Vec3&)>& accepts) const;

 private:
  RowPlane planeOf(const Vec3& point, const Vec3& normal) const;
  std::pair<std::size_t, std::size_t> rowsBetween(double low, double high) const;
  void keepWalls(Region& region);
  bool keepWall(const Wedge& wedge);
  void dropAncestors(Region& region);
  void keepOrgan(Region& region);
  void compact();
  void findPlanes();

  int cells_;
  std::uint32_t all_;
  const RowKernels& kernels_;
  RowPlaces template_;
  RowPlaces places_;
  RowMasks masks_;
  std::array<std::size_t, 31> planeBegins_{};  ///< first row of every plane
  std::size_t used_ = 0;                       ///< rows that may hold cells
  std::size_t rows_ = 0;                       ///< with padding, whose masks are empty
  int count_ = 0;
  Vec3 first_ = Vec3::Zero();  ///< centre of the cell (0, 0, 0)
  Vec3 step_ = Vec3::Ones();   ///< sides of a cell
  Box3 box_;
};

}  // namespace pneuma
