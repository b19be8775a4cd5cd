#pragma once

#include <algorithm>
#include <ctime>
#include <mutex>

#include "core/progress.h"

namespace pneuma::testing {

/// Measures the longest time in which work does not look whether it should stop. Processor time
/// of all threads, so that neighbours on the machine do not count: no less than the time on the
/// wall would be on a quiet machine.
class StopWatchSink : public ProgressSink {
 public:
  void report(double, std::string_view) override { look(); }

  bool stopRequested() const override {
    look();
    return false;
  }

  double longestSeconds() const { return longest_; }

 private:
  static double now() {
    timespec time{};
    clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &time);
    return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
  }

  void look() const {
    const std::lock_guard lock(mutex_);
    const double time = now();
    longest_ = std::max(longest_, time - last_);
    last_ = time;
  }

  mutable std::mutex mutex_;
  mutable double last_ = now();
  mutable double longest_ = 0.0;
};

}  // namespace pneuma::testing
