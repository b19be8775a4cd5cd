#pragma once

#include <array>
#include <cstdint>
#include <string_view>
#include <tuple>
#include <vector>

#include "anatomy/airway_tree.h"
#include "core/options.h"
#include "core/progress.h"
#include "growth/aggregate_tree.h"
#include "growth/aggregation.h"

namespace pneuma {

/// What the "reaction probability" of a region of the outline is (Zhang 2003, 2.1).
enum class ReactionProbability {
  Launch,    ///< its share of the walkers
  Sticking,  ///< the probability that a walker from it stays where it touches the cluster
};

constexpr std::array<std::string_view, 2> choices(ReactionProbability) {
  return {"launch", "sticking"};
}

/// Options of Zhang's own experiment: aggregation in the outline of a right lung, in a plane.
/// The defaults are those with which the paper's 10,000 particles fit (docs/algorithms/dla.md).
struct OutlineAggregationOptions {
  std::uint64_t particles = 10000;
  double pixelMm = 0.6;
  Wall wall = Wall::Reflect;
  double mostSteps = 0.0;
  ReactionProbability reaction = ReactionProbability::Launch;
  double upper = 0.2;
  double middle = 0.3;
  double lower = 0.5;
  int step = 1;
  int reach = 1;
  double seedXMm = 0.0;
  double seedZMm = 0.0;
  std::uint64_t seed = 1;

  static constexpr auto fields() {
    using O = OutlineAggregationOptions;
    return std::tuple{
        Field{"particles", &O::particles, "", Range{1, 1e6}, "Particles that are wanted."},
        Field{"pixel", &O::pixelMm, "mm", Range{0.05, 10.0},
              "Side of a pixel; the paper does not tell its own."},
        Field{"wall", &O::wall, "", Range{},
              "What happens to a walker at the outline: reflect, or absorb as in the paper."},
        Field{"most-steps", &O::mostSteps, "", Range{0.0, 1e12},
              "A walker that has taken more steps is removed (the paper: 10,000); 0: no limit."},
        Field{
            "reaction", &O::reaction, "", Range{},
            "What upper, middle and lower are: shares of the walkers (launch) or probabilities to "
            "stay (sticking)."},
        Field{"upper", &O::upper, "", Range{0.0, 1.0}, "Reaction probability, upper region."},
        Field{"middle", &O::middle, "", Range{0.0, 1.0}, "Reaction probability, middle region."},
        Field{"lower", &O::lower, "", Range{0.0, 1.0}, "Reaction probability, lower region."},
        Field{"step", &O::step, "", Range{1, 100}, "Length of a step, pixels."},
        Field{"reach", &O::reach, "", Range{1, 100},
              "Aggregation distance: a walker this near to the cluster stays, pixels."},
        Field{"seed-x", &O::seedXMm, "mm", Range{-100.0, 100.0},
              "Shift of the first airways away from the midline."},
        Field{"seed-z", &O::seedZMm, "mm", Range{-200.0, 200.0}, "Shift of the first airways up."},
        Field{"seed", &O::seed, "", Range{0, 9007199254740991.0}, "Seed of everything random."},
    };
  }

  bool operator==(const OutlineAggregationOptions&) const = default;
};

/// What has grown in the outline. LPS, mm, in the plane y = 0; the carina is the origin.
struct OutlineAggregate {
  LobeAggregate cluster;
  AirwayTree tree;  ///< first airways and every particle, nothing pruned or smoothed
  AggregateTips tips;
  std::vector<Vec3> outline;                  ///< corners, in order
  std::vector<Vec3> keyPoints;                ///< from which walkers start
  std::vector<std::size_t> keyPointRegions;   ///< 0 upper, 1 middle, 2 lower
  std::array<std::uint64_t, 3> started = {};  ///< particles by the region they started from
  std::array<std::uint64_t, 3> stuck = {};    ///< particles by the region they ended in
  std::array<double, 3> reached = {};         ///< share of a region within 10 pixels of the cluster
  std::uint64_t walkers = 0;
  AggregationEnd end = AggregationEnd::Complete;
};

/// Zhang 2003: walkers start from 80 key points of the outline in three regions (upper, middle,
/// lower), the first two generations of airways being the initial cluster.
/// @throws InvalidOption if shares do not sum to 1, or the first airways lie off the lung;
/// Cancelled
OutlineAggregate growInOutline(const OutlineAggregationOptions& options,
                               const Progress& progress = {});

}  // namespace pneuma
