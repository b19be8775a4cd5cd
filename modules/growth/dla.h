#pragma once

#include <cstdint>
#include <span>
#include <tuple>

#include "core/options.h"
#include "core/progress.h"
#include "growth/aggregation.h"
#include "growth/growth_result.h"

namespace pneuma {

/// Options of growth by diffusion-limited aggregation. Zhang 2003 works in two dimensions
/// (growth/outline_aggregation.h); these are its rules in three, with the defaults that fill a lung
/// (docs/algorithms/dla.md).
struct DlaOptions {
  std::uint64_t particles = 100000;
  std::uint64_t terminals = 0;
  double voxelMm = 0.0;
  Wall wall = Wall::Reflect;
  double mostSteps = 0.0;
  double sticking = 1.0;
  double shareRul = 0.0;
  double shareRml = 0.0;
  double shareRll = 0.0;
  double shareLul = 0.0;
  double shareLll = 0.0;
  int minTwig = 4;
  int smoothing = 2;
  double diameterExponent = 3.0;
  std::uint64_t seed = 1;

  static constexpr auto fields() {
    using O = DlaOptions;
    constexpr Range Share{0.0, 1.0};
    return std::tuple{
        Field{"particles", &O::particles, "", Range{1, 2e7},
              "Particles of all lobes together (Zhang 2003: about 10,000, in a plane)."},
        Field{
            "terminals", &O::terminals, "", Range{0, 1e6},
            "Choose the number of particles for about this many terminals; 0: as particles says."},
        Field{"voxel", &O::voxelMm, "mm", Range{0.0, 20.0},
              "Side of a voxel: the size of a particle, its step and how near it must come. 0: so "
              "that the particles just fill the lobes."},
        Field{
            "wall", &O::wall, "", Range{},
            "What happens to a walker at the wall: its step is refused (reflect), or it is removed "
            "as in the paper (absorb)."},
        Field{"most-steps", &O::mostSteps, "", Range{0.0, 1e12},
              "A walker that has taken more steps is removed (the paper: 10,000); 0: no limit."},
        Field{"sticking", &O::sticking, "", Range{0.001, 1.0},
              "Probability that a walker that touches the cluster stays there."},
        Field{"share-rul", &O::shareRul, "", Share,
              "Share of the walkers that start in the right upper lobe. All shares 0: by volume; "
              "otherwise they sum to 1."},
        Field{"share-rml", &O::shareRml, "", Share, "The same for the right middle lobe."},
        Field{"share-rll", &O::shareRll, "", Share, "The same for the right lower lobe."},
        Field{"share-lul", &O::shareLul, "", Share, "The same for the left upper lobe."},
        Field{"share-lll", &O::shareLll, "", Share, "The same for the left lower lobe."},
        Field{
            "min-twig", &O::minTwig, "", Range{1, 1000},
            "Side twigs with fewer particles from foot to farthest tip are left out of the tree."},
        Field{"smoothing", &O::smoothing, "", Range{0, 20},
              "Passes that smooth the staircase of the lattice."},
        Field{"diameter-exponent", &O::diameterExponent, "", Range{1.5, 4.0},
              "Exponent n of flow = D^n (Murray: 3); every tip takes the same flow."},
        Field{"seed", &O::seed, "", Range{0, 9007199254740991.0},
              "Seed of everything random: same seed, same tree."},
    };
  }

  bool operator==(const DlaOptions&) const = default;
};

/// Side of a voxel at which this many particles just fill a lobe, mm: clusters of dimension 2.5
/// that reach from wall to wall (measured, docs/algorithms/dla.md).
double fillingVoxelMm(double volumeMm3, double particles);

/// Fills the lobes by diffusion-limited aggregation from the central airways in them: walkers start
/// at the inside of each lobe's wall, walk at random and stay where they touch what has grown. Each
/// lobe is a lattice of its own. The aggregates become branches by growth/aggregate_tree.h.
/// @throws InvalidInput, InvalidOption, Cancelled (see growAirways)
GrowthResult growByDla(const AirwayTree& central, std::span<const LobeRegion> lobes,
                       const DlaOptions& options, const Progress& progress = {});

}  // namespace pneuma
