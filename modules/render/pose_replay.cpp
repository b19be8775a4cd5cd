#include "render/pose_replay.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <vector>

#include "core/error.h"

namespace pneuma {
namespace {

constexpr double LongestWaitSeconds = 0.1;  ///< without asking whether to stop
constexpr double Rounding = 1e-6;           ///< of a tick, what sums of doubles are off by

/// The ticks of a replay, and which pose is due at each.
class Ticks {
 public:
  Ticks(std::span<const double> times, double rate) : times_(times), rate_(rate) {
    count_ =
        static_cast<std::size_t>(std::ceil((times.back() - times.front()) * rate - Rounding)) + 1;
  }

  std::size_t count() const { return count_; }

  double seconds(std::size_t tick) const { return static_cast<double>(tick) / rate_; }

  /// The newest tick at or before a time.
  std::size_t newestAt(double seconds) const {
    const double ticks = std::floor(std::max(0.0, seconds) * rate_ + Rounding);
    return ticks < static_cast<double>(count_) ? static_cast<std::size_t>(ticks) : count_ - 1;
  }

  /// The newest pose at or before a tick.
  std::size_t poseAt(std::size_t tick) const {
    const double until = times_.front() + (static_cast<double>(tick) + Rounding) / rate_;
    return static_cast<std::size_t>(std::ranges::upper_bound(times_, until) - times_.begin()) - 1;
  }

 private:
  std::span<const double> times_;
  double rate_;
  std::size_t count_ = 0;
};

PoseLatency summary(std::vector<double> seconds) {
  if (seconds.empty()) return {};
  std::ranges::sort(seconds);
  const std::size_t n = seconds.size();
  PoseLatency latency;
  latency.meanMs =
      1000.0 * std::accumulate(seconds.begin(), seconds.end(), 0.0) / static_cast<double>(n);
  latency.medianMs = 500.0 * (seconds[(n - 1) / 2] + seconds[n / 2]);
  latency.percentile95Ms = 1000.0 * seconds[(95 * n + 99) / 100 - 1];
  latency.maxMs = 1000.0 * seconds.back();
  return latency;
}

void waitFor(double seconds, ReplayClock& clock, const Progress& progress) {
  for (double now = clock.now(); now < seconds; now = clock.now()) {
    progress.throwIfStopped();
    clock.waitUntil(std::min(seconds, now + LongestWaitSeconds));
  }
}

}  // namespace

PoseReplay replayPoses(std::span<const double> times, double rate, ReplayClock& clock,
                       const std::function<void(const ReplayTick& tick)>& draw,
                       const Progress& progress) {
  if (!(rate > 0.0)) throw InvalidOption("poses are replayed at a rate above 0 a second");
  if (times.empty()) throw InvalidInput("there is no pose to replay");
  const Ticks ticks(times, rate);
  PoseReplay replay;
  replay.poses = times.size();
  replay.ticks = ticks.count();

  // The tick at which each pose is due comes before the next one's, or it is never due.
  std::vector<std::size_t> dueAt;
  std::vector<std::size_t> due;
  for (std::size_t tick = 0; tick < ticks.count(); ++tick) {
    const std::size_t pose = ticks.poseAt(tick);
    if (!due.empty() && due.back() == pose) continue;
    due.push_back(pose);
    dueAt.push_back(tick);
  }
  replay.betweenTicks = times.size() - due.size();

  std::vector<double> latencies;
  double firstFinished = 0.0;
  double finished = 0.0;
  std::size_t next = 0;   // the tick from which on none was drawn
  std::size_t place = 0;  // in `due`, of the first pose of which there is no newer picture
  while (next < ticks.count()) {
    waitFor(ticks.seconds(next), clock, progress);
    progress.report(static_cast<double>(next) / static_cast<double>(ticks.count()));
    const std::size_t tick = std::max(next, ticks.newestAt(clock.now()));
    const std::size_t pose = ticks.poseAt(tick);
    draw({pose, ticks.seconds(tick)});
    finished = clock.now();
    if (replay.pictures++ == 0) firstFinished = finished;
    for (; place < due.size() && due[place] < pose; ++place) ++replay.dropped;
    if (place < due.size() && due[place] == pose) {
      latencies.push_back(finished - ticks.seconds(dueAt[place]));
      ++replay.shown;
      ++place;
    }
    next = tick + 1;
  }
  if (replay.pictures > 1 && finished > firstFinished) {
    replay.rate = static_cast<double>(replay.pictures - 1) / (finished - firstFinished);
  }
  replay.latency = summary(std::move(latencies));
  return replay;
}

}  // namespace pneuma
