#include "geometry/wall_cells.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <string>

#include "core/error.h"
#include "core/parallel.h"

namespace pneuma {
namespace {

/// Places in a cell, from its centre in parts of its side; tried one after the other until none of
/// the ways between them touches a triangle's border.
constexpr std::array<std::array<double, 3>, 8> Places = {{{0.0, 0.0, 0.0},
                                                          {0.1873, -0.2311, 0.1409},
                                                          {-0.2719, 0.1637, 0.2203},
                                                          {0.0761, 0.2917, -0.2633},
                                                          {-0.1531, -0.0883, -0.3137},
                                                          {0.3251, 0.0547, 0.0293},
                                                          {-0.0419, -0.3463, 0.0677},
                                                          {0.2437, 0.3079, 0.3301}}};

/// Generous bound of the relative rounding error of a float sum of four products.
constexpr float FloatError = 2e-6F;

}  // namespace

WallCells::WallCells(const TriangleMesh& mesh, const ClearanceGrid& grid)
    : grid_(grid),
      wall_(mesh),
      lists_(wall_, grid),
      anchors_(lists_.wallCells()),
      facets_(lists_.begin(static_cast<std::uint32_t>(lists_.wallCells()))),
      kinds_(grid.cellCount()) {
  parallelFor(static_cast<std::size_t>(grid.size().z()), [&](std::size_t k) {
    for (int j = 0; j < grid_.size().y(); ++j) fillRow(j, static_cast<int>(k));
  });
}

bool WallCells::contains(const Vec3& p, const Cell& cell) const {
  const std::uint32_t wallCell = wallCellAt(cell);
  const Anchor anchor = anchors_[wallCell];
  const Vec3 place = placeIn(cell, anchor.place);
  const Eigen::Vector3f fromAnchor = (p - place).cast<float>();
  const float reach = FloatError * fromAnchor.lpNorm<1>();
  Crossings crossings = Crossings::Even;
  for (const Facet& facet : facets(wallCell)) {
    const float doubt = facet.doubt + reach;
    const float side = facet.sideOf(fromAnchor);
    if (std::min(side, facet.side) > doubt || std::max(side, facet.side) < -doubt) continue;
    crossings = crossings + wall_.of(p, place, facet.triangle);
    if (crossings == Crossings::Unsure) return containsByDetour(p, cell, wallCell);
  }
  return anchor.inside != (crossings == Crossings::Odd);
}

bool WallCells::keepsOff(const Vec3& a, const Vec3& b, const Cell& cell) const {
  const std::uint32_t wallCell = wallCellAt(cell);
  if (wallCell == CellTriangles::NotWall) return true;
  const Vec3 place = placeIn(cell, anchors_[wallCell].place);
  const Eigen::Vector3f toA = (a - place).cast<float>();
  const Eigen::Vector3f toB = (b - place).cast<float>();
  const float reach = FloatError * (toA.lpNorm<1>() + toB.lpNorm<1>());
  return std::ranges::all_of(facets(wallCell), [&](const Facet& facet) {
    const float doubt = facet.doubt + reach;
    const float sideA = facet.sideOf(toA);
    const float sideB = facet.sideOf(toB);
    return std::min(sideA, sideB) > doubt || std::max(sideA, sideB) < -doubt ||
           wall_.of(a, b, facet.triangle) == Crossings::Even;
  });
}

Vec3 WallCells::placeIn(const Cell& cell, std::size_t place) const {
  const auto& [x, y, z] = Places[place];
  return grid_.cellCentre(cell.x(), cell.y(), cell.z()) + grid_.cellMm() * Vec3(x, y, z);
}

/// Says of every cell of a row whether it is wall, inside or outside, by counting the crossings on
/// the way from each cell's anchor to the next one's. Rows begin off the surface's box.
void WallCells::fillRow(int j, int k) {
  Anchor before;
  std::uint32_t wallBefore = CellTriangles::NotWall;
  for (int i = 0; i < grid_.size().x(); ++i) {
    const std::size_t index = grid_.index(i, j, k);
    const std::uint32_t wallHere = lists_.wallCellOf(index);
    Anchor here{0, before.inside};
    if (wallHere != CellTriangles::NotWall || wallBefore != CellTriangles::NotWall) {
      here = nextAnchor(Cell(i, j, k), before, wallBefore, wallHere);
    }
    if (wallHere == CellTriangles::NotWall) {
      kinds_[index] = here.inside ? ClearanceGrid::Cell::Inside : ClearanceGrid::Cell::Outside;
    } else {
      kinds_[index] = ClearanceGrid::Cell::Wall;
      anchors_[wallHere] = here;
      setFacets(Cell(i, j, k), wallHere);
    }
    before = here;
    wallBefore = wallHere;
  }
}

WallCells::Anchor WallCells::nextAnchor(const Cell& cell, const Anchor& before,
                                        std::uint32_t wallBefore, std::uint32_t wallHere) const {
  const Vec3 from = placeIn(cell - Cell::UnitX(), before.place);
  for (std::size_t place = 0; place < Places.size(); ++place) {
    const Vec3 to = placeIn(cell, place);
    for (std::size_t gate = 0; gate < Places.size(); ++gate) {
      // The way leads through the side that the two cells share.
      Vec3 between = placeIn(cell, gate);
      between.x() = grid_.origin().x() + grid_.cellMm() * cell.x();
      const Crossings crossings = wall_.parity(from, between, lists_.of(wallBefore)) +
                                  wall_.parity(between, to, lists_.of(wallHere));
      if (crossings == Crossings::Unsure) continue;
      return {static_cast<std::uint8_t>(place), before.inside != (crossings == Crossings::Odd)};
    }
  }
  const Vec3 centre = grid_.cellCentre(cell.x(), cell.y(), cell.z());
  throw InvalidInput("the surface is so crumpled near (" + std::to_string(centre.x()) + ", " +
                     std::to_string(centre.y()) + ", " + std::to_string(centre.z()) +
                     ") mm that inside and outside cannot be told apart; mend it with "
                     "`pneuma repair`");
}

void WallCells::setFacets(const Cell& cell, std::uint32_t wallCell) {
  const Vec3 place = placeIn(cell, anchors_[wallCell].place);
  const std::span<const std::uint32_t> triangles = lists_.of(wallCell);
  for (std::size_t i = 0; i < triangles.size(); ++i) {
    const auto& [a, b, c] = wall_.corners(triangles[i]);
    const Vec3 u = b - a;
    const Vec3 v = c - a;
    const Vec3 normal = u.cross(v);
    const double area = normal.norm();
    // How far rounding may turn the normal, radians; slivers are left to WallCrossings.
    const double turn = 1e-15 * u.norm() * v.norm() / area;
    Facet facet{Eigen::Vector3f::Zero(), 0.0F, std::numeric_limits<float>::infinity(),
                triangles[i]};
    if (turn < 1e-7) {
      const double side = normal.dot(place - a) / area;
      facet.normal = (normal / area).cast<float>();
      facet.side = static_cast<float>(side);
      facet.doubt = static_cast<float>(FloatError * std::abs(side) +
                                       10.0 * turn * (place - a).norm() + 1e-9 * grid_.cellMm());
    }
    facets_[lists_.begin(wallCell) + i] = facet;
  }
}

bool WallCells::containsByDetour(const Vec3& p, const Cell& cell, std::uint32_t wallCell) const {
  const std::span<const std::uint32_t> triangles = lists_.of(wallCell);
  const Anchor anchor = anchors_[wallCell];
  const Vec3 place = placeIn(cell, anchor.place);
  for (std::size_t detour = 0; detour < Places.size(); ++detour) {
    const Vec3 between = placeIn(cell, detour);
    const Crossings crossings =
        wall_.parity(p, between, triangles) + wall_.parity(between, place, triangles);
    if (crossings != Crossings::Unsure) return anchor.inside != (crossings == Crossings::Odd);
  }
  return false;  // on the wall, as far as rounding can tell
}

}  // namespace pneuma
