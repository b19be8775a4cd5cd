#include "geometry/mesh_topology.h"

#include <algorithm>
#include <array>
#include <numeric>
#include <span>
#include <string>

#include "core/disjoint_sets.h"
#include "core/error.h"

namespace pneuma {
namespace {

using Index = std::uint32_t;
using Triangle = std::array<Index, 3>;

constexpr std::size_t MaxTriangles = 1'000'000'000;  // three corners each must fit an Index

bool namesAPointTwice(const Triangle& t) { return t[0] == t[1] || t[1] == t[2] || t[2] == t[0]; }

/// Things filed under a point: the things of point v are items[begin[v]] .. items[begin[v + 1] -
/// 1].
template <class T>
struct ByPoint {
  std::vector<Index> begin;
  std::vector<T> items;

  std::span<T> of(std::size_t v) {
    return std::span(items).subspan(begin[v], begin[v + 1] - begin[v]);
  }
};

/// Files an item under a point for every call of `file(point, item)` that `visit(file)` makes.
template <class T, class Visit>
ByPoint<T> filed(std::size_t points, Visit&& visit) {
  ByPoint<T> byPoint;
  byPoint.begin.assign(points + 1, 0);
  visit([&](Index v, const T&) { ++byPoint.begin[v + 1]; });
  std::partial_sum(byPoint.begin.begin(), byPoint.begin.end(), byPoint.begin.begin());
  byPoint.items.resize(byPoint.begin.back());
  std::vector<Index> next(byPoint.begin.begin(), byPoint.begin.end() - 1);
  visit([&](Index v, const T& item) { byPoint.items[next[v]++] = item; });
  return byPoint;
}

/// One triangle's side, filed under the smaller of its two points.
struct HalfEdge {
  Index other = 0;       ///< the larger point
  Index corner = 0;      ///< 3 * triangle + k: the side from the triangle's point k to its next
  bool forwards = true;  ///< runs from the smaller point to the larger
};

Index nextCorner(Index corner) { return corner % 3 == 2 ? corner - 2 : corner + 1; }

ByPoint<HalfEdge> halfEdges(const TriangleMesh& mesh) {
  return filed<HalfEdge>(mesh.points.size(), [&](auto&& file) {
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
      const Triangle& triangle = mesh.triangles[t];
      if (namesAPointTwice(triangle)) continue;
      for (std::size_t k = 0; k < 3; ++k) {
        const Index from = triangle[k];
        const Index to = triangle[(k + 1) % 3];
        file(std::min(from, to),
             HalfEdge{std::max(from, to), static_cast<Index>(3 * t + k), from < to});
      }
    }
  });
}

std::size_t duplicates(const TriangleMesh& mesh) {
  using Pair = std::array<Index, 2>;
  auto others = filed<Pair>(mesh.points.size(), [&](auto&& file) {
    for (Triangle t : mesh.triangles) {
      std::ranges::sort(t);
      file(t[0], Pair{t[1], t[2]});
    }
  });
  std::size_t count = 0;
  for (std::size_t v = 0; v < mesh.points.size(); ++v) {
    const std::span<Pair> pairs = others.of(v);
    std::ranges::sort(pairs);
    count += pairs.size() - (std::ranges::unique(pairs).begin() - pairs.begin());
  }
  return count;
}

class TopologyCount {
 public:
  explicit TopologyCount(const TriangleMesh& mesh)
      : mesh_(mesh), pieces_(mesh.triangles.size()), fans_(3 * mesh.triangles.size()) {}

  MeshTopology result() {
    countEdges();
    countFans();
    numberPieces();
    count_.duplicateTriangles = duplicates(mesh_);
    return std::move(count_);
  }

 private:
  void countEdges() {
    auto edges = halfEdges(mesh_);
    for (std::size_t v = 0; v < mesh_.points.size(); ++v) {
      const std::span<HalfEdge> atPoint = edges.of(v);
      std::ranges::sort(atPoint, {},
                        [](const HalfEdge& e) { return std::pair(e.other, e.corner); });
      for (std::size_t first = 0; first < atPoint.size();) {
        std::size_t last = first + 1;
        while (last < atPoint.size() && atPoint[last].other == atPoint[first].other) ++last;
        countEdge(atPoint.subspan(first, last - first));
        first = last;
      }
    }
  }

  void countEdge(std::span<const HalfEdge> sides) {
    count_.openEdges += sides.size() == 1 ? 1 : 0;
    count_.nonManifoldEdges += sides.size() > 2 ? 1 : 0;
    count_.oddEdges += sides.size() % 2;
    count_.misorientedEdges += sides.size() == 2 && sides[0].forwards == sides[1].forwards ? 1 : 0;
    const auto low = [](const HalfEdge& e) { return e.forwards ? e.corner : nextCorner(e.corner); };
    const auto high = [](const HalfEdge& e) {
      return e.forwards ? nextCorner(e.corner) : e.corner;
    };
    for (const HalfEdge& side : sides.subspan(1)) {
      pieces_.join(sides[0].corner / 3, side.corner / 3);
      fans_.join(low(sides[0]), low(side));
      fans_.join(high(sides[0]), high(side));
    }
  }

  void countFans() {
    std::vector<std::uint8_t> fansAt(mesh_.points.size(), 0);
    for (std::size_t t = 0; t < mesh_.triangles.size(); ++t) {
      if (namesAPointTwice(mesh_.triangles[t])) continue;
      for (std::size_t k = 0; k < 3; ++k) {
        const auto corner = static_cast<Index>(3 * t + k);
        std::uint8_t& fans = fansAt[mesh_.triangles[t][k]];
        if (fans_.find(corner) == corner && fans < 2) ++fans;
      }
    }
    count_.nonManifoldVertices = static_cast<std::size_t>(std::ranges::count(fansAt, 2));
  }

  void numberPieces() {
    const std::size_t n = mesh_.triangles.size();
    count_.componentOf.resize(n);
    for (std::size_t t = 0; t < n; ++t) {
      if (namesAPointTwice(mesh_.triangles[t])) continue;
      const Index leader = pieces_.find(static_cast<Index>(t));
      count_.componentOf[t] =
          leader == t ? static_cast<Index>(count_.components++) : count_.componentOf[leader];
    }
    for (std::size_t t = 0; t < n; ++t) {
      if (namesAPointTwice(mesh_.triangles[t])) {
        count_.componentOf[t] = static_cast<Index>(count_.components);
      }
    }
  }

  const TriangleMesh& mesh_;
  DisjointSets pieces_;  // triangles joined by edges
  DisjointSets fans_;    // corners joined by edges that leave from the same point
  MeshTopology count_;
};

}  // namespace

MeshTopology topology(const TriangleMesh& mesh) { return TopologyCount(mesh).result(); }

void requireSound(const TriangleMesh& mesh) {
  if (mesh.triangles.size() > MaxTriangles) {
    throw InvalidInput("the surface has " + std::to_string(mesh.triangles.size()) +
                       " triangles, more than the 1,000,000,000 supported; simplify it");
  }
  for (std::size_t i = 0; i < mesh.points.size(); ++i) {
    if (!mesh.points[i].allFinite()) {
      throw InvalidInput("point " + std::to_string(i) +
                         " of the surface has a coordinate that is no number; export it again");
    }
  }
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    for (const Index v : mesh.triangles[t]) {
      if (v >= mesh.points.size()) {
        throw InvalidInput("triangle " + std::to_string(t) + " of the surface names point " +
                           std::to_string(v) + ", but there are only " +
                           std::to_string(mesh.points.size()) +
                           " points; the file is damaged, export it again");
      }
    }
  }
}

}  // namespace pneuma
