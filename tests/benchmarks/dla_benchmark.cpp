// Diffusion-limited aggregation on one thread, beside the walk step by step where that ends.

#include <benchmark/benchmark.h>

#include "anatomy/right_lung.h"
#include "core/parallel.h"
#include "growth/dla.h"
#include "growth/free_cluster.h"
#include "growth/outline_aggregation.h"
#include "support/plain_aggregation.h"

namespace pneuma {
namespace {

void outlineAggregation(benchmark::State& state) {
  for (auto _ : state) {
    benchmark::DoNotOptimize(growInOutline({.particles = 10000}).walkers);
  }
}

BENCHMARK(outlineAggregation)->Name("dla_outline_10000")->Unit(benchmark::kMillisecond);

/// Growth in the synthetic right lung, from surfaces to branches; range(0): particles, range(1):
/// side of a voxel, hundredths of a millimetre.
void dla(benchmark::State& state) {
  const ThreadLimit one(1);
  const RightLung lung = rightLung();
  DlaOptions options;
  options.particles = static_cast<std::uint64_t>(state.range(0));
  options.voxelMm = static_cast<double>(state.range(1)) / 100.0;
  std::size_t branches = 0;
  for (auto _ : state) {
    branches = growByDla(lung.central, lung.lobes, options).tree.size();
  }
  state.counters["branches"] = static_cast<double>(branches);
  state.counters["particles_per_s"] = benchmark::Counter(
      static_cast<double>(options.particles), benchmark::Counter::kIsIterationInvariantRate);
}

BENCHMARK(dla)
    ->ArgNames({"particles", "voxel"})
    ->Args({100000, 120})
    ->Args({1000000, 45})
    ->Unit(benchmark::kMillisecond);

void freeClusters(benchmark::State& state) {
  for (auto _ : state) {
    benchmark::DoNotOptimize(state.range(0) == 2 ? freeCluster<2>(100000, 1).size()
                                                 : freeCluster<3>(40000, 1).size());
  }
}

BENCHMARK(freeClusters)->Name("dla_free")->Arg(2)->Arg(3)->Unit(benchmark::kMillisecond);

constexpr int BallRadius = 30;
constexpr std::size_t BallParticles = 2000;

bool insideBall(const LatticeCell<3>& cell) {
  return (cell.array() - BallRadius - 1).matrix().squaredNorm() <= BallRadius * BallRadius;
}

AggregationLattice<3> ballLattice() {
  AggregationLattice<3> lattice(LatticeCell<3>::Constant(2 * BallRadius + 3));
  LatticeCell<3> cell;
  for (cell[2] = 0; cell[2] < 2 * BallRadius + 3; ++cell[2])
    for (cell[1] = 0; cell[1] < 2 * BallRadius + 3; ++cell[1])
      for (cell[0] = 0; cell[0] < 2 * BallRadius + 3; ++cell[0]) {
        if (insideBall(cell)) lattice.setOpen(cell);
      }
  return lattice;
}

/// The same small ball by the engine and step by step: what jumps are worth.
void ballByJumps(benchmark::State& state) {
  for (auto _ : state) {
    AggregationLattice<3> lattice = ballLattice();
    LaunchGroup<3> group{1.0, 1.0, lattice.wallCells()};
    lattice.addToCluster(LatticeCell<3>::Constant(BallRadius + 1));
    Aggregation<3> aggregation(lattice, {});
    Random random(1);
    benchmark::DoNotOptimize(aggregation.run(BallParticles, {std::move(group)}, random).launches);
  }
}

void ballStepByStep(benchmark::State& state) {
  for (auto _ : state) {
    testing::PlainAggregation<3> plain(insideBall, ballLattice().wallCells(),
                                       LatticeCell<3>::Constant(BallRadius + 1));
    Random random(1);
    benchmark::DoNotOptimize(plain.run(BallParticles, random).size());
  }
}

BENCHMARK(ballByJumps)->Name("dla_ball")->Unit(benchmark::kMillisecond);
BENCHMARK(ballStepByStep)->Name("dla_ball_plainly")->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace pneuma
