// How fast this machine is just now: a fixed work of arithmetic and of memory, which knows nothing
// of Pneuma and must not change, as the figures of bench.sh are told in its time. Prints
// milliseconds by the clock and of the processor, the shortest of three.
#include <algorithm>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <ctime>
#include <numeric>
#include <utility>
#include <vector>

namespace {

constexpr std::size_t Places = std::size_t{1} << 22;  // 16 MB of indices: more than caches hold
constexpr int Steps = 1'000'000;
constexpr int Sums = 40'000'000;

std::uint64_t next(std::uint64_t& state) {
  state ^= state << 13;
  state ^= state >> 7;
  state ^= state << 17;
  return state;
}

/// One cycle through all places in an order that no prefetcher guesses (Sattolo).
std::vector<std::uint32_t> walk() {
  std::vector<std::uint32_t> places(Places);
  std::iota(places.begin(), places.end(), 0U);
  std::uint64_t state = 88172645463325252ULL;
  for (std::size_t i = Places - 1; i > 0; --i) std::swap(places[i], places[next(state) % i]);
  return places;
}

double work(const std::vector<std::uint32_t>& places) {
  std::uint32_t at = 0;
  for (int i = 0; i < Steps; ++i) at = places[at];
  std::uint64_t state = 1 + at;
  double x = 1.0;
  double y = 0.5;
  for (int i = 0; i < Sums; ++i) {
    x = x * 0.999999 + y;
    y = y * 0.5 + static_cast<double>(next(state) & 0xffU);
  }
  std::uint64_t sum = 0;
  for (int pass = 0; pass < 8; ++pass) sum = std::accumulate(places.begin(), places.end(), sum);
  return x + y + static_cast<double>(sum & 1U);
}

double processorMs() { return 1e3 * static_cast<double>(std::clock()) / CLOCKS_PER_SEC; }

}  // namespace

int main() {
  const std::vector<std::uint32_t> places = walk();
  double shortestReal = 1e300;
  double shortestProcessor = 1e300;
  double result = 0.0;
  for (int i = 0; i < 3; ++i) {
    const auto begin = std::chrono::steady_clock::now();
    const double processor = processorMs();
    result += work(places);
    const std::chrono::duration<double, std::milli> took = std::chrono::steady_clock::now() - begin;
    shortestProcessor = std::min(shortestProcessor, processorMs() - processor);
    shortestReal = std::min(shortestReal, took.count());
  }
  std::printf("%.3f %.3f\n", shortestReal, shortestProcessor);
  return result == 0.0 ? 1 : 0;
}
