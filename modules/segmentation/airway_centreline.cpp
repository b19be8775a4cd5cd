#include "segmentation/airway_centreline.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <queue>

#include "segmentation/distance_map.h"
#include "segmentation/voxel_box.h"

namespace pneuma {
namespace {

// Branches shorter than this beyond their parent's wall are none.
constexpr double LeastBranchMm = 5.0;
constexpr double LeastBranchSlices = 2.0;
constexpr double WideMm = 4.0;  ///< half-width from which an airway is covered widely
constexpr double MostHalfWidthMm = 25.0;
// A branch's radius by its volume stays near the mean distance to the wall.
constexpr double LeastOfHalfWidth = 0.5;
constexpr double MostOfHalfWidth = 1.4;
constexpr float Infinite = std::numeric_limits<float>::infinity();

/// A path that comes this near to a point of the tree, as a share of the half-width there, has
/// reached it: noise would else let two paths run side by side through a wide airway.
constexpr double JoinShare = 0.5;

double coverMm(double halfWidth) {
  return halfWidth > WideMm ? 2.0 * halfWidth + 2.0 : 1.5 * halfWidth + 1.0;
}

/// Voxels of the mask with their way to the root.
struct Ways {
  VoxelBox box;
  Vec3 spacing;
  std::vector<std::int32_t> indexIn;   ///< of the box: index into the arrays below, or -1
  std::vector<Eigen::Vector3i> voxel;  ///< in the box
  std::vector<float> halfWidthMm;      ///< distance to the nearest voxel outside
  std::vector<std::int32_t> towardsRoot;
  std::vector<float> lengthMm;  ///< of the way to the root; infinite if there is none
};

Ways waysOf(const ImageGeometry& geometry, const AirwayMask& mask, const Progress& progress) {
  Ways ways;
  ways.spacing = geometry.spacing;
  const std::size_t slice = geometry.sliceCount();
  const auto width = static_cast<std::size_t>(geometry.size[0]);
  const auto at = [&](std::uint32_t v) {
    return Eigen::Vector3i(static_cast<int>(v % slice % width), static_cast<int>(v % slice / width),
                           static_cast<int>(v / slice));
  };
  Eigen::Vector3i low = Eigen::Vector3i::Constant(1 << 30);
  Eigen::Vector3i high = Eigen::Vector3i::Constant(-1);
  for (const std::uint32_t v : mask.voxels) {
    low = low.cwiseMin(at(v));
    high = high.cwiseMax(at(v));
  }
  ways.box = boxAround(low, high);  // one voxel of outside all around
  ways.indexIn.assign(ways.box.voxelCount(), -1);
  std::vector<std::uint8_t> outside(ways.box.voxelCount(), 1);
  for (const std::uint32_t v : mask.voxels) {
    const Eigen::Vector3i p = at(v) - ways.box.low;
    const std::size_t b = ways.box.index(p.x(), p.y(), p.z());
    ways.indexIn[b] = static_cast<std::int32_t>(ways.voxel.size());
    ways.voxel.push_back(p);
    outside[b] = 0;
  }
  const std::vector<float> distance2 =
      squaredDistances(outside, ways.box.size, geometry.spacing, MostHalfWidthMm, progress);
  for (const Eigen::Vector3i& p : ways.voxel) {
    const float d2 = distance2[ways.box.index(p.x(), p.y(), p.z())];
    ways.halfWidthMm.push_back(std::min(std::sqrt(d2), static_cast<float>(MostHalfWidthMm)));
  }
  ways.towardsRoot.assign(ways.voxel.size(), -1);
  ways.lengthMm.assign(ways.voxel.size(), Infinite);
  return ways;
}

/// Calls `f(neighbour, stepMm)` for the up to 26 neighbours of a voxel in the mask.
template <class F>
void forEachNeighbour(const Ways& ways, std::size_t v, F&& f) {
  const Eigen::Vector3i& p = ways.voxel[v];
  for (int dz = -1; dz <= 1; ++dz) {
    for (int dy = -1; dy <= 1; ++dy) {
      for (int dx = -1; dx <= 1; ++dx) {
        // The box has a margin of one voxel, so that no index leaves it.
        const std::int32_t n = ways.indexIn[ways.box.index(p.x() + dx, p.y() + dy, p.z() + dz)];
        if (n < 0 || static_cast<std::size_t>(n) == v) continue;
        f(static_cast<std::size_t>(n), Vec3(dx, dy, dz).cwiseProduct(ways.spacing).norm());
      }
    }
  }
}

/// Dijkstra from the root; middle ways are cheap.
void findWays(Ways& ways, std::size_t root) {
  using Entry = std::pair<double, std::size_t>;
  std::vector<double> cost(ways.voxel.size(), std::numeric_limits<double>::infinity());
  std::priority_queue<Entry, std::vector<Entry>, std::greater<>> heap;
  cost[root] = 0.0;
  ways.lengthMm[root] = 0.0F;
  heap.emplace(0.0, root);
  while (!heap.empty()) {
    const auto [reached, v] = heap.top();
    heap.pop();
    if (reached > cost[v]) continue;
    forEachNeighbour(ways, v, [&](std::size_t n, double step) {
      const double width = ways.halfWidthMm[n];
      const double to = reached + step / (width * width);
      if (to >= cost[n]) return;
      cost[n] = to;
      ways.towardsRoot[n] = static_cast<std::int32_t>(v);
      ways.lengthMm[n] = ways.lengthMm[v] + static_cast<float>(step);
      heap.emplace(to, n);
    });
  }
}

/// A point of the tree before branches are made of it.
struct Node {
  int parent = -1;
  Vec3 position = Vec3::Zero();  ///< mm in the image's axes, from voxel (0, 0, 0)
  double halfWidthMm = 0.0;      ///< distance to the nearest voxel outside
  int children = 0;
  int voxels = 0;  ///< of the mask that belong to it
};

class TreeOfPaths {
 public:
  TreeOfPaths(const Ways& ways, std::size_t root)
      : ways_(ways),
        nodeNear_(ways.voxel.size(), -1),
        nodeAwayMm_(ways.voxel.size(), Infinite),
        covered_(ways.voxel.size(), 0) {
    cover(root, addNode(root, -1));
  }

