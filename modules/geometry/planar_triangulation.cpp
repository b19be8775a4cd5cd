#include "geometry/planar_triangulation.h"

#include <algorithm>
#include <cmath>
#include <unordered_map>
#include <utility>

#include <CGAL/Constrained_Delaunay_triangulation_2.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Triangulation_face_base_with_info_2.h>
#include <CGAL/Triangulation_vertex_base_with_info_2.h>

namespace pneuma {
namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;

/// CGAL leaves a plain number uninitialised.
struct PointIndex {
  std::uint32_t value = UINT32_MAX;
};

struct Depth {
  int value = -1;  ///< edges of loops between it and the outside; -1: not known yet
};

using Vertex = CGAL::Triangulation_vertex_base_with_info_2<PointIndex, Kernel>;
using Face = CGAL::Constrained_triangulation_face_base_2<
    Kernel, CGAL::Triangulation_face_base_with_info_2<Depth, Kernel>>;
using Triangulation = CGAL::Constrained_Delaunay_triangulation_2<
    Kernel, CGAL::Triangulation_data_structure_2<Vertex, Face>,
    CGAL::No_constraint_intersection_requiring_constructions_tag>;

Kernel::Point_2 pointOf(const Eigen::Vector2d& p) { return {p.x(), p.y()}; }

/// Finds out which faces lie inside: an odd number of loops around them.
void markDepths(Triangulation& triangulation) {
  std::vector<Triangulation::Face_handle> here{triangulation.infinite_face()};
  here.front()->info().value = 0;
  for (int depth = 0; !here.empty(); ++depth) {
    std::vector<Triangulation::Face_handle> beyond;
    while (!here.empty()) {
      const Triangulation::Face_handle face = here.back();
      here.pop_back();
      for (int i = 0; i < 3; ++i) {
        const Triangulation::Face_handle next = face->neighbor(i);
        if (next->info().value >= 0) continue;
        if (triangulation.is_constrained({face, i})) {
          beyond.push_back(next);
        } else {
          next->info().value = depth;
          here.push_back(next);
        }
      }
    }
    for (const Triangulation::Face_handle face : beyond) {
      if (face->info().value >= 0) continue;
      face->info().value = depth + 1;
      here.push_back(face);
    }
  }
}

bool isInside(const Triangulation::Face_handle& face) { return face->info().value % 2 == 1; }

/// False if edges cross or two points are one.
bool insertLoops(Triangulation& triangulation, std::span<const Eigen::Vector2d> points,
                 std::span<const std::array<std::uint32_t, 2>> edges) {
  std::vector<Triangulation::Vertex_handle> handles;
  handles.reserve(points.size());
  Triangulation::Face_handle near;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const Triangulation::Vertex_handle vertex = triangulation.insert(pointOf(points[i]), near);
    if (vertex->info().value != UINT32_MAX) return false;
    vertex->info().value = static_cast<std::uint32_t>(i);
    near = vertex->face();
    handles.push_back(vertex);
  }
  try {
    for (const auto& [from, to] : edges) {
      triangulation.insert_constraint(handles[from], handles[to]);
    }
  } catch (const Triangulation::Intersection_of_constraints_exception&) {
    return false;
  }
  // Edges that overlap were merged, and one that runs through a point was split.
  std::size_t constrained = 0;
  for (auto edge = triangulation.finite_edges_begin(); edge != triangulation.finite_edges_end();
       ++edge) {
    if (triangulation.is_constrained(*edge)) ++constrained;
  }
  return constrained == edges.size();
}

/// Which squares of a grid hold points of loops, to ask whether one is near.
class NearLoops {
 public:
  NearLoops(std::span<const Eigen::Vector2d> points, double square)
      : points_(points), square_(square) {
    for (std::uint32_t i = 0; i < points.size(); ++i)
      squares_[squareOf(points[i], 0, 0)].push_back(i);
  }

  bool holds(const Eigen::Vector2d& p, double apart) const {
    for (int dx = -1; dx <= 1; ++dx) {
      for (int dy = -1; dy <= 1; ++dy) {
        const auto square = squares_.find(squareOf(p, dx, dy));
        if (square == squares_.end()) continue;
        for (const std::uint32_t i : square->second) {
          if ((points_[i] - p).squaredNorm() < apart * apart) return true;
        }
      }
    }
    return false;
  }

 private:
  std::uint64_t squareOf(const Eigen::Vector2d& p, int dx, int dy) const {
    const auto x = static_cast<std::int64_t>(std::floor(p.x() / square_)) + dx;
    const auto y = static_cast<std::int64_t>(std::floor(p.y() / square_)) + dy;
    return (static_cast<std::uint64_t>(x) << 32U) ^ (static_cast<std::uint64_t>(y) & 0xffffffffU);
  }

  std::span<const Eigen::Vector2d> points_;
  double square_;
  std::unordered_map<std::uint64_t, std::vector<std::uint32_t>> squares_;
};

}  // namespace

std::vector<WantedPoint> hexagonalGrid(const Eigen::AlignedBox2d& box, double step, double apart) {
  std::vector<WantedPoint> points;
  const double rowStep = step * std::sqrt(0.75);
  int row = 0;
  for (double v = box.min().y(); v <= box.max().y(); v += rowStep, ++row) {
    for (double u = box.min().x() + (row % 2 == 0 ? 0.0 : step / 2.0); u <= box.max().x();
         u += step) {
      points.push_back({Eigen::Vector2d(u, v), apart});
    }
  }
  return points;
}

std::optional<PlanarTriangulation> triangulateInside(
    std::span<const Eigen::Vector2d> points, std::span<const std::array<std::uint32_t, 2>> edges,
    std::span<const WantedPoint> wanted) {
  Triangulation triangulation;
  if (!insertLoops(triangulation, points, edges)) return std::nullopt;
  markDepths(triangulation);
  double widest = 1e-3;
  for (const WantedPoint& one : wanted) widest = std::max(widest, one.apart);
  const NearLoops nearLoops(points, widest);
  std::vector<Eigen::Vector2d> inside;
  Triangulation::Face_handle near;
  for (const WantedPoint& one : wanted) {
    if (one.apart > 0.0 && nearLoops.holds(one.place, one.apart)) continue;
    near = triangulation.locate(pointOf(one.place), near);
    if (!triangulation.is_infinite(near) && isInside(near)) inside.push_back(one.place);
  }
  PlanarTriangulation result;
  result.points.assign(points.begin(), points.end());
  near = nullptr;
  for (const Eigen::Vector2d& p : inside) {
    const Triangulation::Vertex_handle vertex = triangulation.insert(pointOf(p), near);
    near = vertex->face();
    if (vertex->info().value != UINT32_MAX) continue;  // there is a point in this place already
    vertex->info().value = static_cast<std::uint32_t>(result.points.size());
    result.points.push_back(p);
  }
  for (auto face = triangulation.all_faces_begin(); face != triangulation.all_faces_end(); ++face) {
    face->info().value = -1;
  }
  markDepths(triangulation);
  for (auto face = triangulation.finite_faces_begin(); face != triangulation.finite_faces_end();
       ++face) {
    if (!isInside(face)) continue;
    result.triangles.push_back({face->vertex(0)->info().value, face->vertex(1)->info().value,
                                face->vertex(2)->info().value});
  }
  return result;
}

}  // namespace pneuma
