#include <QElapsedTimer>
#include <QImage>
#include <algorithm>
#include <atomic>
#include <chrono>
#include <thread>
#include <vector>

#include <gtest/gtest.h>

#include "core/error.h"
#include "core/random.h"
#include "machine_load.h"
#include "window_fixture.h"

namespace pneuma {
namespace {

/// A window with a small grown tree, in which a job shows what it places.
class PreviewTest : public testing::WindowTest {
 protected:
  void SetUp() override {
    WindowTest::SetUp();
    openChestFromFiles();
    grow(300);
    const TriangleMesh& lobe = *window.document().model().surfaces->front().mesh;
    box = bounds(lobe);
  }

  void TearDown() override {
    go = true;
    EXPECT_TRUE(idle());
  }

  /// Places `count` points, a thousand at a time and as fast as it can, and then waits for `go`.
  void startPlacing(std::size_t count) {
    window.document().jobs().push("Growing airways", [this, count](const Progress& progress) {
      Random random(1);
      std::vector<Vec3> points;
      for (std::size_t placed = 0; placed < count; placed += points.size()) {
        points.clear();
        while (points.size() < std::min<std::size_t>(1000, count - placed)) {
          const Vec3 unit(random.uniform(0, 1), random.uniform(0, 1), random.uniform(0, 1));
          points.emplace_back(box.min() + box.sizes().cwiseProduct(unit));
        }
        progress.placed(points);
        progress.report(static_cast<double>(placed) / static_cast<double>(count));
      }
      while (!go) {
        progress.throwIfStopped();
        std::this_thread::sleep_for(std::chrono::milliseconds(1));
      }
      if (fails) throw InvalidInput("nothing can grow here");
      return JobQueue::Continuation();
    });
  }

  bool previewed(std::size_t count) {
    return QTest::qWaitFor([&] { return window.view().previewed() == count; }, 30000);
  }

  Box3 box;
  std::atomic<bool> go = false;
  std::atomic<bool> fails = false;
};

TEST_F(PreviewTest, ShowsWhatAJobPlacesUntilItIsFinished) {
  const QImage before = window.view().picture();
  const QPoint corner = window.view().positionOf(box.min());
  startPlacing(3000);
  ASSERT_TRUE(previewed(3000));
  EXPECT_NE(window.view().picture(), before);
  EXPECT_EQ(window.view().positionOf(box.min()), corner);
  go = true;
  ASSERT_TRUE(idle());
  EXPECT_EQ(window.view().previewed(), 0U);
  EXPECT_EQ(window.view().picture(), before);
}

TEST_F(PreviewTest, GoesAwayWhenTheJobIsCancelled) {
  const QImage before = window.view().picture();
  startPlacing(3000);
  ASSERT_TRUE(previewed(3000));
  QTest::keyClick(&window, Qt::Key_Escape);
  ASSERT_TRUE(idle());
  EXPECT_EQ(window.view().previewed(), 0U);
  EXPECT_EQ(window.view().picture(), before);
}

TEST_F(PreviewTest, GoesAwayWhenTheJobFails) {
  startPlacing(3000);
  ASSERT_TRUE(previewed(3000));
  fails = true;
  go = true;
  ASSERT_TRUE(idle());
  EXPECT_TRUE(find<QWidget>("errorCard").isVisible());
  EXPECT_EQ(window.view().previewed(), 0U);
}

TEST_F(PreviewTest, TheWindowAnswersWhileAMillionPointsArrive) {
  startPlacing(1'000'000);
  qint64 longest = 0;
  QElapsedTimer sinceLast;
  sinceLast.start();
  while (window.view().previewed() < 1'000'000) {
    QTest::qWait(10);
    longest = std::max(longest, sinceLast.restart());
  }
  EXPECT_LT(static_cast<double>(longest), 500.0 * machineLoad());
}

}  // namespace
}  // namespace pneuma
