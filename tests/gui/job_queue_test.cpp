#include "document/job_queue.h"

#include <QElapsedTimer>
#include <QSignalSpy>
#include <QTest>
#include <algorithm>
#include <atomic>
#include <chrono>
#include <new>
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
  EXPECT_LT(static_cast<double>(clock.elapsed()), 500.0 * testing::machineLoad());
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

TEST(JobQueue, GoesAwayWhileAJobRuns) {
  QElapsedTimer clock;
  clock.start();
  {
    JobQueue queue;
    queue.push("work", endless);
    QTest::qWait(40);
  }
  EXPECT_LT(static_cast<double>(clock.elapsed()), 1000.0 * testing::machineLoad());
}

}  // namespace
}  // namespace pneuma
