#pragma once

#include <algorithm>
#include <ctime>
#include <thread>
#include <vector>

/// How busy the machine is, so that limits in seconds hold on shared ones too.
namespace pneuma {

/// Wall time over processor time of a short piece of work on every core: 1 on a quiet machine, more
/// where other programs take cores away. Growing and drawing without a graphics card use them all.
inline double machineLoad() {
  const auto seconds = [](clockid_t clock) {
    timespec now{};
    clock_gettime(clock, &now);
    return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
  };
  constexpr double WorkSeconds = 0.2;
  const auto work = [&] {
    const double begin = seconds(CLOCK_THREAD_CPUTIME_ID);
    while (seconds(CLOCK_THREAD_CPUTIME_ID) - begin < WorkSeconds) {
    }
  };
  const double wall = seconds(CLOCK_MONOTONIC);
  {
    std::vector<std::jthread> others(std::max(std::thread::hardware_concurrency(), 1U) - 1);
    for (std::jthread& other : others) other = std::jthread(work);
    work();
  }
  return std::max((seconds(CLOCK_MONOTONIC) - wall) / WorkSeconds, 1.0);
}

}  // namespace pneuma
