#pragma once

#include <cstddef>
#include <functional>
#include <span>

#include "core/progress.h"

namespace pneuma {

/// Time as a replay sees it, from 0 where it starts, s. Tests let it run as they like.
class ReplayClock {
 public:
  ReplayClock() = default;
  virtual ~ReplayClock() = default;
  ReplayClock(const ReplayClock&) = delete;
  ReplayClock& operator=(const ReplayClock&) = delete;

  virtual double now() const = 0;

  /// Returns no earlier than at that time.
  virtual void waitUntil(double seconds) = 0;
};

/// From a moment at which poses are due to the picture's being finished, ms.
struct PoseLatency {
  double meanMs = 0.0;
  double medianMs = 0.0;
  double percentile95Ms = 0.0;  ///< of 95 % it is as long or shorter
  double maxMs = 0.0;
};

/// What came of recorded poses that were replayed.
/// poses = shown + dropped + betweenTicks
struct PoseReplay {
  std::size_t poses = 0;
  std::size_t shown = 0;         ///< in a picture or more
  std::size_t dropped = 0;       ///< due at a tick, but a picture was still being drawn
  std::size_t betweenTicks = 0;  ///< never due, as a newer one came before the next tick
  std::size_t ticks = 0;
  std::size_t pictures = 0;
  PoseLatency latency;  ///< of each pose shown, to its first picture
  double rate = 0.0;    ///< pictures a second, from the first to the last; 0 if there is one alone
};

/// What is to be drawn.
struct ReplayTick {
  std::size_t pose = 0;
  double seconds = 0.0;  ///< since the replay's start
};

/// A tick every 15 ms, as 66.7 Hz is meant.
inline constexpr double PosesPerSecond = 1000.0 / 15.0;

/// Replays poses in real time. There is a tick every 1/rate seconds, from the first pose's time to
/// the first tick at or after the last's; at a tick the newest pose at or before it is due. Poses
/// are not interpolated, so that every picture is of a pose that was recorded. A picture is begun
/// at a tick or, if one is still being drawn then, as soon as that is finished, for the newest tick
/// by then: ticks in between are missed, and poses due only there are dropped. The last tick is
/// always drawn.
/// @param times of the poses, rising, s; at least one
/// @param rate ticks a second, above 0
/// @param draw returns when its picture is finished
/// @throws InvalidOption for another rate; InvalidInput without poses; Cancelled; what draw throws
PoseReplay replayPoses(std::span<const double> times, double rate, ReplayClock& clock,
                       const std::function<void(const ReplayTick& tick)>& draw,
                       const Progress& progress = {});

}  // namespace pneuma