  void grow(const Progress& progress) {
    const double least = std::max(LeastBranchMm, LeastBranchSlices * ways_.spacing.z());
    std::vector<std::size_t> order;
    for (std::size_t v = 0; v < ways_.voxel.size(); ++v) {
      if (ways_.lengthMm[v] != Infinite) order.push_back(v);
    }
    std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
      return ways_.lengthMm[a] > ways_.lengthMm[b];
    });
    std::vector<std::size_t> path;
    for (std::size_t n = 0; n < order.size(); ++n) {
      if (n % 1024 == 0) {
        progress.report(static_cast<double>(n) / static_cast<double>(order.size()));
      }
      if (covered_[order[n]] != 0) continue;
      path.clear();
      std::size_t v = order[n];
      while (nodeNear_[v] < 0) {
        path.push_back(v);
        v = static_cast<std::size_t>(ways_.towardsRoot[v]);
      }
      const double length = ways_.lengthMm[order[n]] - ways_.lengthMm[v];
      if (length - ways_.halfWidthMm[v] < least) continue;
      int node = nodeNear_[v];
      if (node == 0 && nodes_.size() > 1) node = 1;  // one branch alone leaves the root
      for (auto at = path.rbegin(); at != path.rend(); ++at) node = addNode(*at, node);
      // The last node made belongs to the first voxel of the path.
      for (const std::size_t at : path) cover(at, node--);
    }
    // Every voxel belongs to the point at which its way to the root meets the tree.
    for (const std::size_t first : order) {
      std::size_t at = first;
      while (nodeNear_[at] < 0) at = static_cast<std::size_t>(ways_.towardsRoot[at]);
      ++nodes_[static_cast<std::size_t>(nodeNear_[at])].voxels;
    }
  }

  std::vector<Node>& nodes() { return nodes_; }

 private:
  int addNode(std::size_t v, int parent) {
    const auto index = static_cast<int>(nodes_.size());
    const Vec3 voxel = (ways_.voxel[v] + ways_.box.low).cast<double>();
    nodes_.push_back({parent, voxel.cwiseProduct(ways_.spacing), ways_.halfWidthMm[v], 0, 0});
    if (parent >= 0) ++nodes_[static_cast<std::size_t>(parent)].children;
    return index;
  }

  void cover(std::size_t v, int node) {
    const double join = JoinShare * ways_.halfWidthMm[v];
    const double radius = coverMm(ways_.halfWidthMm[v]);
    const Eigen::Vector3i& p = ways_.voxel[v];
    Eigen::Vector3i low;
    Eigen::Vector3i high;
    for (int axis = 0; axis < 3; ++axis) {
      const int reach = static_cast<int>(radius / ways_.spacing[axis]);
      low[axis] = std::max(p[axis] - reach, 0);
      high[axis] = std::min(p[axis] + reach, ways_.box.size[static_cast<std::size_t>(axis)] - 1);
    }
    for (int k = low.z(); k <= high.z(); ++k) {
      for (int j = low.y(); j <= high.y(); ++j) {
        for (int i = low.x(); i <= high.x(); ++i) {
          const std::int32_t n = ways_.indexIn[ways_.box.index(i, j, k)];
          if (n < 0) continue;
          const auto at = static_cast<std::size_t>(n);
          const Vec3 steps = (Eigen::Vector3i(i, j, k) - p).cast<double>();
          const double away = steps.cwiseProduct(ways_.spacing).norm();
          if (away <= radius) covered_[at] = 1;
          if (away <= join && away < nodeAwayMm_[at]) {
            nodeAwayMm_[at] = static_cast<float>(away);
            nodeNear_[at] = node;
          }
        }
      }
    }
  }

