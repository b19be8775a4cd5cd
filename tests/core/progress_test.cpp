#include "core/progress.h"

#include <string>
#include <type_traits>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "support/progress_recorder.h"

namespace pneuma {
namespace {

using ::testing::DoubleEq;
using ::testing::ElementsAre;
using testing::ProgressRecorder;

TEST(Progress, IsSilentUnlessSomebodyListens) {
  const Progress silent;
  EXPECT_NO_THROW(silent.report(0.5));
  EXPECT_NO_THROW(silent.throwIfStopped());
  EXPECT_NO_THROW(silent.part(0.0, 0.5, "a step").report(1.0));
  EXPECT_FALSE(silent.wantsPoints());
  EXPECT_NO_THROW(silent.placed(std::vector<Vec3>{Vec3::Zero()}));
}

TEST(Progress, PartsReportTheirShareOfTheWhole) {
  ProgressRecorder recorder;
  const Progress whole(recorder);
  const Progress part = whole.part(0.2, 0.6, "growing");
  part.report(0.0);
  part.report(0.5);
  part.part(0.5, 1.0, "splitting").report(0.5);
  part.report(1.0);
  EXPECT_THAT(recorder.fractions(),
              ElementsAre(DoubleEq(0.2), DoubleEq(0.4), DoubleEq(0.5), DoubleEq(0.6)));
}

TEST(Progress, StaysBetweenNothingAndAll) {
  ProgressRecorder recorder;
  const Progress whole(recorder);
  whole.report(-3.0);
  whole.report(7.0);
  EXPECT_THAT(recorder.fractions(), ElementsAre(0.0, 1.0));
}

TEST(Progress, ThrowsWhenAskedToStop) {
  ProgressRecorder stop(0.3);
  const Progress whole(stop);
  EXPECT_NO_THROW(whole.report(0.2));
  EXPECT_NO_THROW(whole.report(0.3));  // from here on
  EXPECT_THROW(whole.report(0.4), Cancelled);
  EXPECT_THROW(whole.part(0.0, 0.1, "a step").throwIfStopped(), Cancelled);
  EXPECT_EQ(stop.fractions().size(), 2U);
}

TEST(Cancelled, IsNotSwallowedWithErrors) { EXPECT_FALSE((std::is_base_of_v<Error, Cancelled>)); }

class SinkWithNames : public ProgressSink {
 public:
  void report(double, std::string_view what) override { last = what; }

  bool stopRequested() const override { return false; }

  std::string last;
};

TEST(Progress, NamesTheStep) {
  SinkWithNames sink;
  const Progress whole(sink);
  whole.part(0.0, 0.5, "reading").report(0.1);
  EXPECT_EQ(sink.last, "reading");
  whole.report(0.6);
  EXPECT_EQ(sink.last, "");
}

TEST(Progress, TellsWhatIsPlacedToThoseWhoShowIt) {
  ProgressRecorder recorder;
  const Progress part = Progress(recorder).part(0.2, 0.6, "growing");
  ASSERT_TRUE(part.wantsPoints());
  part.placed(std::vector<Vec3>{Vec3(1, 2, 3), Vec3(4, 5, 6)});
  part.placed({});
  part.placed(std::vector<Vec3>{Vec3(7, 8, 9)});
  EXPECT_THAT(recorder.points(), ElementsAre(Vec3(1, 2, 3), Vec3(4, 5, 6), Vec3(7, 8, 9)));
}

TEST(Progress, TellsNoPointsToThoseWhoShowNone) {
  SinkWithNames sink;
  const Progress whole(sink);
  EXPECT_FALSE(whole.wantsPoints());
  EXPECT_NO_THROW(whole.placed(std::vector<Vec3>{Vec3::Zero()}));
}

TEST(Progress, TellsPointsAfterAWishToStop) {
  ProgressRecorder stop(0.0);
  EXPECT_NO_THROW(Progress(stop).placed(std::vector<Vec3>{Vec3::Zero()}));
}

}  // namespace
}  // namespace pneuma
