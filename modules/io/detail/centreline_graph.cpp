#include "io/detail/centreline_graph.h"

#include <algorithm>
#include <cstdint>
#include <span>
#include <unordered_set>
#include <utility>

#include "core/error.h"
#include "io/detail/point_tree.h"
#include "io/detail/text_fields.h"

namespace pneuma {
namespace {

/// Ends whose radii differ by less than this share count as equally wide.
constexpr double EqualWidth = 0.01;

/// The neighbours of every point, in the order of the edges.
class Neighbours {
 public:
  template <class Edges>
  Neighbours(std::size_t points, const Edges& edges) : offsets_(points + 1, 0) {
    for (const auto& edge : edges) {
      ++offsets_[static_cast<std::size_t>(edge.from) + 1];
      ++offsets_[static_cast<std::size_t>(edge.to) + 1];
    }
    for (std::size_t i = 0; i < points; ++i) offsets_[i + 1] += offsets_[i];
    ids_.resize(2 * edges.size());
    std::vector<std::size_t> next(offsets_.begin(), offsets_.end() - 1);
    for (const auto& edge : edges) {
      ids_[next[static_cast<std::size_t>(edge.from)]++] = edge.to;
      ids_[next[static_cast<std::size_t>(edge.to)]++] = edge.from;
    }
  }

  std::span<const int> of(int point) const {
    const auto i = static_cast<std::size_t>(point);
    return std::span(ids_).subspan(offsets_[i], offsets_[i + 1] - offsets_[i]);
  }

 private:
  std::vector<std::size_t> offsets_;
  std::vector<int> ids_;
};

}  // namespace

int CentrelineGraph::addPoint(const Vec3& position, double radiusMm) {
  const std::uint32_t point = points_.add(position);
  if (point == radiiMm_.size()) radiiMm_.push_back(radiusMm);
  return static_cast<int>(point);
}

void CentrelineGraph::addEdge(int from, int to) {
  if (from != to) edges_.push_back({from, to});
}

std::vector<CentrelineGraph::Edge> CentrelineGraph::distinctEdges() const {
  std::vector<Edge> edges = edges_;
  std::unordered_set<std::uint64_t> seen;
  seen.reserve(edges.size());
  std::erase_if(edges, [&](const Edge& edge) {
    const auto [low, high] = std::minmax(edge.from, edge.to);
    return !seen.insert(static_cast<std::uint64_t>(low) << 32 | static_cast<std::uint64_t>(high))
                .second;
  });
  return edges;
}

int CentrelineGraph::rootOf(const std::vector<Edge>& edges, const std::string& name) const {
  const std::size_t count = points_.points().size();
  std::vector<int> incoming(count, 0);
  std::vector<int> degree(count, 0);
  for (const Edge& edge : edges) {
    ++incoming[static_cast<std::size_t>(edge.to)];
    ++degree[static_cast<std::size_t>(edge.from)];
    ++degree[static_cast<std::size_t>(edge.to)];
  }
  const auto sources = std::count(incoming.begin(), incoming.end(), 0);
  const auto source =
      static_cast<std::size_t>(std::find(incoming.begin(), incoming.end(), 0) - incoming.begin());
  const bool directed = sources == 1 && *std::max_element(incoming.begin(), incoming.end()) == 1;
  if (directed && degree[source] == 1) return static_cast<int>(source);

  double widest = 0.0;
  for (std::size_t i = 0; i < count; ++i) {
    if (degree[i] == 1) widest = std::max(widest, radiiMm_[i]);
  }
  int root = -1;
  double highest = 0.0;
  for (std::size_t i = 0; i < count; ++i) {
    const double z = points_.points()[i].z();
    if (degree[i] != 1 || radiiMm_[i] < (1.0 - EqualWidth) * widest) continue;
    if (root < 0 || z > highest) {
      root = static_cast<int>(i);
      highest = z;
    }
  }
  if (root < 0) {
    throw InvalidInput(name +
                       " has no end to begin at: its lines run in a cycle; an airway tree has "
                       "none");
  }
  return root;
}

AirwayTree CentrelineGraph::tree(const std::string& name) const {
  const std::vector<Vec3>& points = points_.points();
  const std::size_t count = points.size();
  const std::vector<Edge> edges = distinctEdges();
  if (edges.empty()) {
    throw InvalidInput(name + " holds no two joined points, so no airway; is it the right file?");
  }
  const Neighbours neighbours(count, edges);
  const int root = rootOf(edges, name);

  // From the root outwards; a neighbour met before, other than the way back, closes a cycle.
  PointTree tree;
  tree.nodes.resize(count);
  std::vector<char> seen(count, 0);
  seen[static_cast<std::size_t>(root)] = 1;
  std::vector<int> waiting = {root};
  while (!waiting.empty()) {
    const int point = waiting.back();
    waiting.pop_back();
    PointTree::Node& node = tree.nodes[static_cast<std::size_t>(point)];
    node.position = points[static_cast<std::size_t>(point)];
    node.radiusMm = radiiMm_[static_cast<std::size_t>(point)];
    for (const int next : neighbours.of(point)) {
      if (next == node.parent) continue;
      if (std::exchange(seen[static_cast<std::size_t>(next)], 1) != 0) {
        throw InvalidInput(name + " has a cycle through the point " +
                           pointText(points[static_cast<std::size_t>(next)]) +
                           "; an airway tree has none, so remove one of the lines there");
      }
      tree.nodes[static_cast<std::size_t>(next)].parent = point;
      waiting.push_back(next);
    }
  }
  for (std::size_t i = 0; i < count; ++i) {
    if (seen[i] != 0) continue;
    throw InvalidInput(name + " falls into several pieces, one of them at " + pointText(points[i]) +
                       "; an airway tree is one piece with one root, so join or remove the others");
  }
  return treeOfPoints(tree, name);
}

}  // namespace pneuma
