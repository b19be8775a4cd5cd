#include "geometry/repair.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <iomanip>
#include <iterator>
#include <sstream>
#include <string>

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Polygon_mesh_processing/border.h>
#include <CGAL/Polygon_mesh_processing/connected_components.h>
#include <CGAL/Polygon_mesh_processing/measure.h>
#include <CGAL/Polygon_mesh_processing/orient_polygon_soup.h>
#include <CGAL/Polygon_mesh_processing/orientation.h>
#include <CGAL/Polygon_mesh_processing/polygon_soup_to_polygon_mesh.h>
#include <CGAL/Polygon_mesh_processing/repair_degeneracies.h>
#include <CGAL/Polygon_mesh_processing/repair_polygon_soup.h>
#include <CGAL/Polygon_mesh_processing/stitch_borders.h>
#include <CGAL/Polygon_mesh_processing/triangulate_hole.h>
#include <CGAL/Surface_mesh.h>

#include "core/error.h"
#include "geometry/mesh_topology.h"
#include "geometry/self_intersections.h"

namespace pneuma {
namespace {

namespace PMP = CGAL::Polygon_mesh_processing;
using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Point = Kernel::Point_3;
using Mesh = CGAL::Surface_mesh<Point>;
using Polygon = std::vector<std::size_t>;

/// Pieces with less than this part of the largest piece's area are debris, not lung.
constexpr double DebrisArea = 0.01;

/// Pieces that enclose less than this part of what the largest encloses are folded sheets.
constexpr double DebrisVolume = 0.001;

/// A volume that changed by more than this part is worth a sentence.
constexpr double WorthSaying = 0.0005;

TriangleMesh fromCgal(Mesh& mesh) {
  mesh.collect_garbage();
  TriangleMesh result;
  for (const Mesh::Vertex_index v : mesh.vertices()) {
    const Point& p = mesh.point(v);
    result.points.emplace_back(p.x(), p.y(), p.z());
  }
  for (const Mesh::Face_index f : mesh.faces()) {
    std::array<std::uint32_t, 3> triangle;
    auto corner = triangle.begin();
    for (const Mesh::Vertex_index v : CGAL::vertices_around_face(mesh.halfedge(f), mesh)) {
      *corner++ = static_cast<std::uint32_t>(v);
    }
    result.triangles.push_back(triangle);
  }
  return result;
}

/// Mends a surface step by step and keeps the list of what was done.
class Mending {
 public:
  explicit Mending(const TriangleMesh& mesh) {
    for (const Vec3& p : mesh.points) points_.emplace_back(p.x(), p.y(), p.z());
    for (const auto& [a, b, c] : mesh.triangles) polygons_.push_back({a, b, c});
  }

  void cleanSoup() {
    note(PMP::merge_duplicate_points_in_polygon_soup(points_, polygons_), "Joined",
         "point that lay at the same place as another", "points that lay at the same places");
    note(std::erase_if(
             polygons_,
             [](const Polygon& t) { return t[0] == t[1] || t[1] == t[2] || t[2] == t[0]; }),
         "Dropped", "triangle that named a point twice", "triangles that named a point twice");
    note(PMP::merge_duplicate_polygons_in_polygon_soup(
             points_, polygons_, CGAL::parameters::require_same_orientation(false)),
         "Dropped", "copy of a triangle", "copies of triangles");
    note(PMP::remove_isolated_points_in_polygon_soup(points_, polygons_), "Dropped",
         "point that no triangle uses", "points that no triangle uses");
  }

  /// Turns neighbours the same way and splits the surface where more than two triangles meet.
  void assemble() {
    const std::vector<Point> oldPoints = points_;
    const std::vector<Polygon> oldPolygons = polygons_;
    PMP::orient_polygon_soup(points_, polygons_);
    std::size_t turned = 0;
    for (std::size_t t = 0; t < polygons_.size(); ++t) {
      turned += sameWayRound(oldPoints, oldPolygons[t], points_, polygons_[t]) ? 0 : 1;
    }
    note(turned, "Turned", "triangle to face the same way as its neighbours",
         "triangles to face the same way as their neighbours");
    note(points_.size() - oldPoints.size(), "Split the surface at", "point where it touched itself",
         "points where it touched itself");
    PMP::polygon_soup_to_polygon_mesh(points_, polygons_, mesh_);
  }

  void dropDebris() {
    const auto area = [this](const auto& faces) { return PMP::area(faces, mesh_); };
    note(dropPieces(DebrisArea, area), "Dropped",
         "loose piece with less than 1 % of the largest piece's area",
         "loose pieces with less than 1 % of the largest piece's area");
  }

