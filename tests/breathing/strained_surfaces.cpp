#include "breathing/strained_surfaces.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <random>
#include <utility>

#include "breathing/strain_assignment.h"
#include "geometry/test_surfaces.h"

namespace pneuma::testing {
namespace {

constexpr std::size_t LeastNeighbours = 4;

using Edge = std::pair<std::uint32_t, std::uint32_t>;

/// The corner that is not on the edge, with the edge's ends in the triangle's order.
std::uint32_t opposite(const std::array<std::uint32_t, 3>& triangle, Edge edge) {
  for (const std::uint32_t corner : triangle) {
    if (corner != edge.first && corner != edge.second) return corner;
  }
  return triangle[0];
}

/// Triangles of every directed edge.
std::map<Edge, std::size_t> edgesOf(const TriangleMesh& mesh) {
  std::map<Edge, std::size_t> edges;
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    const auto& corner = mesh.triangles[t];
    for (std::size_t c = 0; c < 3; ++c) edges[{corner[c], corner[(c + 1) % 3]}] = t;
  }
  return edges;
}

}  // namespace

TriangleMesh regularLung(int subdivisions) {
  TriangleMesh mesh = sphere(1.0, Vec3::Zero(), subdivisions);
  for (Vec3& p : mesh.points) {
    p = Vec3(-70.0, 10.0, 30.0) + p.cwiseProduct(Vec3(50.0, 80.0, 100.0));
  }
  return mesh;
}

TriangleMesh irregularLung(int subdivisions) {
  TriangleMesh mesh = regularLung(subdivisions);
  std::map<Edge, std::size_t> edges = edgesOf(mesh);
  std::vector<std::size_t> valence(mesh.points.size(), 0);
  std::vector<Edge> order;
  for (const auto& [edge, triangle] : edges) {
    ++valence[edge.first];
    if (edge.first < edge.second) order.push_back(edge);
  }
  std::mt19937 random(3);
  std::ranges::shuffle(order, random);
  order.resize(order.size() / 3);
  for (const auto& [a, b] : order) {
    const std::size_t left = edges.at({a, b});
    const std::size_t right = edges.at({b, a});
    const std::uint32_t c = opposite(mesh.triangles[left], {a, b});
    const std::uint32_t d = opposite(mesh.triangles[right], {a, b});
    if (edges.contains({c, d}) || valence[a] == LeastNeighbours || valence[b] == LeastNeighbours) {
      continue;
    }
    edges.erase({a, b});
    edges.erase({b, a});
    mesh.triangles[left] = {a, d, c};
    mesh.triangles[right] = {d, b, c};
    for (const std::size_t t : {left, right}) {
      const auto& corner = mesh.triangles[t];
      for (std::size_t k = 0; k < 3; ++k) edges[{corner[k], corner[(k + 1) % 3]}] = t;
    }
    --valence[a];
    --valence[b];
    ++valence[c];
    ++valence[d];
  }
  return mesh;
}

std::vector<double> publishedStrainOf(const TriangleMesh& surface) {
  return initialStrain(surface, diaphragmaticSurface(surface), StrainCurve::published());
}

double correlation(std::span<const double> a, std::span<const double> b) {
  const auto count = static_cast<double>(a.size());
  double meanA = 0.0;
  double meanB = 0.0;
  for (std::size_t n = 0; n < a.size(); ++n) {
    meanA += a[n] / count;
    meanB += b[n] / count;
  }
  double both = 0.0;
  double ofA = 0.0;
  double ofB = 0.0;
  for (std::size_t n = 0; n < a.size(); ++n) {
    both += (a[n] - meanA) * (b[n] - meanB);
    ofA += (a[n] - meanA) * (a[n] - meanA);
    ofB += (b[n] - meanB) * (b[n] - meanB);
  }
  return both / std::sqrt(ofA * ofB);
}

}  // namespace pneuma::testing
