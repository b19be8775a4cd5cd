// Growth alone: the points and the lobes are prepared before the clock starts.

#include <cmath>

#include <benchmark/benchmark.h>

#include "anatomy/central_airways.h"
#include "anatomy/right_lung.h"
#include "core/parallel.h"
#include "core/units.h"
#include "growth/point_splitter.h"
#include "growth/seeding.h"

namespace pneuma {
namespace {

struct Prepared {
  RightLung lung = rightLung();
  std::vector<Inlet> inlets = assignLobes(lung.central, lung.lobes);
  SeedPoints seeds;

  explicit Prepared(double points)
      : seeds(points == 103894.0 ? seedExactly(lung.lobes, 103894, 0.0, 1)
                                 : seedLattice(lung.lobes, std::cbrt(3.5e6 / points), 0.0, 1)) {}

  std::size_t growAll(Containment containment) const {
    const SplitRules rules{.minLengthMm = 1.2 * seeds.spacingMm / 3.2298,
                           .minAngleRad = radians(20.0),
                           .maxAngleRad = radians(60.0),
                           .containment = containment,
                           .spacingMm = seeds.spacingMm,
                           .anchor = seeds.anchor};
    std::size_t branches = 0;
    for (const Inlet& inlet : inlets) {
      const Branch& branch = lung.central[inlet.branch];
      const SplitInlet from{branch.distal, direction(branch),
                            direction(lung.central[static_cast<std::size_t>(branch.parent)])};
      branches +=
          splitPoints(from, seeds.byRegion[inlet.region], *lung.lobes[inlet.region].domain, rules)
              .branches.size();
    }
    return branches;
  }
};

/// range(0): points; range(1): Containment. One core.
void growth(benchmark::State& state) {
  const ThreadLimit one(1);
  const Prepared prepared(static_cast<double>(state.range(0)));
  std::size_t branches = 0;
  for (auto _ : state) {
    branches = prepared.growAll(static_cast<Containment>(state.range(1)));
    benchmark::DoNotOptimize(branches);
  }
  const auto points = static_cast<double>(prepared.seeds.count());
  state.counters["branches"] = static_cast<double>(branches);
  // Flat for O(n log n).
  state.counters["per_n_log2_n"] =
      benchmark::Counter(points * std::log2(points), benchmark::Counter::kIsIterationInvariantRate |
                                                         benchmark::Counter::kInvert);
  state.SetComplexityN(static_cast<std::int64_t>(points));
}

BENCHMARK(growth)
    ->ArgNames({"points", "containment"})
    ->Args({103894, 0})
    ->Args({103894, 1})
    ->Args({103894, 2})
    ->Unit(benchmark::kMillisecond);
BENCHMARK(growth)
    ->Name("growth_by_size")
    ->ArgNames({"points", "containment"})
    ->Args({100000, 0})
    ->Args({300000, 0})
    ->Args({1000000, 0})
    ->Args({3000000, 0})
    ->Unit(benchmark::kMillisecond)
    ->Complexity(benchmark::oNLogN);

}  // namespace
}  // namespace pneuma
