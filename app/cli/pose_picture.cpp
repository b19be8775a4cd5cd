#include "cli/pose_picture.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <thread>
#include <utility>

#include "cli/text.h"
#include "pipeline/report.h"

namespace pneuma::cli {
namespace {

/// The time on the wall from when it was made, but for what is done while it stands.
class WallClock : public ReplayClock {
 public:
  double now() const override { return Seconds(Clock::now() - start_).count(); }

  void waitUntil(double seconds) override {
    std::this_thread::sleep_until(start_ + std::chrono::ceil<Clock::duration>(Seconds(seconds)));
  }

  void standFor(const std::function<void()>& work) {
    const Clock::time_point begun = Clock::now();
    work();
    start_ += Clock::now() - begun;
  }

 private:
  using Clock = std::chrono::steady_clock;
  using Seconds = std::chrono::duration<double>;

  Clock::time_point start_ = Clock::now();
};

constexpr const char* ReplayBasis =
    "Pictures were drawn offscreen on this machine and timed until they were in memory; no headset "
    "was driven, and its display and tracker would add to the latency.";

}  // namespace

ReplayFilm::ReplayFilm(double rate)
    : rate_(static_cast<int>(std::lround(std::clamp(rate, 1.0, 120.0)))), movie_(rate_) {}

void ReplayFilm::add(Picture picture, double finished) {
  const bool first = shown_.rgb.empty();
  for (; static_cast<double>(pictures_) / rate_ < finished; ++pictures_) {
    movie_.add(first ? picture : shown_);
  }
  shown_ = std::move(picture);
}

std::string ReplayFilm::finish() {
  if (!shown_.rgb.empty()) {
    movie_.add(shown_);
    ++pictures_;
  }
  return movie_.finish();
}

ReplayedHead replayHead(HeadView& view, const std::vector<HeadPose>& poses, double rate,
                        const std::function<void(double seconds)>& showAt, ReplayFilm* film,
                        const Progress& progress) {
  std::vector<double> times;
  times.reserve(poses.size());
  for (const HeadPose& pose : poses) times.push_back(pose.seconds);
  const auto seenFrom = [&](const HeadPose& pose, double seconds) {
    showAt(seconds);
    return view.from(pose.position, pose.orientation);
  };
  (void)seenFrom(poses.front(), 0.0);
  ReplayedHead head;
  WallClock clock;
  const auto draw = [&](const ReplayTick& tick) {
    head.last = seenFrom(poses[tick.pose], tick.seconds);
    if (film == nullptr) return;
    const double finished = clock.now();
    clock.standFor([&] { film->add(head.last, finished); });
  };
  head.replay = replayPoses(times, rate, clock, draw, progress);
  return head;
}

Json replayReport(const PoseReplay& replay, double rate, const std::vector<InputFile>& inputs,
                  Json parameters) {
  Json report = reportEnvelope("pneuma/replay/1", inputs, std::move(parameters), 0);
  if (replay.dropped > 0) {
    report["warnings"].push_back(grouped(static_cast<double>(replay.dropped)) + " of " +
                                 grouped(static_cast<double>(replay.poses)) +
                                 " poses were dropped, as drawing takes longer than from tick to "
                                 "tick; give a smaller --size or a lower --rate");
  }
  report["poses"] = replay.poses;
  report["shown"] = replay.shown;
  report["dropped"] = replay.dropped;
  report["between_ticks"] = replay.betweenTicks;
  report["ticks"] = replay.ticks;
  report["pictures"] = replay.pictures;
  report["latency_ms"] = {{"mean", replay.latency.meanMs},
                          {"median", replay.latency.medianMs},
                          {"percentile_95", replay.latency.percentile95Ms},
                          {"max", replay.latency.maxMs}};
  report["rate_hz"] = {{"wanted", rate}, {"reached", replay.rate}};
  report["headset"] = false;
  report["basis"] = ReplayBasis;
  report["peak_memory_mb"] = peakMemoryMb();
  return report;
}

std::string replayText(const Json& report) {
  const auto count = [&](const char* key) { return grouped(report.at(key).get<double>()); };
  const auto number = [&](const char* group, const char* key) {
    return fixed(report.at(group).at(key).get<double>(), 1);
  };
  std::string text = count("poses") + " poses: " + count("shown") + " shown, " + count("dropped") +
                     " dropped, " + count("between_ticks") + " between ticks\n";
  text += "latency " + number("latency_ms", "mean") + " ms on average, median " +
          number("latency_ms", "median") + ", 95 % within " +
          number("latency_ms", "percentile_95") + ", longest " + number("latency_ms", "max") + "\n";
  text += count("pictures") + " pictures, " + number("rate_hz", "reached") + " a second of " +
          number("rate_hz", "wanted") + " wanted\n";
  return text + report.at("basis").get<std::string>() + "\n";
}

}  // namespace pneuma::cli
