#include "support/plain_kitaoka.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <vector>

namespace pneuma::testing {
namespace {

constexpr double Exponent = 2.8;
constexpr double Degree = std::numbers::pi / 180.0;
constexpr int Cells = 20;

/// A half-space: normal . (p - point) >= 0.
struct Half {
  Vec3 point;
  Vec3 normal;

  double depth(const Vec3& p) const { return normal.dot(p - point); }
};

/// Inside if it lies in all halves (all = true) or in any of them.
struct Constraint {
  std::vector<Half> halves;
  bool all = true;

  bool holds(const Vec3& p) const {
    const auto inside = [&](const Half& half) { return half.depth(p) >= 0.0; };
    return all ? std::ranges::all_of(halves, inside) : std::ranges::any_of(halves, inside);
  }
};

struct Tube {
  Vec3 start;
  Vec3 end;
  double radius;

  bool holds(const Vec3& p) const {
    const Vec3 way = end - start;
    const double t = std::clamp((p - start).dot(way) / way.squaredNorm(), 0.0, 1.0);
    return (p - start - t * way).norm() < radius;
  }
};

struct Node {
  Vec3 tip;
  Vec3 u;
  Vec3 b;
  double flow;
  int generation;
  bool given;
  std::vector<Constraint> constraints;
  std::vector<Tube> ancestors;
  Box3 box;
};

double angleOfShare(double share) {
  const double s2 = std::pow(share, 2.0 / Exponent);
  const double s4 = std::pow(share, 4.0 / Exponent);
  const double rest4 = std::pow(1.0 - share, 4.0 / Exponent);
  return std::acos(std::clamp((1.0 + s4 - rest4) / (2.0 * s2), -1.0, 1.0));
}

class Plain {
 public:
  Plain(const Domain& organ, double trunkDiameter, double threshold)
      : organ_(organ), trunkDiameter_(trunkDiameter), threshold_(threshold) {}

  void grow(Node node) {
    if (!node.given && !inRegion(node, node.tip)) return fail(node);
    const std::vector<Vec3> cells = cellsOf(node);
    if (cells.size() < 2) return fail(node);
    Split split = splitAt(node, cells, 90.0);
    if (split.smaller() < 0.05) {
      const Split plus = splitAt(node, cells, 99.0);
      const Split minus = splitAt(node, cells, 81.0);
      const double step = plus.smaller() >= minus.smaller() ? 9.0 : -9.0;
      split = step > 0.0 ? plus : minus;
      for (int i = 2; i <= 19 && split.smaller() < 0.05; ++i) {
        split = splitAt(node, cells, 90.0 + i * step);
      }
      if (split.smaller() < 0.05) return fail(node);
    }
    double share = split.share;
    if (node.flow < 1.5 * threshold_ && split.smaller() < 0.35) {
      share = share < 0.5 ? 0.35 : 0.65;
    }
    addDaughter(node, cells, split, split.w, split.side, share);
    addDaughter(node, cells, split, -split.w, restOf(split.side), 1.0 - share);
  }

  PlainTree result(const Branch& trunk) const {
    PlainTree tree;
    tree.branches = branches_ + 1;
    tree.terminals = good_.size() + failed_;
    tree.failedFlow = failedFlow_;
    double mean = 0.0;
    double square = 0.0;
    for (const double flow : good_) {
      mean += flow / static_cast<double>(good_.size());
      square += flow * flow / static_cast<double>(good_.size());
    }
    tree.terminalFlowVariation = std::sqrt(square - mean * mean) / mean;
    const double trunkLength = (trunk.distal - trunk.proximal).norm();
    tree.airwayVolumeMl =
        (volume_ + std::numbers::pi * trunk.radiusMm * trunk.radiusMm * trunkLength) / 1000.0;
    tree.generation = generations_ / static_cast<double>(tree.terminals);
    tree.lengthToDiameter = ratios_ / static_cast<double>(branches_);
    return tree;
  }

 private:
  struct Split {
    Vec3 w;
    Constraint side;
    double share = 0.0;

    double smaller() const { return std::min(share, 1.0 - share); }
  };

  void fail(const Node& node) {
    ++failed_;
    failedFlow_ += node.flow;
    generations_ += node.generation;
  }

  bool inRegion(const Node& node, const Vec3& p) const {
    return organ_.contains(p) &&
           std::ranges::all_of(node.constraints, [&](const Constraint& c) { return c.holds(p); });
  }

  std::vector<Vec3> cellsOf(const Node& node) const {
    std::vector<Vec3> cells;
    const Vec3 step = node.box.sizes() / Cells;
    for (int k = 0; k < Cells; ++k)
      for (int j = 0; j < Cells; ++j)
        for (int i = 0; i < Cells; ++i) {
          const Vec3 p = node.box.min() + step.cwiseProduct(Vec3(i + 0.5, j + 0.5, k + 0.5));
          if (inRegion(node, p) && std::ranges::none_of(node.ancestors, [&](const Tube& tube) {
                return tube.holds(p);
              })) {
            cells.push_back(p);
          }
        }
    return cells;
  }

