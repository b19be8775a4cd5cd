#include "document/job_queue.h"

#include <QElapsedTimer>
#include <QSignalSpy>
#include <QTest>
#include <algorithm>
#include <atomic>
#include <chrono>
#include <new>
#include <set>
#include <thread>
#include <vector>

#include <gtest/gtest.h>

#include "machine_load.h"

namespace pneuma {
namespace {

bool waitUntilIdle(const JobQueue& queue) {
  return QTest::qWaitFor([&] { return !queue.busy(); }, 60000);
}

/// Works until it is asked to stop.
JobQueue::Continuation endless(const Progress& progress) {
  for (;;) {
    progress.report(0.5);
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }
}

TEST(JobQueue, RunsTheContinuationOnItsOwnThread) {
  JobQueue queue;
  const auto here = std::this_thread::get_id();
  std::thread::id computed;
  std::thread::id continued;
  queue.push("work", [&](const Progress&) {
    computed = std::this_thread::get_id();
    return JobQueue::Continuation([&] { continued = std::this_thread::get_id(); });
  });
  EXPECT_TRUE(queue.busy());
  ASSERT_TRUE(waitUntilIdle(queue));
  EXPECT_EQ(continued, here);
  EXPECT_NE(computed, here);
}

TEST(JobQueue, SaysWhatAContinuationThrew) {
  JobQueue queue;
  const QSignalSpy failed(&queue, &JobQueue::failed);
  const QSignalSpy finished(&queue, &JobQueue::finished);
  queue.push("work", [](const Progress&) {
    return JobQueue::Continuation([] { throw std::bad_alloc(); });
  });
  ASSERT_TRUE(waitUntilIdle(queue));
  ASSERT_EQ(failed.size(), 1);
  EXPECT_TRUE(failed.at(0).at(1).toString().contains("not enough memory"));
  EXPECT_EQ(finished.size(), 0);
}

TEST(JobQueue, RunsJobsInTheOrderTheyWerePushed) {
  JobQueue queue;
  std::vector<int> order;
  for (int i = 0; i < 20; ++i) {
    queue.push("work", [&order, i](const Progress&) {
      return JobQueue::Continuation([&order, i] { order.push_back(i); });
    });
  }
  ASSERT_TRUE(waitUntilIdle(queue));
  ASSERT_EQ(order.size(), 20U);
  EXPECT_TRUE(std::is_sorted(order.begin(), order.end()));
}

TEST(JobQueue, TellsBusyAndIdleOnceForSeveralJobs) {
  JobQueue queue;
  QSignalSpy busy(&queue, &JobQueue::busyChanged);
  for (int i = 0; i < 3; ++i) {
    queue.push("work", [](const Progress&) { return JobQueue::Continuation(); });
  }
  ASSERT_TRUE(waitUntilIdle(queue));
  ASSERT_EQ(busy.count(), 2);
  EXPECT_TRUE(busy.at(0).at(0).toBool());
  EXPECT_FALSE(busy.at(1).at(0).toBool());
}

TEST(JobQueue, ReportsProgressWithTheNameOfTheStep) {
  JobQueue queue;
  QSignalSpy progressed(&queue, &JobQueue::progressed);
  std::atomic<bool> go = false;
  queue.push("Growing", [&](const Progress& progress) {
    progress.part(0.0, 1.0, "splitting").report(0.25);
    while (!go) std::this_thread::sleep_for(std::chrono::milliseconds(1));
    return JobQueue::Continuation();
  });
  ASSERT_TRUE(QTest::qWaitFor(
      [&] { return progressed.count() > 0 && progressed.last().at(1).toDouble() == 0.25; }));
  EXPECT_EQ(progressed.last().at(0).toString(), "Growing");
  EXPECT_EQ(progressed.last().at(2).toString(), "splitting");
  go = true;
  ASSERT_TRUE(waitUntilIdle(queue));
}

TEST(JobQueue, CancelStopsTheRunningJobAndForgetsThoseThatWait) {
  JobQueue queue;
  QSignalSpy cancelled(&queue, &JobQueue::cancelled);
  bool ran = false;
  queue.push("first", endless);
  queue.push("second", [&](const Progress&) {
    ran = true;
    return JobQueue::Continuation();
  });
  QTest::qWait(50);
  QElapsedTimer clock;
  clock.start();
  queue.cancel();
  ASSERT_TRUE(waitUntilIdle(queue));
  const auto elapsedMs = static_cast<double>(clock.elapsed());  // before the load is measured
  EXPECT_LT(elapsedMs, 500.0 * machineLoad());
  EXPECT_EQ(cancelled.count(), 2);
  EXPECT_FALSE(ran);
}

TEST(JobQueue, ACancelAfterTheWorkIsDoneStillWins) {
  JobQueue queue;
  std::atomic<bool> computed = false;
  bool delivered = false;
  queue.push("work", [&](const Progress&) {
    computed = true;
    return JobQueue::Continuation([&] { delivered = true; });
  });
  // No event is processed here, so the result lies ready and undelivered.
  while (!computed) std::this_thread::sleep_for(std::chrono::milliseconds(1));
  std::this_thread::sleep_for(std::chrono::milliseconds(50));
  queue.cancel();
  ASSERT_TRUE(waitUntilIdle(queue));
  EXPECT_FALSE(delivered);
}

TEST(JobQueue, KnowsWhichKindsOfJobsItHas) {
  JobQueue queue;
  std::atomic<bool> go = false;
  bool stillThere = true;
  const auto untilGo = [&](const Progress&) {
    while (!go) std::this_thread::sleep_for(std::chrono::milliseconds(1));
    return JobQueue::Continuation([&] { stillThere = queue.has(JobKind::Growing); });
  };
  queue.push(JobKind::Growing, "Growing", untilGo);
  queue.push(JobKind::DrawingSeries, "Drawing", untilGo);
  queue.push(JobKind::DrawingSeries, "Drawing", endless);
  EXPECT_TRUE(queue.has(JobKind::Growing));
  EXPECT_FALSE(queue.has(JobKind::Breathing));
  go = true;
  ASSERT_TRUE(QTest::qWaitFor([&] { return !stillThere; }, 10000));
  EXPECT_TRUE(queue.has(JobKind::DrawingSeries)) << "one of two may be over";
  queue.cancel();
  EXPECT_TRUE(queue.has(JobKind::DrawingSeries)) << "it takes a moment to stop";
  ASSERT_TRUE(waitUntilIdle(queue));
  EXPECT_FALSE(queue.has(JobKind::DrawingSeries));
  queue.push(JobKind::Exporting, "Exporting",
             [](const Progress&) -> JobQueue::Continuation { throw std::bad_alloc(); });
  ASSERT_TRUE(waitUntilIdle(queue));
  EXPECT_FALSE(queue.has(JobKind::Exporting));
}

TEST(JobQueue, NothingIsToldOfWhatIsSuperseded) {
  JobQueue queue;
  const QSignalSpy cancelled(&queue, &JobQueue::cancelled);
  const QSignalSpy finished(&queue, &JobQueue::finished);
  const auto nothing = [](const Progress&) { return JobQueue::Continuation(); };
  queue.push(JobKind::Splitting, "first", endless);
  queue.push(JobKind::Splitting, "second", nothing);
  queue.supersede({JobKind::Splitting, JobKind::Breathing});
  EXPECT_FALSE(queue.has(JobKind::Splitting));
  EXPECT_FALSE(queue.hasOthersThan({}));
  EXPECT_TRUE(queue.busy());
  queue.push(JobKind::Splitting, "third", nothing);
  EXPECT_TRUE(queue.has(JobKind::Splitting));
  ASSERT_TRUE(waitUntilIdle(queue));
  EXPECT_FALSE(queue.has(JobKind::Splitting));
  EXPECT_EQ(cancelled.count(), 0);
  ASSERT_EQ(finished.count(), 1);
  EXPECT_EQ(finished.front().at(0).toString(), "third");
}

TEST(JobQueue, OthersGoOnWhereAKindIsSuperseded) {
  JobQueue queue;
  const QSignalSpy cancelled(&queue, &JobQueue::cancelled);
  std::atomic<bool> computed = false;
  int delivered = 0;
  const auto deliver = [&] {
    ++delivered;
    queue.supersede({JobKind::DrawingSeries});  // whose result lies ready, too
  };
  queue.push("Saving", [&](const Progress&) { return JobQueue::Continuation(deliver); });
  queue.push(JobKind::DrawingSeries, "Drawing", [&](const Progress&) {
    computed = true;
    return JobQueue::Continuation([&] { delivered += 100; });
  });
  while (!computed) std::this_thread::sleep_for(std::chrono::milliseconds(1));
  std::this_thread::sleep_for(std::chrono::milliseconds(50));
  queue.push(JobKind::FollowingLungs, "Following", endless);
  queue.push("Saving", [&](const Progress&) { return JobQueue::Continuation(deliver); });
  EXPECT_TRUE(queue.hasOthersThan({JobKind::FollowingLungs, JobKind::DrawingSeries}));
  EXPECT_FALSE(
      queue.hasOthersThan({JobKind::Other, JobKind::FollowingLungs, JobKind::DrawingSeries}));
  queue.supersede({JobKind::FollowingLungs});
  ASSERT_TRUE(waitUntilIdle(queue));
  EXPECT_EQ(delivered, 2);
  EXPECT_EQ(cancelled.count(), 0);
}

TEST(JobQueue, WorksAgainAfterACancel) {
  JobQueue queue;
  queue.push("first", endless);
  queue.cancel();
  bool delivered = false;
  queue.push("second",
             [&](const Progress&) { return JobQueue::Continuation([&] { delivered = true; }); });
  ASSERT_TRUE(waitUntilIdle(queue));
  EXPECT_TRUE(delivered);
}

TEST(JobQueue, AnErrorBecomesItsSentence) {
  JobQueue queue;
  QSignalSpy failed(&queue, &JobQueue::failed);
  queue.push("Opening", [](const Progress&) -> JobQueue::Continuation {
    throw InvalidInput("the surface has 14 open edges; repair it first");
  });
  queue.push("Growing", [](const Progress&) -> JobQueue::Continuation { throw std::bad_alloc(); });
  ASSERT_TRUE(waitUntilIdle(queue));
  ASSERT_EQ(failed.count(), 2);
  EXPECT_EQ(failed.at(0).at(0).toString(), "Opening");
  EXPECT_EQ(failed.at(0).at(1).toString(), "the surface has 14 open edges; repair it first");
  EXPECT_TRUE(failed.at(1).at(1).toString().contains("memory"));
}

void waitFor(const std::atomic<bool>& go, const Progress& progress) {
  while (!go) {
    progress.throwIfStopped();
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }
}

/// Keeps what a queue tells of placed points.
struct PointsTold {
  explicit PointsTold(JobQueue& queue) {
    QObject::connect(&queue, &JobQueue::placed, &queue, [this](const std::vector<Vec3>& now) {
      points.insert(points.end(), now.begin(), now.end());
      threads.insert(std::this_thread::get_id());
      ++times;
    });
  }

