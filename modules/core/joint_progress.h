#pragma once

#include <cstddef>
#include <deque>
#include <mutex>

#include "core/progress.h"

namespace pneuma {

/// The progress of tasks that run at the same time: the mean of theirs. A wish to stop reaches all,
/// and what any of them has placed is passed on.
class JointProgress {
 public:
  JointProgress(const Progress& whole, std::size_t tasks);
  JointProgress(const JointProgress&) = delete;
  JointProgress& operator=(const JointProgress&) = delete;

  /// Of task `i`; may be used while this object lives.
  Progress task(std::size_t i) { return Progress(tasks_[i]); }

 private:
  class Task : public ProgressSink {
   public:
    explicit Task(JointProgress& joint) : joint_(joint) {}

    void report(double fraction, std::string_view what) override;

    bool stopRequested() const override { return joint_.whole_.stopRequested(); }

    void placed(std::span<const Vec3> points) override { joint_.whole_.placed(points); }

    bool wantsPoints() const override { return joint_.whole_.wantsPoints(); }

   private:
    JointProgress& joint_;
    double fraction_ = 0.0;
  };

  Progress whole_;
  std::mutex mutex_;
  double sum_ = 0.0;  ///< of the fractions of all tasks
  std::deque<Task> tasks_;
};

}  // namespace pneuma