  /// @pre closed
  void dropSheets() {
    const auto volume = [this](const auto& faces) {
      double six = 0.0;
      for (const Mesh::Face_index f : faces) {
        const Mesh::Halfedge_index h = mesh_.halfedge(f);
        six += CGAL::determinant(fromOrigin(mesh_.source(h)), fromOrigin(mesh_.target(h)),
                                 fromOrigin(mesh_.target(mesh_.next(h))));
      }
      return std::abs(six);
    };
    note(dropPieces(DebrisVolume, volume), "Dropped", "piece that encloses next to nothing",
         "pieces that enclose next to nothing");
  }

  void stitch() {
    note(PMP::stitch_borders(mesh_), "Stitched", "pair of open edges", "pairs of open edges");
  }

  void dropFlatTriangles() {
    std::vector<Mesh::Face_index> flat;
    PMP::degenerate_faces(mesh_, std::back_inserter(flat));
    if (flat.empty()) return;
    PMP::remove_degenerate_faces(mesh_);
    note(flat.size(), "Removed", "triangle without area", "triangles without area");
  }

  void closeHoles(const Progress& progress) {
    std::vector<Mesh::Halfedge_index> borders;
    PMP::extract_boundary_cycles(mesh_, std::back_inserter(borders));
    std::size_t closed = 0;
    std::size_t triangles = 0;
    for (const Mesh::Halfedge_index border : borders) {
      progress.throwIfStopped();
      std::vector<Mesh::Face_index> patch;
      PMP::triangulate_hole(mesh_, border, std::back_inserter(patch));
      closed += patch.empty() ? 0 : 1;
      triangles += patch.size();
    }
    note(closed, "Closed", "hole", "holes", " with " + std::to_string(triangles) + " triangles");
  }

  /// Cuts out the triangles that cut each other, with more and more of their neighbours, and closes
  /// the holes; the mesh is left alone where that does not help.
  void removeSelfIntersections(const Progress& progress) {
    constexpr int MostRings = 5;
    const TriangleMesh original = fromCgal(mesh_);
    const SelfIntersecting before = selfIntersecting(original, progress);
    if (before.pairs == 0) return;
    TriangleMesh best = original;
    SelfIntersecting left = before;
    for (int rings = 0; rings <= MostRings && left.pairs > 0; ++rings) {
      progress.report(static_cast<double>(rings) / (MostRings + 1));
      Mending trial(without(best, left.triangles, rings));
      trial.cleanSoup();
      trial.assemble();
      trial.dropDebris();
      trial.closeHoles(progress);
      trial.dropSheets();
      const TriangleMesh tried = trial.mesh();
      const SelfIntersecting now = selfIntersecting(tried, progress);
      if (!CGAL::is_closed(trial.mesh_) || now.pairs >= left.pairs) continue;
      best = tried;
      left = now;
      mesh_ = trial.mesh_;
    }
    note(before.pairs - left.pairs, "Removed", "pair of triangles that cut each other",
         "pairs of triangles that cut each other", ", by closing the surface anew around them");
  }

  /// Says how the volume changed, where it is known.
  void compareVolumes(const MeshReport& before, const MeshReport& after) {
    const double change = std::abs(after.volumeMl - before.volumeMl);
    if (!before.closed || before.misorientedEdges > 0) return;
    if (change <= WorthSaying * before.volumeMl) return;
    std::ostringstream text;
    text << std::fixed << std::setprecision(1) << "Changed the volume from " << before.volumeMl
         << " to " << after.volumeMl << " ml.";
    changes_.push_back(text.str());
  }

  void turnOutwards() {
    const TriangleMesh now = fromCgal(mesh_);
    const MeshReport report = examine(now);
    if (!report.closed || report.orientedOutwards) return;
    if (signedVolumeMm3(now) == 0.0) return;  // a sheet and its back, which have no outside
    if (report.selfIntersections == 0) {
      PMP::orient_to_bound_a_volume(mesh_);
    } else {
      // CGAL asks for a surface that does not cut itself; its sign is all that can be mended.
      if (signedVolumeMm3(now) >= 0.0) return;
      PMP::reverse_face_orientations(mesh_);
    }
    changes_.push_back("Turned the surface to face outwards; it was inside-out.");
  }

  TriangleMesh mesh() { return fromCgal(mesh_); }

  std::vector<std::string> changes() && { return std::move(changes_); }