  static double shareOf(const std::vector<Vec3>& cells, const Constraint& side) {
    const auto in = std::ranges::count_if(cells, [&](const Vec3& p) { return side.holds(p); });
    return static_cast<double>(in) / static_cast<double>(cells.size());
  }

  static Constraint restOf(const Constraint& side) {
    Constraint rest{side.halves, !side.all || side.halves.size() == 1};
    for (Half& half : rest.halves) half.normal = -half.normal;
    return rest;
  }

  static Split splitAt(const Node& node, const std::vector<Vec3>& cells, double rotation) {
    Split split;
    split.w =
        std::cos(rotation * Degree) * node.b.cross(node.u) + std::sin(rotation * Degree) * node.b;
    split.side = {{{node.tip, split.w}}, true};
    split.share = shareOf(cells, split.side);
    if (split.share > 0.5) {
      split.w = -split.w;
      split.side = restOf(split.side);
      split.share = shareOf(cells, split.side);
    }
    const double bend = (angleOfShare(split.share) - angleOfShare(1.0 - split.share)) / 2.0;
    if (2.0 * bend >= 10.0 * Degree) {
      const Vec3 front = std::cos(bend) * split.w - std::sin(bend) * node.u;
      split.side.halves.push_back({node.tip, front});
      split.share = shareOf(cells, split.side);
    }
    return split;
  }

  double distanceAlong(const Node& daughter, const Vec3& from, const Vec3& direction) const {
    // Until the first wall, in steps far below what rule 7a distinguishes.
    double low = 0.0;
    const double step = 0.02 * trunkDiameter_ * std::pow(daughter.flow, 1.0 / Exponent);
    const Vec3 start = from + 1e-6 * direction;
    while (inRegion(daughter, start + (low + step) * direction)) low += step;
    return low;
  }

  void addDaughter(const Node& node, const std::vector<Vec3>& cells, const Split& split,
                   const Vec3& w, const Constraint& side, double share) {
    ++branches_;
    std::vector<double> angles;
    Box3 box;
    for (const Vec3& p : cells) {
      if (!side.holds(p)) continue;
      const Vec3 way = p - node.tip;
      angles.push_back(std::atan2(way.dot(w), way.dot(node.u)));
      box.extend(p);
    }
    double angle = angleOfShare(share);
    if (!angles.empty()) {
      const auto middle = angles.begin() + static_cast<std::ptrdiff_t>(angles.size() / 2);
      std::ranges::nth_element(angles, middle);
      if (angle < *middle) angle = std::min(90.0 * Degree, (angle + *middle) / 2.0);
    }
    Node daughter{.tip = node.tip,
                  .u = std::cos(angle) * node.u + std::sin(angle) * w,
                  .b = node.u.cross(split.w),
                  .flow = node.flow * share,
                  .generation = node.generation + 1,
                  .given = false,
                  .constraints = node.constraints,
                  .ancestors = node.ancestors,
                  .box = node.box};
    daughter.constraints.push_back(side);
    const double diameter = trunkDiameter_ * std::pow(daughter.flow, 1.0 / Exponent);
    double ratio = 3.0;
    const bool terminal = daughter.flow < threshold_;
    if (!terminal) {
      const double distance = distanceAlong(daughter, node.tip, daughter.u) / diameter;
      if (distance / ratio < 3.0) {
        while (distance / ratio < 3.0 && ratio > 1.0) ratio -= 0.25;
      } else {
        while (distance / ratio > 6.0) ratio += 0.25;
      }
    }
    daughter.tip = node.tip + ratio * diameter * daughter.u;
    ratios_ += ratio;
    volume_ += std::numbers::pi / 4.0 * diameter * diameter * ratio * diameter;
    if (terminal) {
      good_.push_back(daughter.flow);
      generations_ += daughter.generation;
      return;
    }
    const Vec3 margin = 1.5 * node.box.sizes() / Cells;  // half a cell, and one more
    daughter.box = Box3(box.min() - margin, box.max() + margin).intersection(node.box);
    daughter.ancestors.push_back({node.tip, daughter.tip, diameter / 2.0});
    grow(std::move(daughter));
  }

  const Domain& organ_;
  double trunkDiameter_;
  double threshold_;
  std::size_t branches_ = 0;
  std::size_t failed_ = 0;
  double failedFlow_ = 0.0;
  double volume_ = 0.0;
  double ratios_ = 0.0;
  double generations_ = 0.0;
  std::vector<double> good_;
};

}  // namespace

PlainTree growPlainly(const Domain& organ, const Branch& trunk, const Vec3& widest,
                      double flowThreshold) {
  Plain plain(organ, 2.0 * trunk.radiusMm, flowThreshold);
  plain.grow({.tip = trunk.distal,
              .u = (trunk.distal - trunk.proximal).normalized(),
              .b = widest,
              .flow = 1.0,
              .generation = 0,
              .given = true,
              .constraints = {},
              .ancestors = {{trunk.proximal, trunk.distal, trunk.radiusMm}},
              .box = organ.bounds()});
  return plain.result(trunk);
}

}  // namespace pneuma::testing
