#pragma once

#include <algorithm>
#include <span>
#include <string_view>

#include "core/error.h"
#include "core/math.h"

namespace pneuma {

/// Where progress is shown and where a wish to stop comes from: a terminal, a window, a test.
/// Its functions may be called from any thread.
class ProgressSink {
 public:
  virtual ~ProgressSink() = default;

  /// `fraction` of the whole job in [0, 1]; `what` is the step's name for people.
  virtual void report(double fraction, std::string_view what) = 0;

  virtual bool stopRequested() const = 0;

  /// Points that the work has placed since it last told, LPS, mm, for those who show growth as it
  /// happens. They are the caller's again afterwards.
  virtual void placed(std::span<const Vec3> /*points*/) {}

  /// False if placed() does nothing: then nobody needs to be told.
  virtual bool wantsPoints() const { return false; }
};

/// Report and stop in one value, always the last parameter of long work.
/// Default-constructed it is silent and never stops. Cheap to copy.
class Progress {
 public:
  Progress() = default;

  explicit Progress(ProgressSink& sink) : sink_(&sink) {}

  /// Says how far this piece of work is, in [0, 1]. @throws Cancelled if the user wants to stop
  void report(double fraction) const {
    if (sink_ == nullptr) return;
    throwIfStopped();
    sink_->report(low_ + (high_ - low_) * std::clamp(fraction, 0.0, 1.0), what_);
  }

  bool stopRequested() const { return sink_ != nullptr && sink_->stopRequested(); }

  /// @throws Cancelled if the user wants to stop
  void throwIfStopped() const {
    if (stopRequested()) throw Cancelled();
  }

  /// Tells points that were placed since it was last told, LPS, mm. Never throws Cancelled.
  void placed(std::span<const Vec3> points) const {
    if (wantsPoints()) sink_->placed(points);
  }

  /// True if somebody shows them; collect none otherwise. Does not change while the work runs.
  bool wantsPoints() const { return sink_ != nullptr && sink_->wantsPoints(); }

  /// The part [from, to] of this piece of work, to be handed to a sub-step called `what`.
  /// `what` must outlive the part (a string literal does).
  Progress part(double from, double to, std::string_view what) const {
    Progress sub = *this;
    sub.low_ = low_ + (high_ - low_) * from;
    sub.high_ = low_ + (high_ - low_) * to;
    sub.what_ = what;
    return sub;
  }

 private:
  ProgressSink* sink_ = nullptr;
  double low_ = 0.0;
  double high_ = 1.0;
  std::string_view what_;
};

}  // namespace pneuma
