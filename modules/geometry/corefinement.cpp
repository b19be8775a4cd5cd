#include "geometry/corefinement.h"

#include <limits>
#include <map>

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Polygon_mesh_processing/corefinement.h>
#include <CGAL/Surface_mesh.h>

namespace pneuma {
namespace {

namespace PMP = CGAL::Polygon_mesh_processing;
using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Point = Kernel::Point_3;
using Mesh = CGAL::Surface_mesh<Point>;
using IsOnLine = Mesh::Property_map<Mesh::Edge_index, bool>;

constexpr std::uint32_t Nowhere = std::numeric_limits<std::uint32_t>::max();

/// Empty if the mesh is not manifold.
std::optional<Mesh> toCgal(const TriangleMesh& mesh) {
  Mesh result;
  std::vector<Mesh::Vertex_index> vertexOf(mesh.points.size(), Mesh::null_vertex());
  for (const auto& t : mesh.triangles) {
    for (const std::uint32_t v : t) vertexOf[v] = Mesh::Vertex_index(0);  // is used
  }
  for (std::size_t v = 0; v < vertexOf.size(); ++v) {
    if (vertexOf[v] == Mesh::null_vertex()) continue;
    const Vec3& p = mesh.points[v];
    vertexOf[v] = result.add_vertex(Point(p.x(), p.y(), p.z()));
  }
  for (const auto& [a, b, c] : mesh.triangles) {
    if (result.add_face(vertexOf[a], vertexOf[b], vertexOf[c]) == Mesh::null_face()) return {};
  }
  return result;
}

/// Follows which triangle of the first mesh each new one comes from.
struct ParentVisitor : PMP::Corefinement::Default_visitor<Mesh> {
  void before_subface_creations(Mesh::Face_index parent, Mesh& mesh) {
    progress->throwIfStopped();
    current = &mesh == first ? static_cast<std::uint32_t>(parent) : Nowhere;
  }

  void after_subface_created(Mesh::Face_index face, Mesh& mesh) {
    if (&mesh != first) return;
    parentOf->resize(std::max<std::size_t>(parentOf->size(), face + 1), Nowhere);
    (*parentOf)[face] = current;
  }

  const Progress* progress = nullptr;
  const Mesh* first = nullptr;
  std::vector<std::uint32_t>* parentOf = nullptr;
  std::uint32_t current = Nowhere;
};

/// Takes both meshes over, the points of the line once.
class Joiner {
 public:
  void addFirst(const Mesh& mesh, const IsOnLine& isOnLine, std::vector<std::uint32_t> parentOf) {
    std::vector<std::uint32_t> indexOf;
    for (const Mesh::Vertex_index v : mesh.vertices()) indexOf.push_back(add(mesh.point(v)));
    forEachOnLine(mesh, isOnLine,
                  [&](Mesh::Vertex_index v) { onLine_.emplace(keyOf(mesh.point(v)), indexOf[v]); });
    result.first = trianglesOf(mesh, indexOf);
    result.parentOf = std::move(parentOf);
  }

  /// False if its line is another than the first's.
  bool addSecond(const Mesh& mesh, const IsOnLine& isOnLine) {
    std::vector<std::uint32_t> indexOf(mesh.number_of_vertices(), Nowhere);
    bool same = true;
    forEachOnLine(mesh, isOnLine, [&](Mesh::Vertex_index v) {
      const auto found = onLine_.find(keyOf(mesh.point(v)));
      same = same && found != onLine_.end();
      if (found != onLine_.end()) indexOf[v] = found->second;
    });
    if (!same) return false;
    for (const Mesh::Vertex_index v : mesh.vertices()) {
      if (indexOf[v] == Nowhere) indexOf[v] = add(mesh.point(v));
    }
    result.second = trianglesOf(mesh, indexOf);
    for (const Mesh::Edge_index e : mesh.edges()) {
      if (!isOnLine[e]) continue;
      const std::uint32_t a = indexOf[mesh.vertex(e, 0)];
      const std::uint32_t b = indexOf[mesh.vertex(e, 1)];
      result.line.push_back({std::min(a, b), std::max(a, b)});
    }
    return true;
  }

  Corefinement result;

 private:
  using Key = std::array<double, 3>;

  static Key keyOf(const Point& p) { return {p.x(), p.y(), p.z()}; }

  std::uint32_t add(const Point& p) {
    result.points.emplace_back(p.x(), p.y(), p.z());
    return static_cast<std::uint32_t>(result.points.size() - 1);
  }

  template <class F>
  static void forEachOnLine(const Mesh& mesh, const IsOnLine& isOnLine, F&& f) {
    for (const Mesh::Edge_index e : mesh.edges()) {
      if (!isOnLine[e]) continue;
      f(mesh.vertex(e, 0));
      f(mesh.vertex(e, 1));
    }
  }

  static std::vector<std::array<std::uint32_t, 3>> trianglesOf(
      const Mesh& mesh, const std::vector<std::uint32_t>& indexOf) {
    std::vector<std::array<std::uint32_t, 3>> triangles;
    triangles.reserve(mesh.number_of_faces());
    for (const Mesh::Face_index f : mesh.faces()) {
      std::array<std::uint32_t, 3> triangle{};
      auto corner = triangle.begin();
      for (const Mesh::Vertex_index v : CGAL::vertices_around_face(mesh.halfedge(f), mesh)) {
        *corner++ = indexOf[v];
      }
      triangles.push_back(triangle);
    }
    return triangles;
  }

  std::map<Key, std::uint32_t> onLine_;
};

}  // namespace

std::optional<Corefinement> corefined(const TriangleMesh& first, const TriangleMesh& second,
                                      const Progress& progress) {
  auto one = toCgal(first);
  auto other = toCgal(second);
  if (!one || !other) return {};
  std::vector<std::uint32_t> parentOf(one->number_of_faces());
  for (std::uint32_t f = 0; f < parentOf.size(); ++f) parentOf[f] = f;
  const IsOnLine oneLine = one->add_property_map<Mesh::Edge_index, bool>("e:line", false).first;
  const IsOnLine otherLine = other->add_property_map<Mesh::Edge_index, bool>("e:line", false).first;
  ParentVisitor visitor;
  visitor.progress = &progress;
  visitor.first = &*one;
  visitor.parentOf = &parentOf;
  try {
    PMP::corefine(*one, *other,
                  CGAL::parameters::visitor(visitor)
                      .edge_is_constrained_map(oneLine)
                      .throw_on_self_intersection(true),
                  CGAL::parameters::edge_is_constrained_map(otherLine));
  } catch (const PMP::Corefinement::Self_intersection_exception&) {
    return {};
  } catch (const PMP::Corefinement::Triple_intersection_exception&) {
    return {};
  }
  parentOf.resize(one->number_of_faces(), Nowhere);
  Joiner joiner;
  joiner.addFirst(*one, oneLine, std::move(parentOf));
  if (!joiner.addSecond(*other, otherLine)) return {};
  return std::move(joiner.result);
}

}  // namespace pneuma
