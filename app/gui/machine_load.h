#pragma once

#include <ctime>

/// How busy the machine is, so that limits in seconds hold on shared ones too.
namespace pneuma {

/// Wall time over processor time of a short piece of work: 1 on a quiet machine, more where other
/// programs take the processor away.
inline double machineLoad() {
  const auto seconds = [](clockid_t clock) {
    timespec now{};
    clock_gettime(clock, &now);
    return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
  };
  constexpr double WorkSeconds = 0.2;
  const double wall = seconds(CLOCK_MONOTONIC);
  const double processor = seconds(CLOCK_THREAD_CPUTIME_ID);
  while (seconds(CLOCK_THREAD_CPUTIME_ID) - processor < WorkSeconds) {
  }
  const double load = (seconds(CLOCK_MONOTONIC) - wall) / WorkSeconds;
  return load < 1.0 ? 1.0 : load;
}

}  // namespace pneuma
