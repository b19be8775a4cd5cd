#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <span>
#include <string_view>
#include <vector>

#include "core/progress.h"
#include "growth/aggregation_lattice.h"

namespace pneuma {

/// What happens to a walker at the organ's wall.
enum class Wall {
  Reflect,  ///< the step is refused
  Absorb,   ///< the walker is removed, as in Zhang 2003
};

constexpr std::array<std::string_view, 2> choices(Wall) { return {"reflect", "absorb"}; }

/// How particles walk and stick (Zhang 2003, section 2); lengths in cells.
struct AggregationRules {
  Wall wall = Wall::Reflect;
  double mostSteps = 0.0;  ///< a walker that has taken more is removed; 0: no limit
  int step = 1;            ///< length of a step
  int reach = 1;           ///< a walker this near to a cluster cell touches it
};

/// Cells where walkers start, and how often.
template <int D>
struct LaunchGroup {
  double share = 1.0;     ///< of the launches, relative to the other groups
  double sticking = 1.0;  ///< probability that a walker that touches the cluster stays
  std::vector<LatticeCell<D>> sites;
};

/// A particle of the cluster and the one it stuck to, by the numbers of their cells.
struct AggregateParticle {
  std::uint32_t cell = 0;
  std::uint32_t parent = 0;  ///< a particle or a seed
};

/// Why aggregation ended.
enum class AggregationEnd {
  Complete,   ///< as many particles as wanted
  Saturated,  ///< every launch site has become cluster
  Starved,    ///< walkers no longer arrive: a hundred thousand in a row did not
};

struct AggregationResult {
  std::vector<AggregateParticle> particles;  ///< in order of arrival
  std::vector<std::uint64_t> stuck;          ///< particles by launch group
  std::uint64_t launches = 0;
  AggregationEnd end = AggregationEnd::Complete;
};

/// Diffusion-limited aggregation (Witten and Sander 1981) in a lattice whose cluster holds the
/// seeds.
template <int D>
class Aggregation {
 public:
  using Cell = LatticeCell<D>;

  /// May a particle in `cell` hang on `parent`, a cell of the cluster? Null: always.
  using Link = std::function<bool(const Cell& cell, const Cell& parent)>;

  /// Is told the particles that arrived since the last time.
  using Arrived = std::function<void(std::span<const AggregateParticle>)>;

  /// Opens what cannot be reached no more, and finds the walls.
  Aggregation(AggregationLattice<D>& lattice, const AggregationRules& rules, Link link = nullptr);

  /// Sends walkers until `count` of them have stuck.
  AggregationResult run(std::size_t count, std::vector<LaunchGroup<D>> groups, Random& random,
                        const Progress& progress = {}, const Arrived& arrived = nullptr);

  std::size_t unreachableCells() const { return unreachable_; }

 private:
  enum class Fate { Stuck, Lost };

  Fate walk(Cell cell, double sticking, Random& random, const Progress& progress);
  bool touch(const Cell& cell);
  void stick(const Cell& cell, Random& random);

  AggregationLattice<D>& lattice_;
  AggregationRules rules_;
  Link link_;
  std::size_t unreachable_ = 0;
  std::vector<Cell> touched_;  ///< cluster cells that the walker touches
  std::vector<Cell> nearby_;   ///< displacements within reach, nearest first
  bool coarse_;                ///< steps or reach longer than a cell
  int reflectReach_;
  AggregateParticle newest_;
};

extern template class Aggregation<2>;
extern template class Aggregation<3>;

/// The tables of jumps, made once.
template <int D>
const CubeWalk<D>& cubeWalk();

}  // namespace pneuma
