#include "render/pose_replay.h"

#include <algorithm>
#include <vector>

#include <gtest/gtest.h>

#include "core/error.h"

namespace pneuma {
namespace {

constexpr double TickSeconds = 0.015;

/// Time that passes only when somebody waits or draws.
class HandClock : public ReplayClock {
 public:
  double now() const override { return now_; }

  void waitUntil(double seconds) override { now_ = std::max(now_, seconds); }

  void pass(double seconds) { now_ += seconds; }

 private:
  double now_ = 0.0;
};

/// A pose for every 15 ms, from a time that is not 0.
std::vector<double> record(int poses, double every = TickSeconds) {
  std::vector<double> times;
  for (int n = 0; n < poses; ++n) times.push_back(1234.5 + every * n);
  return times;
}

struct Replayed {
  PoseReplay replay;
  std::vector<ReplayTick> drawn;
};

Replayed replayed(const std::vector<double>& times, double rate, double drawingSeconds) {
  Replayed result;
  HandClock clock;
  result.replay = replayPoses(times, rate, clock, [&](const ReplayTick& tick) {
    EXPECT_GE(clock.now(), tick.seconds - 1e-9) << "no picture is begun before its tick";
    result.drawn.push_back(tick);
    clock.pass(drawingSeconds);
  });
  return result;
}

std::vector<std::size_t> posesOf(const std::vector<ReplayTick>& ticks) {
  std::vector<std::size_t> poses;
  for (const ReplayTick& tick : ticks) poses.push_back(tick.pose);
  return poses;
}

TEST(PoseReplay, FastDrawingShowsEveryPoseAfterTheTimeOfDrawing) {
  const auto [replay, drawn] = replayed(record(200), PosesPerSecond, 0.010);
  EXPECT_EQ(replay.poses, 200U);
  EXPECT_EQ(replay.shown, 200U);
  EXPECT_EQ(replay.dropped, 0U);
  EXPECT_EQ(replay.betweenTicks, 0U);
  EXPECT_EQ(replay.ticks, 200U);
  EXPECT_EQ(replay.pictures, 200U);
  EXPECT_NEAR(replay.latency.meanMs, 10.0, 1e-6);
  EXPECT_NEAR(replay.latency.medianMs, 10.0, 1e-6);
  EXPECT_NEAR(replay.latency.percentile95Ms, 10.0, 1e-6);
  EXPECT_NEAR(replay.latency.maxMs, 10.0, 1e-6);
  EXPECT_NEAR(replay.rate, 1000.0 / 15.0, 1e-6);
}

// Every 60 ms three pictures of 20 ms are of three of the four poses: begun at 0, 20, 40 of what
// was due at 0, 15, 30, hence 20, 25, 30 ms after that.
TEST(PoseReplay, SlowDrawingDropsEveryFourthPose) {
  const auto [replay, drawn] = replayed(record(400), PosesPerSecond, 0.020);
  const std::vector<std::size_t> first = {0, 1, 2, 4, 5, 6, 8, 9, 10, 12};
  const std::vector<std::size_t> poses = posesOf(drawn);
  ASSERT_GE(poses.size(), first.size());
  EXPECT_EQ(std::vector<std::size_t>(poses.begin(), poses.begin() + 10), first);
  // The last pose, 399, is the fourth of its four, and drawn as nothing comes after it.
  EXPECT_EQ(replay.shown, 301U);
  EXPECT_EQ(replay.dropped, 99U);
  EXPECT_EQ(poses.back(), 399U);
  EXPECT_NEAR(replay.latency.meanMs, (300 * 25.0 + 35.0) / 301, 1e-6);
  EXPECT_NEAR(replay.latency.medianMs, 25.0, 1e-6);
  EXPECT_NEAR(replay.latency.percentile95Ms, 30.0, 1e-6);
  EXPECT_NEAR(replay.latency.maxMs, 35.0, 1e-6) << "the last one had to wait until 60";
  EXPECT_NEAR(replay.rate, 50.0, 1e-6);
}

TEST(PoseReplay, ASlowerRecordIsDrawnAtEveryTickButCountedOnce) {
  const auto [replay, drawn] = replayed(record(5, 0.060), PosesPerSecond, 0.001);
  EXPECT_EQ(replay.ticks, 17U);
  EXPECT_EQ(replay.pictures, 17U);
  EXPECT_EQ(replay.shown, 5U);
  EXPECT_EQ(replay.dropped, 0U);
  EXPECT_NEAR(replay.latency.maxMs, 1.0, 1e-6);
  EXPECT_EQ(drawn[3].pose, 0U);
  EXPECT_EQ(drawn[4].pose, 1U);
}

TEST(PoseReplay, AFasterRecordLeavesPosesBetweenTicksNotDropped) {
  const auto [replay, drawn] = replayed(record(301, 0.005), PosesPerSecond, 0.001);
  EXPECT_EQ(replay.ticks, 101U);
  EXPECT_EQ(replay.shown, 101U);
  EXPECT_EQ(replay.dropped, 0U);
  EXPECT_EQ(replay.betweenTicks, 200U);
  EXPECT_EQ(drawn[1].pose, 3U);
}

// A tick of 10 ms, poses at 0, 12 and 14: the second is never due, the third at 20.
TEST(PoseReplay, ThePoseOfATickIsTheNewestAtOrBeforeIt) {
  const auto [replay, drawn] = replayed({0.0, 0.012, 0.014}, 100.0, 0.004);
  EXPECT_EQ(posesOf(drawn), (std::vector<std::size_t>{0, 0, 2}));
  EXPECT_EQ(replay.betweenTicks, 1U);
  EXPECT_NEAR(replay.latency.maxMs, 4.0, 1e-6);
}

TEST(PoseReplay, OnePoseIsOnePicture) {
  const auto [replay, drawn] = replayed({7.0}, 66.7, 0.5);
  EXPECT_EQ(replay.pictures, 1U);
  EXPECT_EQ(replay.shown, 1U);
  EXPECT_NEAR(replay.latency.percentile95Ms, 500.0, 1e-6);
  EXPECT_EQ(replay.rate, 0.0);
}

TEST(PoseReplay, PercentilesAreOfTheRankThatHasThemBelow) {
  HandClock clock;
  double drawing = 0.0;
  const PoseReplay replay = replayPoses(record(20, 0.1), 10.0, clock, [&](const ReplayTick&) {
    drawing += 0.001;  // 1 ... 20 ms
    clock.pass(drawing);
  });
  EXPECT_NEAR(replay.latency.meanMs, 10.5, 1e-6);
  EXPECT_NEAR(replay.latency.medianMs, 10.5, 1e-6);
  EXPECT_NEAR(replay.latency.percentile95Ms, 19.0, 1e-6);
  EXPECT_NEAR(replay.latency.maxMs, 20.0, 1e-6);
}

TEST(PoseReplay, RefusesNoPosesAndNoRate) {
  HandClock clock;
  const auto nothing = [](const ReplayTick&) {};
  EXPECT_THROW(replayPoses({}, 66.7, clock, nothing), InvalidInput);
  EXPECT_THROW(replayPoses(record(2), 0.0, clock, nothing), InvalidOption);
}

TEST(PoseReplay, StopsWhileItWaits) {
  class Stopping : public ProgressSink {
   public:
    void report(double, std::string_view) override {}

    bool stopRequested() const override { return asked++ > 5; }

    mutable int asked = 0;
  } sink;

  HandClock clock;
  EXPECT_THROW(replayPoses(
                   record(2, 1000.0), 0.001, clock, [](const ReplayTick&) {}, Progress(sink)),
               Cancelled);
  EXPECT_LT(clock.now(), 1.0);
}

}  // namespace
}  // namespace pneuma