  std::vector<Vec3> points;
  std::set<std::thread::id> threads;
  int times = 0;
};

/// Points first, first + 1 ... on the x axis.
std::vector<Vec3> row(std::size_t first, std::size_t count) {
  std::vector<Vec3> points;
  for (std::size_t i = first; i < first + count; ++i) {
    points.emplace_back(static_cast<double>(i), 0.0, 0.0);
  }
  return points;
}

TEST(JobQueue, TellsPlacedPointsInTheirOrderOnItsOwnThread) {
  std::atomic<bool> go = false;
  JobQueue queue;
  const PointsTold told(queue);
  queue.push("Growing", [&](const Progress& progress) {
    EXPECT_TRUE(progress.wantsPoints());
    for (std::size_t i = 0; i < 300; i += 3) {
      progress.placed(row(i, 3));
      std::this_thread::sleep_for(std::chrono::milliseconds(2));
    }
    waitFor(go, progress);
    return JobQueue::Continuation();
  });
  ASSERT_TRUE(QTest::qWaitFor([&] { return told.points.size() == 300; }, 10000));
  go = true;
  ASSERT_TRUE(waitUntilIdle(queue));
  EXPECT_EQ(told.points, row(0, 300));
  EXPECT_EQ(told.threads, std::set{std::this_thread::get_id()});
}

TEST(JobQueue, TellsPlacedPointsTenTimesASecondAtMost) {
  JobQueue queue;
  const PointsTold told(queue);
  QElapsedTimer clock;
  clock.start();
  queue.push("Growing", [](const Progress& progress) {
    for (std::size_t i = 0; i < 500; ++i) {
      progress.placed(row(i, 1));
      std::this_thread::sleep_for(std::chrono::milliseconds(1));
    }
    return JobQueue::Continuation();
  });
  ASSERT_TRUE(waitUntilIdle(queue));
  EXPECT_GE(told.times, 2);
  EXPECT_LE(told.times, 1 + clock.elapsed() / 100);
}

TEST(JobQueue, TellsNoPointsAfterACancel) {
  std::atomic<bool> go = false;
  JobQueue queue;
  const PointsTold told(queue);
  queue.push("Growing", [&](const Progress& progress) {
    for (std::size_t i = 0; !go && i < 5000; ++i) {
      progress.placed(row(i, 1));
      std::this_thread::sleep_for(std::chrono::milliseconds(1));
    }
    return JobQueue::Continuation();
  });
  ASSERT_TRUE(QTest::qWaitFor([&] { return told.times >= 2; }, 10000));
  queue.cancel();
  const std::size_t before = told.points.size();
  QTest::qWait(250);
  EXPECT_TRUE(queue.busy());  // it does not look whether it is to stop
  go = true;
  ASSERT_TRUE(waitUntilIdle(queue));
  EXPECT_EQ(told.points.size(), before);
}

TEST(JobQueue, KeepsNoMorePointsWaitingThanItSays) {
  std::atomic<bool> placed = false;
  std::atomic<bool> more = false;
  std::atomic<bool> go = false;
  JobQueue queue;
  const PointsTold told(queue);
  constexpr std::size_t Most = JobQueue::MostPointsWaiting;
  queue.push("Growing", [&](const Progress& progress) {
    progress.placed(row(0, Most - 1));
    progress.placed(row(Most - 1, 3));
    progress.placed(row(Most + 2, 1));
    placed = true;
    waitFor(more, progress);
    progress.placed(row(Most + 3, 1));
    waitFor(go, progress);
    return JobQueue::Continuation();
  });
  // No event is processed here, so all of them wait.
  while (!placed) std::this_thread::sleep_for(std::chrono::milliseconds(1));
  ASSERT_TRUE(QTest::qWaitFor([&] { return told.times == 1; }, 10000));
  ASSERT_EQ(told.points.size(), Most);
  EXPECT_EQ(told.points.back().x(), static_cast<double>(Most - 1));
  more = true;
  ASSERT_TRUE(QTest::qWaitFor([&] { return told.times == 2; }, 10000));
  EXPECT_EQ(told.points.back().x(), static_cast<double>(Most + 3));
  go = true;
  ASSERT_TRUE(waitUntilIdle(queue));
}

TEST(JobQueue, GoesAwayWhileAJobRuns) {
  QElapsedTimer clock;
  clock.start();
  {
    JobQueue queue;
    queue.push("work", endless);
    QTest::qWait(40);
  }
  const auto elapsedMs = static_cast<double>(clock.elapsed());  // before the load is measured
  EXPECT_LT(elapsedMs, 1000.0 * machineLoad());
}

}  // namespace
}  // namespace pneuma
