#include "growth/aggregate_tree.h"

#include <algorithm>

#include "core/units.h"

namespace pneuma {
namespace {

constexpr std::uint32_t None = 0xFFFFFFFFU;

// Of a voxel: a point of a chain this near to the straight line past it may be left out.
constexpr double StraightWithin = 0.2;

/// Which particles stay, and how they hang together.
class Skeleton {
 public:
  Skeleton(const LobeAggregate& aggregate, int minTwig)
      : parents_(aggregate.parents), kept_(parents_.size(), 0), daughters_(parents_.size(), 0) {
    const std::size_t count = parents_.size();
    std::vector<int> height(count, 1);  // particles to the farthest tip
    std::vector<std::uint32_t> tallest(count, None);
    std::vector<char> isMother(count, 0);
    for (std::size_t i = count; i-- > 0;) {
      if (isMother[i] == 0) ++tips_.all;
      if (parents_[i] < 0) continue;
      const auto parent = static_cast<std::size_t>(parents_[i]);
      isMother[parent] = 1;
      // Of equals the one that came first: i falls.
      if (height[i] + 1 >= height[parent]) {
        height[parent] = height[i] + 1;
        tallest[parent] = static_cast<std::uint32_t>(i);
      }
    }
    keepTall(height, tallest, minTwig);
  }

  bool kept(std::size_t particle) const { return kept_[particle] != 0; }

  int daughters(std::size_t particle) const { return daughters_[particle]; }

  /// A particle where a branch ends.
  bool isNode(std::size_t particle) const { return kept(particle) && daughters(particle) != 1; }

  AggregateTips tips() const { return tips_; }

 private:
  void keepTall(const std::vector<int>& height, const std::vector<std::uint32_t>& tallest,
                int minTwig) {
    std::size_t tallestRoot = parents_.size();
    bool any = false;
    for (std::size_t i = 0; i < parents_.size(); ++i) {
      const bool tall = height[i] >= minTwig;
      if (parents_[i] < 0) {
        kept_[i] = tall ? 1 : 0;
        any = any || tall;
        if (tallestRoot == parents_.size() || height[i] > height[tallestRoot]) tallestRoot = i;
      } else {
        const auto parent = static_cast<std::size_t>(parents_[i]);
        kept_[i] = kept(parent) && (tall || tallest[parent] == i) ? 1 : 0;
        if (kept(i)) ++daughters_[parent];
      }
    }
    // A lobe that got few particles keeps its longest twig all the same.
    if (!any && tallestRoot < parents_.size()) {
      std::uint32_t next = static_cast<std::uint32_t>(tallestRoot);
      for (; tallest[next] != None; next = tallest[next]) {
        kept_[next] = 1;
        daughters_[next] = 1;
      }
      kept_[next] = 1;
    }
    for (std::size_t i = 0; i < parents_.size(); ++i) {
      if (kept(i) && daughters(i) == 0) ++tips_.kept;
    }
  }

  const std::vector<std::int32_t>& parents_;
  std::vector<char> kept_;
  std::vector<int> daughters_;
  AggregateTips tips_;
};

/// The particles' positions, smoothed as far as the ways between them stay in the lobe.
class SmoothedPositions {
 public:
  SmoothedPositions(const LobeAggregate& aggregate, const Skeleton& skeleton, int passes)
      : aggregate_(aggregate), skeleton_(skeleton), positions_(aggregate.positions) {
    for (int pass = 0; pass < passes; ++pass) smooth();
    if (passes > 0) takeBackWhatLeaves();
  }

  const Vec3& operator[](std::size_t particle) const { return positions_[particle]; }

  const Vec3& parentOf(std::size_t particle) const {
    const std::int32_t parent = aggregate_.parents[particle];
    return parent >= 0 ? positions_[static_cast<std::size_t>(parent)]
                       : aggregate_.seeds[static_cast<std::size_t>(~parent)].point;
  }

 private:
  /// Half of itself, a quarter of its parent, a quarter of its daughters' mean; tips stay.
  void smooth() {
    std::vector<Vec3> sums(positions_.size(), Vec3::Zero());
    for (std::size_t i = 0; i < positions_.size(); ++i) {
      const std::int32_t parent = aggregate_.parents[i];
      if (skeleton_.kept(i) && parent >= 0) sums[static_cast<std::size_t>(parent)] += positions_[i];
    }
    std::vector<Vec3> next = positions_;
    for (std::size_t i = 0; i < positions_.size(); ++i) {
      if (!skeleton_.kept(i) || skeleton_.daughters(i) == 0) continue;
      next[i] = 0.5 * positions_[i] + 0.25 * parentOf(i) + 0.25 * sums[i] / skeleton_.daughters(i);
    }
    positions_ = std::move(next);
  }

