#include "growth/airway_seeds.h"

#include <algorithm>
#include <cmath>

namespace pneuma {
namespace {

/// The centreline of a branch from its distal to its proximal end.
std::vector<Vec3> backwards(const Branch& branch) {
  std::vector<Vec3> points = {branch.distal};
  for (auto point = branch.via.rbegin(); point != branch.via.rend(); ++point) {
    points.push_back(point->position);
  }
  points.push_back(branch.proximal);
  return points;
}

/// Points of one branch, while they stay inside.
struct Traced {
  struct Point {
    Vec3 at;
    std::size_t piece = 0;  ///< of `backwards`, that it lies on
    double alongMm = 0.0;   ///< from the distal end
  };

  std::vector<Point> points;
  bool whole = true;  ///< inside up to the proximal end
};

Traced traced(const std::vector<Vec3>& line, const Domain& domain, double stepMm) {
  Traced result;
  double before = 0.0;
  Vec3 last = line.front();
  for (std::size_t piece = 0; piece + 1 < line.size(); ++piece) {
    const Vec3 way = line[piece + 1] - line[piece];
    const int steps = std::max(1, static_cast<int>(std::ceil(way.norm() / stepMm)));
    for (int k = 1; k <= steps; ++k) {
      const double share = static_cast<double>(k) / steps;
      const Vec3 at = line[piece] + share * way;
      if (!domain.containsSegment(last, at)) {
        result.whole = false;
        return result;
      }
      result.points.push_back({at, piece, before + share * way.norm()});
      last = at;
    }
    before += way.norm();
  }
  return result;
}

}  // namespace

std::vector<AirwaySeed> airwaySeeds(const AirwayTree& central, std::span<const std::size_t> inlets,
                                    const Domain& domain, double stepMm) {
  std::vector<AirwaySeed> seeds;
  std::vector<std::size_t> branches(inlets.begin(), inlets.end());
  for (const std::size_t inlet : inlets) {
    seeds.push_back({central[inlet].distal, static_cast<int>(inlet), {}});
  }
  std::vector<char> known(central.size(), 0);
  for (const std::size_t inlet : inlets) known[inlet] = 1;
  for (std::size_t k = 0; k < branches.size(); ++k) {
    const Branch& branch = central[branches[k]];
    const std::vector<Vec3> line = backwards(branch);
    const Traced trace = traced(line, domain, stepMm);
    const double length = lengthMm(branch);
    for (const Traced::Point& point : trace.points) {
      AirwaySeed seed{point.at, static_cast<int>(branches[k]), {}};
      const bool fromProximal = trace.whole && branch.parent >= 0 && point.alongMm > length / 2.0;
      if (fromProximal) {
        seed.parent = branch.parent;
        for (std::size_t i = line.size() - 2; i > point.piece; --i) seed.way.push_back(line[i]);
      } else {
        for (std::size_t i = 1; i <= point.piece; ++i) seed.way.push_back(line[i]);
      }
      seeds.push_back(std::move(seed));
    }
    if (!trace.whole || branch.parent < 0) continue;
    const auto parent = static_cast<std::size_t>(branch.parent);
    if (known[parent] != 0) continue;
    known[parent] = 1;
    branches.push_back(parent);
  }
  return seeds;
}

}  // namespace pneuma