 private:
  /// `mesh` without some triangles and the neighbours around them, ring by ring.
  static TriangleMesh without(const TriangleMesh& mesh, const std::vector<std::uint32_t>& triangles,
                              int rings) {
    std::vector<char> dropped(mesh.triangles.size(), 0);
    for (const std::uint32_t t : triangles) dropped[t] = 1;
    for (int ring = 0; ring < rings; ++ring) {
      std::vector<char> touched(mesh.points.size(), 0);
      for (std::size_t t = 0; t < dropped.size(); ++t) {
        if (dropped[t] == 0) continue;
        for (const std::uint32_t v : mesh.triangles[t]) touched[v] = 1;
      }
      for (std::size_t t = 0; t < dropped.size(); ++t) {
        for (const std::uint32_t v : mesh.triangles[t]) dropped[t] |= touched[v];
      }
    }
    TriangleMesh rest;
    rest.points = mesh.points;
    for (std::size_t t = 0; t < dropped.size(); ++t) {
      if (dropped[t] == 0) rest.triangles.push_back(mesh.triangles[t]);
    }
    return rest;
  }

  Kernel::Vector_3 fromOrigin(Mesh::Vertex_index v) const {
    return mesh_.point(v) - mesh_.point(*mesh_.vertices().begin());
  }

  /// Drops the pieces whose size is less than a part of the largest one's; returns how many.
  template <class Size>
  std::size_t dropPieces(double part, Size&& sizeOf) {
    auto pieceOf = mesh_.add_property_map<Mesh::Face_index, std::size_t>("f:piece").first;
    std::vector<std::vector<Mesh::Face_index>> pieces(PMP::connected_components(mesh_, pieceOf));
    for (const Mesh::Face_index f : mesh_.faces()) pieces[pieceOf[f]].push_back(f);
    std::vector<double> sizes;
    for (const auto& faces : pieces) sizes.push_back(sizeOf(faces));
    std::vector<std::size_t> small;
    for (std::size_t i = 0; i < sizes.size(); ++i) {
      if (sizes[i] < part * *std::ranges::max_element(sizes)) small.push_back(i);
    }
    if (!small.empty()) PMP::remove_connected_components(mesh_, small, pieceOf);
    mesh_.remove_property_map(pieceOf);
    return small.size();
  }

  static bool sameWayRound(const std::vector<Point>& oldPoints, const Polygon& before,
                           const std::vector<Point>& newPoints, const Polygon& after) {
    for (std::size_t shift = 0; shift < 3; ++shift) {
      bool same = true;
      for (std::size_t k = 0; k < 3; ++k) {
        same = same && oldPoints[before[k]] == newPoints[after[(k + shift) % 3]];
      }
      if (same) return true;
    }
    return false;
  }

  void note(std::size_t n, const std::string& verb, const std::string& one, const std::string& many,
            const std::string& rest = "") {
    if (n == 0) return;
    changes_.push_back(verb + " " + std::to_string(n) + " " + (n == 1 ? one : many) + rest + ".");
  }

  std::vector<Point> points_;
  std::vector<Polygon> polygons_;
  Mesh mesh_;
  std::vector<std::string> changes_;
};

}  // namespace

Repaired repaired(const TriangleMesh& mesh, const Progress& progress) {
  Repaired result;
  result.before = examine(mesh, SelfIntersections::Ask, progress.part(0.0, 0.1, "examine"));
  Mending mending(mesh);
  const std::array<std::function<void(const Progress&)>, 9> steps = {
      [&](const Progress&) { mending.cleanSoup(); },
      [&](const Progress&) { mending.assemble(); },
      [&](const Progress&) { mending.dropDebris(); },
      [&](const Progress&) { mending.stitch(); },
      [&](const Progress&) { mending.dropFlatTriangles(); },
      [&](const Progress& part) { mending.closeHoles(part); },
      [&](const Progress&) { mending.dropSheets(); },
      [&](const Progress& part) { mending.removeSelfIntersections(part); },
      [&](const Progress&) { mending.turnOutwards(); }};
  try {
    for (std::size_t i = 0; i < steps.size(); ++i) {
      const Progress part = progress.part(0.1 + 0.08 * i, 0.18 + 0.08 * i, "repair");
      part.report(0.0);
      steps[i](part);
    }
  } catch (const CGAL::Failure_exception&) {
    throw InvalidInput("the surface is too broken to be repaired; export it again");
  }
  result.mesh = mending.mesh();
  result.after = examine(result.mesh, SelfIntersections::Ask, progress.part(0.9, 1.0, "examine"));
  mending.compareVolumes(result.before, result.after);
  result.changes = std::move(mending).changes();
  if (!result.after.closed || !(result.after.volumeMl > 0.0)) {
    throw InvalidInput("nothing that encloses a volume is left of the surface after repair (" +
                       std::to_string(result.after.triangles) + " triangles, " +
                       std::to_string(result.after.openEdges) +
                       " open edges); export it again, closed");
  }
  return result;
}

}  // namespace pneuma
