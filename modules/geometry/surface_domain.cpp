#include "geometry/surface_domain.h"

#include <algorithm>
#include <cmath>
#include <mutex>
#include <optional>
#include <string>

#include "core/clearance_grid.h"
#include "core/error.h"
#include "geometry/mesh_topology.h"
#include "geometry/nearest_triangle.h"
#include "geometry/wall_cells.h"

namespace pneuma {
namespace {

using Cell = Eigen::Vector3i;

/// `mesh` if it can be asked for inside and outside. @throws InvalidInput otherwise
TriangleMesh closedOrThrow(TriangleMesh mesh) {
  requireSound(mesh);
  const MeshTopology found = topology(mesh);
  if (found.components == 0) throw InvalidInput("the surface has no triangles; nothing is inside");
  if (found.openEdges > 0) {
    throw InvalidInput("the surface has " + std::to_string(found.openEdges) +
                       " open edges, so that nothing is inside; close it with `pneuma repair`");
  }
  if (found.oddEdges > 0) {
    throw InvalidInput("the surface has " + std::to_string(found.oddEdges) +
                       " edges where an odd number of triangles meet, so that inside and outside "
                       "are not told apart; mend it with `pneuma repair`");
  }
  if (found.misorientedEdges > 0) {
    throw InvalidInput("the surface has " + std::to_string(found.misorientedEdges) +
                       " edges across which the orientation flips; mend it with `pneuma repair`");
  }
  return mesh;
}

double enclosedOrThrow(const TriangleMesh& mesh) {
  const double volume = std::abs(signedVolumeMm3(mesh));
  const double box = pneuma::bounds(mesh).volume();
  if (!(volume > 1e-9 * box)) {
    throw InvalidInput("the surface is closed but encloses no volume; export it again");
  }
  return volume;
}

/// Fine enough that few triangles of an organ's surface share a cell, and never more than a few
/// million cells; it does not depend on the triangles, so neither does the cost far from the wall.
double defaultCellMm(double volumeMm3, const Box3& box) {
  constexpr double CellsAcross = 60.0;
  constexpr double MostCells = 8.0e6;
  constexpr double MostCellsAcross = 1000.0;
  return std::max({std::cbrt(volumeMm3) / CellsAcross, std::cbrt(box.volume() / MostCells),
                   box.sizes().maxCoeff() / MostCellsAcross});
}

}  // namespace

struct SurfaceDomain::State {
  State(TriangleMesh given, double cellMm)
      : mesh(closedOrThrow(std::move(given))),
        volumeMm3(enclosedOrThrow(mesh)),
        box(pneuma::bounds(mesh)),
        grid(box, cellMm > 0.0 ? cellMm : defaultCellMm(volumeMm3, box)),
        wall(mesh, grid) {
    grid.setCells(wall.kinds());
  }

  /// True if the segment, which lies on the grid, certainly touches no triangle.
  bool keepsOffWall(const Vec3& a, const Vec3& b) const {
    // Amanatides and Woo 1987: from cell to cell, by the next side that the segment reaches.
    const Vec3 way = b - a;
    Cell cell = grid.cellOf(a);
    const Cell last = grid.cellOf(b);
    Cell step;
    Vec3 next;  // part of the way to the next side along each axis
    Vec3 perCell;
    for (int axis = 0; axis < 3; ++axis) {
      step[axis] = way[axis] < 0.0 ? -1 : 1;
      const double side = grid.origin()[axis] + grid.cellMm() * (cell[axis] + (step[axis] + 1) / 2);
      const bool moves = way[axis] != 0.0;
      perCell[axis] = moves ? grid.cellMm() / std::abs(way[axis]) : 0.0;
      next[axis] = moves ? (side - a[axis]) / way[axis] : 0.0;
    }
    for (int left = (last - cell).cwiseAbs().sum();; --left) {
      if (!wall.keepsOff(a, b, cell)) return false;
      if (left == 0) return true;
      int axis = -1;  // the side reached next, of those before the last cell
      for (int other = 0; other < 3; ++other) {
        if (cell[other] == last[other]) continue;
        if (axis < 0 || next[other] < next[axis]) axis = other;
      }
      cell[axis] += step[axis];
      next[axis] += perCell[axis];
    }
  }

  TriangleMesh mesh;
  double volumeMm3;
  Box3 box;
  ClearanceGrid grid;
  WallCells wall;
  std::once_flag nearestBuilt;
  std::optional<NearestTriangle> nearest;
};

SurfaceDomain::SurfaceDomain(TriangleMesh mesh, double cellMm)
    : state_(std::make_unique<State>(std::move(mesh), cellMm)) {}

SurfaceDomain::~SurfaceDomain() = default;

bool SurfaceDomain::contains(const Vec3& p) const {
  if (!state_->box.contains(p)) return false;
  const int clearance = state_->grid.clearance(p);
  return clearance == 0 ? state_->wall.contains(p, state_->grid.cellOf(p)) : clearance > 0;
}

bool SurfaceDomain::containsSegment(const Vec3& a, const Vec3& b) const {
  if (!contains(a) || !state_->box.contains(b)) return false;
  const double length = (b - a).norm();
  return state_->grid.clearanceMm(a) > length || state_->keepsOffWall(a, b);
}

bool SurfaceDomain::containsBox(const Box3& box) const { return state_->grid.keepsInside(box); }

std::uint32_t SurfaceDomain::insideAlongX(const Vec3& first, double stepMm,
                                          std::uint32_t wanted) const {
  return state_->grid.insideAlongX(first, stepMm, wanted,
                                   [this](const Vec3& p) { return contains(p); });
}

double SurfaceDomain::exitDistance(const Vec3& p, const Vec3& direction, double farthestMm) const {
  return exitByMarching(p, direction, farthestMm,
                        [this](const Vec3& at) { return state_->grid.clearanceMm(at); });
}

double SurfaceDomain::distanceToWall(const Vec3& p) const {
  std::call_once(state_->nearestBuilt, [this] { state_->nearest.emplace(state_->mesh); });
  return state_->nearest->distanceMm(p);
}

Box3 SurfaceDomain::bounds() const { return state_->box; }

double SurfaceDomain::volumeMm3() const { return state_->volumeMm3; }

}  // namespace pneuma
