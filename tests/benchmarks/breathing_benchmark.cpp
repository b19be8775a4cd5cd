#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <vector>

#include <benchmark/benchmark.h>
#include <sys/resource.h>

#include "breathing/elastic_surface.h"
#include "breathing/lung_frame.h"
#include "breathing/pitcher_catcher.h"
#include "breathing/posture.h"
#include "breathing/spring_network.h"
#include "core/moving_points.h"
#include "core/parallel.h"

// The forces of a lung's surface by the published network, solved and pitched; by the elastic
// surface; and a breath played back. Arguments: sides of the triangles along an edge of the
// octahedron that the lung is made from (4 n^2 + 2 points), and threads (0: all).
namespace pneuma {
namespace {

constexpr int Small = 112;    // 50,178 points
constexpr int Medium = 354;   // 501,266
constexpr int Large = 866;    // 2,999,826
constexpr int Quarter = 256;  // 262,146

/// A closed surface of a lung's size from an octahedron whose edges are cut into `n`.
TriangleMesh lungOf(int n) {
  const auto place = [n](int i, int j) {
    return static_cast<std::size_t>((i + n) * (2 * n + 1) + j + n);
  };
  std::vector<std::array<std::uint32_t, 2>> index(place(n, n) + 1);
  TriangleMesh mesh;
  for (int i = -n; i <= n; ++i) {
    for (int j = std::abs(i) - n; j <= n - std::abs(i); ++j) {
      const int height = n - std::abs(i) - std::abs(j);
      for (const int sign : {0, 1}) {
        if (sign == 0 || height > 0) {
          const Vec3 p = Vec3(i, j, sign == 0 ? height : -height).normalized();
          mesh.points.push_back(p.cwiseProduct(Vec3(60.0, 95.0, 130.0)) * (1.0 - 0.15 * p.z()));
        }
        index[place(i, j)][static_cast<std::size_t>(sign)] =
            static_cast<std::uint32_t>(mesh.points.size() - 1);
      }
    }
  }
  for (const int x : {1, -1}) {
    for (const int y : {1, -1}) {
      for (const int sign : {0, 1}) {
        const auto at = [&](int i, int j) {
          return index[place(x * i, y * j)][static_cast<std::size_t>(sign)];
        };
        const auto add = [&](std::uint32_t a, std::uint32_t b, std::uint32_t c) {
          if (x * y * (sign == 0 ? 1 : -1) < 0) std::swap(b, c);
          mesh.triangles.push_back({a, b, c});
        };
        for (int i = 0; i < n; ++i) {
          for (int j = 0; i + j < n; ++j) {
            add(at(i, j), at(i + 1, j), at(i, j + 1));
            if (i + j + 2 <= n) add(at(i + 1, j), at(i + 1, j + 1), at(i, j + 1));
          }
        }
      }
    }
  }
  return mesh;
}

std::vector<double> supineForce(const TriangleMesh& lung) {
  const LungFrame frame(Side::Left, bounds(lung));
  const auto law = forceCoefficients(Side::Left, gravityOf(Posture::Supine));
  std::vector<double> force;
  for (const Vec3& p : lung.points) force.push_back(forceAt(law, frame.shareOf(p)));
  return force;
}

/// Of the whole process so far; choose one benchmark to learn what it takes.
double peakMemoryMb() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return static_cast<double>(usage.ru_maxrss) / 1024.0;
}

void networkAssembled(benchmark::State& state) {
  const TriangleMesh lung = lungOf(static_cast<int>(state.range(0)));
  for (auto _ : state) benchmark::DoNotOptimize(SpringNetwork(lung));
  state.counters["points"] = static_cast<double>(lung.points.size());
}

void networkSolved(benchmark::State& state) {
  const TriangleMesh lung = lungOf(static_cast<int>(state.range(0)));
  const std::vector<double> force = supineForce(lung);
  const SpringNetwork network(lung);
  const ThreadLimit limit(static_cast<unsigned>(state.range(1)));
  for (auto _ : state) benchmark::DoNotOptimize(network.forces(force));
  state.counters["points"] = static_cast<double>(lung.points.size());
  state.counters["peak_MB"] = peakMemoryMb();
}

void networkPitchedByBuckets(benchmark::State& state) {
  const TriangleMesh lung = lungOf(static_cast<int>(state.range(0)));
  const std::vector<double> force = supineForce(lung);
  const SpringNetwork network(lung);
  for (auto _ : state) {
    benchmark::DoNotOptimize(pitchForces(network, force, {PitchOrder::Buckets, 1e-6}));
  }
  state.counters["points"] = static_cast<double>(lung.points.size());
}

/// How far the proxy is from the whole surface, by root mean square, %.
double apartPercent(const TriangleMesh& lung, const std::vector<double>& force,
                    const std::vector<double>& found) {
  const std::vector<double> whole =
      ElasticSurface(lung, {}, {10.0, lung.points.size()}).response(force, {1e-9});
  double difference = 0.0;
  double all = 0.0;
  for (std::size_t n = 0; n < whole.size(); ++n) {
    difference += (found[n] - whole[n]) * (found[n] - whole[n]);
    all += whole[n] * whole[n];
  }
  return 100.0 * std::sqrt(difference / all);
}

void elasticSurface(benchmark::State& state) {
  const TriangleMesh lung = lungOf(static_cast<int>(state.range(0)));
  const std::vector<double> force = supineForce(lung);
  const ThreadLimit limit(static_cast<unsigned>(state.range(1)));
  std::vector<double> found;
  for (auto _ : state) found = ElasticSurface(lung).response(force);
  state.counters["points"] = static_cast<double>(lung.points.size());
  if (state.range(0) == Quarter) state.counters["apart_%"] = apartPercent(lung, force, found);
}

/// One more force on a surface that is set up already, as each further posture or stiffness asks.
void elasticSurfaceAgain(benchmark::State& state) {
  const TriangleMesh lung = lungOf(static_cast<int>(state.range(0)));
  const std::vector<double> force = supineForce(lung);
  const ThreadLimit limit(static_cast<unsigned>(state.range(1)));
  const ElasticSurface surface(lung);
  for (auto _ : state) benchmark::DoNotOptimize(surface.response(force));
  state.counters["points"] = static_cast<double>(lung.points.size());
}

constexpr std::size_t LargeNumbers = 3 * (4 * std::size_t{Large} * Large + 2);

/// x = x0 + s u of as many points as the largest lung has, single precision.
void playback(benchmark::State& state) {
  const ThreadLimit limit(static_cast<unsigned>(state.range(0)));
  const std::vector<float> rest(LargeNumbers, 1.0F);
  const std::vector<float> u(LargeNumbers, 0.5F);
  std::vector<float> moved(LargeNumbers);
  float s = 0.0F;
  for (auto _ : state) {
    moveAlong(rest, u, s += 0.01F, moved);
    benchmark::ClobberMemory();
  }
  state.SetBytesProcessed(
      static_cast<std::int64_t>(state.iterations() * 3 * LargeNumbers * sizeof(float)));
}

/// The normals of these points besides.
void playbackOfNormals(benchmark::State& state) {
  const ThreadLimit limit(static_cast<unsigned>(state.range(0)));
  const std::vector<float> normals(LargeNumbers, 0.57735F);
  const std::vector<float> slope(LargeNumbers, 0.1F);
  std::vector<float> turned(LargeNumbers);
  float s = 0.0F;
  for (auto _ : state) {
    turnAlong(normals, slope, s += 0.01F, turned);
    benchmark::ClobberMemory();
  }
  state.SetBytesProcessed(
      static_cast<std::int64_t>(state.iterations() * 3 * LargeNumbers * sizeof(float)));
}

/// The same bytes copied, which nothing that reads and writes memory does faster: one read and one
/// written for each of three halves, on as many threads.
void copyOfAsManyBytes(benchmark::State& state) {
  const ThreadLimit limit(static_cast<unsigned>(state.range(0)));
  constexpr std::size_t Numbers = LargeNumbers * 3 / 2;
  constexpr std::size_t Piece = 1 << 16;
  const std::vector<float> from(Numbers, 1.0F);
  std::vector<float> to(Numbers);
  for (auto _ : state) {
    parallelFor((Numbers + Piece - 1) / Piece, [&](std::size_t n) {
      std::copy_n(from.data() + n * Piece, std::min(Piece, Numbers - n * Piece),
                  to.data() + n * Piece);
    });
    benchmark::ClobberMemory();
  }
  state.SetBytesProcessed(
      static_cast<std::int64_t>(state.iterations() * 2 * Numbers * sizeof(float)));
}

BENCHMARK(networkAssembled)->Arg(Small)->Arg(Medium)->Arg(Large)->Unit(benchmark::kMillisecond);
BENCHMARK(networkSolved)
    ->ArgsProduct({{Small, Medium, Large}, {1, 0}})
    ->Unit(benchmark::kMillisecond)
    ->UseRealTime();
BENCHMARK(networkPitchedByBuckets)
    ->Arg(Small)
    ->Arg(Medium)
    ->Arg(Large)
    ->Iterations(1)
    ->Unit(benchmark::kMillisecond);
BENCHMARK(elasticSurface)
    ->ArgsProduct({{Small, Quarter, Medium, Large}, {1, 0}})
    ->Unit(benchmark::kMillisecond)
    ->UseRealTime();
BENCHMARK(elasticSurfaceAgain)
    ->ArgsProduct({{Small, Quarter, Medium, Large}, {1, 0}})
    ->Unit(benchmark::kMillisecond)
    ->UseRealTime();
BENCHMARK(playback)->Arg(1)->Arg(0)->Unit(benchmark::kMillisecond)->UseRealTime();
BENCHMARK(playbackOfNormals)->Arg(1)->Arg(0)->Unit(benchmark::kMillisecond)->UseRealTime();
BENCHMARK(copyOfAsManyBytes)->Arg(1)->Arg(0)->Unit(benchmark::kMillisecond)->UseRealTime();

}  // namespace
}  // namespace pneuma
