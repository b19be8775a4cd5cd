#include "core/joint_progress.h"

#include <algorithm>

#include <gtest/gtest.h>

#include "core/parallel.h"
#include "support/progress_recorder.h"

namespace pneuma {
namespace {

using testing::ProgressRecorder;

TEST(JointProgress, IsTheMeanOfItsTasks) {
  ProgressRecorder recorder;
  JointProgress joint(Progress(recorder).part(0.5, 1.0, ""), 2);
  joint.task(0).report(0.5);
  joint.task(1).part(0.0, 0.5, "half").report(1.0);
  joint.task(0).report(1.0);
  joint.task(1).report(1.0);
  const std::vector<double> expected = {0.625, 0.75, 0.875, 1.0};
  EXPECT_EQ(recorder.fractions(), expected);
}

TEST(JointProgress, OnlyRises) {
  ProgressRecorder recorder;
  JointProgress joint{Progress(recorder), 1};
  joint.task(0).report(0.6);
  joint.task(0).report(0.4);
  EXPECT_EQ(recorder.fractions(), std::vector<double>{0.6});
}

TEST(JointProgress, TakesReportsFromAllThreads) {
  ProgressRecorder recorder;
  JointProgress joint{Progress(recorder), 50};
  parallelFor(50, [&](std::size_t i) {
    for (int step = 1; step <= 4; ++step) joint.task(i).report(step / 4.0);
  });
  EXPECT_TRUE(std::ranges::is_sorted(recorder.fractions()));
  EXPECT_NEAR(recorder.fractions().back(), 1.0, 1e-12);
}

TEST(JointProgress, PassesAWishToStopToEveryTask) {
  ProgressRecorder recorder(0.2);
  JointProgress joint{Progress(recorder), 2};
  joint.task(0).report(0.5);
  EXPECT_THROW(joint.task(0).throwIfStopped(), Cancelled);
  EXPECT_THROW(joint.task(1).report(0.1), Cancelled);
}

TEST(JointProgress, PassesOnWhatAnyTaskPlaces) {
  ProgressRecorder recorder;
  JointProgress joint{Progress(recorder), 50};
  ASSERT_TRUE(joint.task(0).wantsPoints());
  parallelFor(50, [&](std::size_t i) {
    joint.task(i).placed(std::vector<Vec3>{Vec3(static_cast<double>(i), 0, 0)});
  });
  EXPECT_EQ(recorder.points().size(), 50U);
  JointProgress unseen{Progress(), 1};
  EXPECT_FALSE(unseen.task(0).wantsPoints());
}

}  // namespace
}  // namespace pneuma
