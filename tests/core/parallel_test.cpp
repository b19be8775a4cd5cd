#include "core/parallel.h"

#include <atomic>
#include <stdexcept>
#include <vector>

#include <gtest/gtest.h>

namespace pneuma {
namespace {

TEST(ParallelFor, CallsEveryIndexOnce) {
  std::vector<std::atomic<int>> calls(10000);
  parallelFor(calls.size(), [&](std::size_t i) { ++calls[i]; });
  for (const auto& count : calls) EXPECT_EQ(count, 1);
}

TEST(ParallelFor, DoesNothingForNothing) {
  parallelFor(0, [](std::size_t) { FAIL(); });
}

TEST(ParallelFor, PassesAnExceptionOn) {
  EXPECT_THROW(parallelFor(1000,
                           [](std::size_t i) {
                             if (i == 500) throw std::runtime_error("stop");
                           }),
               std::runtime_error);
}

int mostAtOnce() {
  std::atomic<int> running = 0;
  std::atomic<int> most = 0;
  parallelFor(2000, [&](std::size_t) {
    const int now = ++running;
    int before = most;
    while (now > before && !most.compare_exchange_weak(before, now)) {
    }
    --running;
  });
  return most;
}

TEST(ThreadLimit, HoldsWhileItLives) {
  const ThreadLimit one(1);
  EXPECT_EQ(mostAtOnce(), 1);
}

TEST(ThreadLimit, OfZeroIsNone) {
  const ThreadLimit none(0);
  EXPECT_GE(mostAtOnce(), 1);
}

}  // namespace
}  // namespace pneuma