  const Ways& ways_;
  std::vector<int> nodeNear_;      ///< the node that a voxel is near enough to to join it, or -1
  std::vector<float> nodeAwayMm_;  ///< its distance
  std::vector<std::uint8_t> covered_;
  std::vector<Node> nodes_;
};

/// Takes the stairs of the voxels out of points and half-widths; root and ends stay.
void smooth(std::vector<Node>& nodes, double overMm) {
  double spacing = 0.0;
  for (const Node& node : nodes) {
    if (node.parent >= 0) {
      spacing += (node.position - nodes[static_cast<std::size_t>(node.parent)].position).norm();
    }
  }
  spacing /= std::max<double>(1.0, static_cast<double>(nodes.size()) - 1.0);
  // One round spreads a point by half the square of the spacing.
  const int rounds =
      std::clamp(static_cast<int>(std::lround(2.0 * overMm * overMm / (spacing * spacing))), 1, 50);
  for (int round = 0; round < rounds; ++round) {
    const std::vector<Node> before = nodes;
    std::vector<Vec3> below(nodes.size(), Vec3::Zero());
    std::vector<double> widthBelow(nodes.size(), 0.0);
    for (const Node& node : before) {
      if (node.parent < 0) continue;
      const auto parent = static_cast<std::size_t>(node.parent);
      below[parent] += node.position;
      widthBelow[parent] += node.halfWidthMm;
    }
    for (std::size_t n = 0; n < nodes.size(); ++n) {
      const Node& old = before[n];
      if (old.parent < 0 || old.children == 0) continue;
      const Node& parent = before[static_cast<std::size_t>(old.parent)];
      const Vec3 child = below[n] / old.children;
      nodes[n].position = 0.5 * old.position + 0.25 * (parent.position + child);
      nodes[n].halfWidthMm =
          0.5 * old.halfWidthMm + 0.25 * (parent.halfWidthMm + widthBelow[n] / old.children);
    }
  }
}

/// Branches from junction to junction. A branch has the radius of the cylinder of its length and
/// volume, its points share it out as the distances to the wall do: these alone are too coarse
/// where an airway is two voxels wide.
AirwayTree treeOf(const ImageGeometry& geometry, const std::vector<Node>& nodes) {
  const auto placeOf = [&](const Node& node) -> Vec3 {
    return geometry.origin + geometry.direction * node.position;
  };
  AirwayTree tree;
  std::vector<int> branchEndingAt(nodes.size(), -1);
  // Nodes are stored parents first; a branch is made at its far end.
  for (std::size_t n = 0; n < nodes.size(); ++n) {
    if (nodes[n].parent < 0 || nodes[n].children == 1) continue;
    std::vector<std::size_t> way;  // far end to near end
    std::size_t at = n;
    double voxels = 0.0;
    double halfWidths = 0.0;
    while (true) {
      way.push_back(at);
      voxels += nodes[at].voxels;
      halfWidths += nodes[at].halfWidthMm;
      at = static_cast<std::size_t>(nodes[at].parent);
      if (nodes[at].parent < 0 || nodes[at].children != 1) break;
    }
    Branch branch;
    branch.proximal = placeOf(nodes[at]);
    branch.distal = placeOf(nodes[n]);
    branch.parent = branchEndingAt[at];
    branch.origin = Origin::Measured;
    branch.lobe = Lobe::Central;
    const double meanHalfWidth = halfWidths / static_cast<double>(way.size());
    for (auto w = way.rbegin(); w + 1 != way.rend(); ++w) {
      branch.via.push_back({placeOf(nodes[*w]), nodes[*w].halfWidthMm});
    }
    const double cylinder =
        std::sqrt(voxels * geometry.voxelMm3() / (std::numbers::pi * lengthMm(branch)));
    branch.radiusMm =
        std::clamp(cylinder, LeastOfHalfWidth * meanHalfWidth, MostOfHalfWidth * meanHalfWidth);
    for (CentrelinePoint& p : branch.via) p.radiusMm *= branch.radiusMm / meanHalfWidth;
    branchEndingAt[n] = tree.add(std::move(branch));
  }
  return tree;
}

}  // namespace

AirwayTree airwayCentreline(const ImageGeometry& geometry, const AirwayMask& mask,
                            const Progress& progress) {
  if (mask.voxels.empty()) return {};
  Ways ways = waysOf(geometry, mask, progress);
  const auto rootAt = std::lower_bound(mask.voxels.begin(), mask.voxels.end(), mask.root);
  const auto root = static_cast<std::size_t>(rootAt - mask.voxels.begin());
  progress.report(0.3);
  findWays(ways, root);
  progress.report(0.5);
  TreeOfPaths paths(ways, root);
  paths.grow(progress.part(0.5, 1.0, "drawing the centreline"));
  smooth(paths.nodes(), std::max(geometry.spacing.z(), 1.5));
  return treeOf(geometry, paths.nodes());
}

}  // namespace pneuma
