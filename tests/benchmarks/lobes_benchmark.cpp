#include <cmath>
#include <map>

#include <benchmark/benchmark.h>

#include "core/random.h"
#include "geometry/self_intersections.h"
#include "geometry/test_surfaces.h"
#include "lobes/fissure_fit.h"
#include "lobes/fissure_proposal.h"
#include "lobes/lobe_splitting.h"

// Splitting lungs into lobes, beside the full check of the lung for self-intersections.
namespace pneuma {
namespace {

constexpr double SpacingMm = 2.5;

/// An egg of a lung's size; triangles by the power of 4.
const TriangleMesh& lungOf(int subdivisions) {
  static std::map<int, TriangleMesh> made;
  const auto known = made.find(subdivisions);
  if (known != made.end()) return known->second;
  TriangleMesh mesh = testing::sphere(1.0, Vec3::Zero(), subdivisions);
  for (Vec3& p : mesh.points) {
    p = p.cwiseProduct(Vec3(55.0, 80.0, 115.0)) * (1.0 - 0.15 * p.z());
  }
  return made.emplace(subdivisions, std::move(mesh)).first->second;
}

/// Through 12 points that lie about 5 mm from the proposals.
FissureSurfaces fissures(const TriangleMesh& lung, Side side) {
  Random random(1);
  FissureSurfaces surfaces;
  const LungBox box = lungBox(lung);
  for (const Fissure fissure : fissuresOf(side)) {
    const HeightSurface proposed = proposedFissure(fissure, box);
    std::vector<Vec3> points;
    for (int i = 0; i < 12; ++i) {
      const double u = random.uniform(0.1, 0.9) * (box.high.x() - box.low.x());
      const double v = random.uniform(0.1, 0.9) * (box.high.y() - box.low.y());
      points.push_back(proposed.at({u, v}) + Vec3(0.0, 0.0, random.uniform(-8.0, 8.0)));
    }
    surfaces[fissure] = fitFissure(points);
  }
  return surfaces;
}

void fiveLobes(benchmark::State& state) {
  const TriangleMesh& lung = lungOf(static_cast<int>(state.range(0)));
  const FissureSurfaces right = fissures(lung, Side::Right);
  const FissureSurfaces left = fissures(lung, Side::Left);
  for (auto _ : state) {
    benchmark::DoNotOptimize(splitLung(lung, Side::Right, right, SpacingMm));
    benchmark::DoNotOptimize(splitLung(lung, Side::Left, left, SpacingMm));
  }
  state.counters["triangles"] = 2.0 * static_cast<double>(lung.triangles.size());
}

BENCHMARK(fiveLobes)->DenseRange(5, 7)->Unit(benchmark::kMillisecond)->MeasureProcessCPUTime();

void fullCheckOfBothLungs(benchmark::State& state) {
  const TriangleMesh& lung = lungOf(static_cast<int>(state.range(0)));
  for (auto _ : state) {
    for (int n = 0; n < 2; ++n) benchmark::DoNotOptimize(selfIntersecting(lung).pairs);
  }
}

BENCHMARK(fullCheckOfBothLungs)
    ->DenseRange(5, 7)
    ->Unit(benchmark::kMillisecond)
    ->MeasureProcessCPUTime();

/// What a moved point costs: the fit, and the side of every point of the right lung.
void sidesOfPoints(benchmark::State& state) {
  const TriangleMesh& lung = lungOf(7);
  const FissureSurfaces right = fissures(lung, Side::Right);
  std::vector<char> side(lung.points.size());
  for (auto _ : state) {
    const HeightSurface& moved = right.at(Fissure::RightOblique);
    for (std::size_t v = 0; v < side.size(); ++v) side[v] = moved.height(lung.points[v]) < 0.0;
    benchmark::DoNotOptimize(side.data());
  }
  state.counters["triangles"] = static_cast<double>(lung.triangles.size());
}

BENCHMARK(sidesOfPoints)->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace pneuma
