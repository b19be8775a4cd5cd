#pragma once

#include <algorithm>
#include <cstdint>
#include <ctime>
#include <mutex>
#include <vector>

#include "core/progress.h"

namespace pneuma::testing {

/// Processor time so far, all threads.
inline double processorSeconds() {
  timespec time{};
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &time);
  return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
}

/// How many times longer than on a quiet core of 2025 a fixed piece of work takes here and now, no
/// less than 1: neighbours on the machine take memory and half of a core from us.
inline double slowness() {
  constexpr double QuietSeconds = 0.015;
  std::vector<std::uint16_t> voxels(std::size_t{1} << 24, 1);
  const double start = processorSeconds();
  for (std::size_t i = 4096; i < voxels.size(); ++i) {
    voxels[i] = static_cast<std::uint16_t>(voxels[i - 1] + 3 * voxels[i - 512] + voxels[i - 4096]);
  }
  const volatile std::uint16_t used = voxels.back();
  static_cast<void>(used);
  return std::max(1.0, (processorSeconds() - start) / QuietSeconds);
}

/// Measures the longest time in which work does not look whether it should stop, as it would be on
/// a quiet machine: processor time of all threads by the machine's slowness before and after.
class StopWatchSink : public ProgressSink {
 public:
  void report(double, std::string_view) override { look(); }

  bool stopRequested() const override {
    look();
    return false;
  }

  double longestSeconds() const { return longest_ / std::max(slownessBefore_, slowness()); }

 private:
  void look() const {
    const std::lock_guard lock(mutex_);
    const double time = processorSeconds();
    longest_ = std::max(longest_, time - last_);
    last_ = time;
  }

  mutable std::mutex mutex_;
  double slownessBefore_ = slowness();
  mutable double last_ = processorSeconds();
  mutable double longest_ = 0.0;
};

}  // namespace pneuma::testing
