// The tree of Kitaoka 1999, 55,000 branches in the simple organ, beside the plain reading of the
// paper in the same run.

#include <benchmark/benchmark.h>

#include "anatomy/organ.h"
#include "core/parallel.h"
#include "growth/kitaoka.h"
#include "growth/row_kernels.h"
#include "support/plain_kitaoka.h"

namespace pneuma {
namespace {

/// range(0): InstructionSet; range(1): threads.
void kitaoka(benchmark::State& state) {
  const auto set = static_cast<InstructionSet>(state.range(0));
  if (!available(set)) {
    state.SkipWithError("this machine has not got these instructions");
    return;
  }
  const RowKernelChoice choice(set);
  const ThreadLimit limit(static_cast<unsigned>(state.range(1)));
  const Organ organ = simpleOrgan();
  const std::vector<LobeRegion> lobes = {organ.region};
  std::size_t branches = 0;
  for (auto _ : state) {
    branches = growByKitaoka(organ.central, lobes, kitaokaPaper()).tree.size();
  }
  state.SetLabel(std::string(rowKernels().name));
  state.counters["branches"] = static_cast<double>(branches);
}

BENCHMARK(kitaoka)
    ->ArgNames({"instructions", "threads"})
    ->Args({0, 1})
    ->Args({1, 1})
    ->Args({2, 1})
    ->Args({2, 2})
    ->UseRealTime()
    ->Unit(benchmark::kMillisecond);

void kitaokaPlainly(benchmark::State& state) {
  const Organ organ = simpleOrgan();
  std::size_t branches = 0;
  for (auto _ : state) {
    branches = testing::growPlainly(*organ.region.domain, organ.central[0], Vec3::UnitX(),
                                    kitaokaPaper().flowThreshold)
                   .branches;
  }
  state.counters["branches"] = static_cast<double>(branches);
}

BENCHMARK(kitaokaPlainly)->Name("kitaoka_plainly")->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace pneuma