  void takeBackWhatLeaves() {
    const std::size_t count = positions_.size();
    std::vector<char> changed(count, 1);
    for (bool any = true; any;) {
      any = false;
      std::vector<char> changes(count, 0);
      for (std::size_t i = 0; i < count; ++i) {
        const std::int32_t parent = aggregate_.parents[i];
        const bool parentChanged = parent >= 0 && changed[static_cast<std::size_t>(parent)] != 0;
        if (!skeleton_.kept(i) || (changed[i] == 0 && !parentChanged)) continue;
        if (aggregate_.region.domain->containsSegment(parentOf(i), positions_[i])) continue;
        any = takeBack(i, changes) || any;
        if (parent >= 0) any = takeBack(static_cast<std::size_t>(parent), changes) || any;
      }
      changed = std::move(changes);
    }
  }

  bool takeBack(std::size_t particle, std::vector<char>& changes) {
    if (positions_[particle] == aggregate_.positions[particle]) return false;
    positions_[particle] = aggregate_.positions[particle];
    changes[particle] = 1;
    return true;
  }

  const LobeAggregate& aggregate_;
  const Skeleton& skeleton_;
  std::vector<Vec3> positions_;
};

/// A way through points without those that say nothing: never two in a row, and only where the
/// straight way stays in the lobe.
std::vector<CentrelinePoint> thinned(const std::vector<Vec3>& way, const Domain& domain,
                                     double withinMm) {
  std::vector<CentrelinePoint> points;
  Vec3 last = way.front();
  for (std::size_t i = 1; i + 1 < way.size(); ++i) {
    const Vec3 past = way[i + 1] - last;
    const double off = past.cross(way[i] - last).norm();
    if (off < withinMm * past.norm() && domain.containsSegment(last, way[i + 1])) {
      ++i;  // the next one stays
      if (i + 1 >= way.size()) break;
    }
    points.push_back({way[i], 0.0});
    last = way[i];
  }
  return points;
}

}  // namespace

AggregateTips appendAggregate(AirwayTree& tree, const LobeAggregate& aggregate,
                              const AggregateTreeRules& rules) {
  const Skeleton skeleton(aggregate, rules.minTwig);
  const SmoothedPositions positions(aggregate, skeleton, rules.smoothing);
  const Domain& domain = *aggregate.region.domain;
  const double tipMl = millilitres(domain.volumeMm3()) /
                       static_cast<double>(std::max<std::size_t>(skeleton.tips().kept, 1));
  std::vector<int> branchOf(aggregate.parents.size(), -1);
  std::vector<Vec3> way;
  for (std::size_t node = 0; node < aggregate.parents.size(); ++node) {
    if (!skeleton.isNode(node)) continue;
    Branch branch;
    way = {positions[node]};
    std::int32_t at = aggregate.parents[node];
    while (at >= 0 && !skeleton.isNode(static_cast<std::size_t>(at))) {
      way.push_back(positions[static_cast<std::size_t>(at)]);
      at = aggregate.parents[static_cast<std::size_t>(at)];
    }
    if (at >= 0) {
      branch.parent = branchOf[static_cast<std::size_t>(at)];
    } else {
      const AirwaySeed& seed = aggregate.seeds[static_cast<std::size_t>(~at)];
      branch.parent = seed.parent;
      const bool atEnd = seed.point == tree[static_cast<std::size_t>(seed.parent)].distal;
      if (!atEnd) way.push_back(seed.point);
      way.insert(way.end(), seed.way.rbegin(), seed.way.rend());
    }
    const Branch& parent = tree[static_cast<std::size_t>(branch.parent)];
    way.push_back(parent.distal);
    std::ranges::reverse(way);
    branch.proximal = parent.distal;
    branch.distal = positions[node];
    branch.via = thinned(way, domain, StraightWithin * aggregate.voxelMm);
    branch.lobe = aggregate.region.lobe;
    branch.segment = parent.segment;
    if (skeleton.daughters(node) == 0) branch.suppliedMl = tipMl;
    branchOf[node] = tree.add(std::move(branch));
  }
  return skeleton.tips();
}

}  // namespace pneuma
