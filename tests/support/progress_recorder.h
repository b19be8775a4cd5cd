#pragma once

#include <atomic>
#include <mutex>
#include <span>
#include <vector>

#include "core/progress.h"

namespace pneuma::testing {

/// Keeps what is reported and placed, and asks to stop from a given fraction on.
class ProgressRecorder : public ProgressSink {
 public:
  explicit ProgressRecorder(double stopAt = 2.0) : stopAt_(stopAt) {}

  void report(double fraction, std::string_view) override {
    const std::lock_guard lock(mutex_);
    fractions_.push_back(fraction);
    if (fraction >= stopAt_) stopped_ = true;
  }

  bool stopRequested() const override { return stopped_ || stopAt_ <= 0.0; }

  void placed(std::span<const Vec3> points) override {
    const std::lock_guard lock(mutex_);
    points_.insert(points_.end(), points.begin(), points.end());
  }

  bool wantsPoints() const override { return true; }

  const std::vector<double>& fractions() const { return fractions_; }

  const std::vector<Vec3>& points() const { return points_; }

 private:
  double stopAt_;
  std::atomic<bool> stopped_ = false;
  std::mutex mutex_;
  std::vector<double> fractions_;
  std::vector<Vec3> points_;
};

}  // namespace pneuma::testing
