// Trees of all methods beside each other, without a display.
#include <QElapsedTimer>
#include <QSignalSpy>
#include <QTemporaryDir>
#include <QTest>
#include <filesystem>

#include <gtest/gtest.h>

#include "document/comparison_table.h"
#include "document/document.h"
#include "document/shell_command.h"
#include "growth/centroid_splitting.h"
#include "growth/dla.h"
#include "growth/kitaoka.h"
#include "io/atomic_file.h"
#include "machine_load.h"

namespace pneuma {
namespace {

class ComparisonTest : public ::testing::Test {
 protected:
  void SetUp() override {
    document.openOrgan("sphere");
    wait();
    KitaokaOptions kitaoka;
    kitaoka.terminals = 120;
    document.setGrowthOptions(kitaoka);
    DlaOptions dla;
    dla.particles = 3000;
    document.setGrowthOptions(dla);
    CentroidSplittingOptions centroid;
    centroid.terminals = 200;
    document.setGrowthOptions(centroid);
  }

  void wait() {
    ASSERT_TRUE(QTest::qWaitFor([this] { return !document.jobs().busy(); }, 300000));
  }

  void compare() {
    document.compareMethods();
    wait();
    ASSERT_NE(document.comparison(), nullptr);
  }

  Document document;
};

TEST_F(ComparisonTest, ChangesNothingUntilATreeIsKept) {
  const std::uint64_t revision = document.snapshot().revision;
  const QString undo = document.undoName();
  const QSignalSpy compared(&document, &Document::compared);
  compare();
  EXPECT_EQ(compared.count(), 1);
  EXPECT_EQ(document.comparison()->growths.size(), 3U);
  EXPECT_EQ(document.snapshot().revision, revision);
  EXPECT_EQ(document.undoName(), undo);
  EXPECT_EQ(document.model().growth, nullptr);
  EXPECT_FALSE(document.modified());
}

TEST_F(ComparisonTest, KeepingIsOneStepAndTakesTheOptions) {
  compare();
  const auto kept = document.comparison()->growths[0];
  document.keepCompared(0);
  EXPECT_EQ(document.model().growth, kept);
  EXPECT_EQ(document.growthMethodIndex(), 0U);
  EXPECT_FALSE(document.growthOutOfDate());
  EXPECT_EQ(document.snapshot().figures->terminals,
            document.comparison()->measured.trees[0].measured.whole.terminals);
  EXPECT_EQ(document.undoName().toStdString(), "keep the tree of Kitaoka's rules");
  document.undo();
  EXPECT_EQ(document.model().growth, nullptr);
  document.redo();
  EXPECT_EQ(document.model().growth, kept);
}

TEST_F(ComparisonTest, IsNotGrownAgainUnlessSomethingChanged) {
  compare();
  const auto first = document.comparison();
  document.compareMethods();
  EXPECT_FALSE(document.jobs().busy());
  EXPECT_EQ(document.comparison(), first);
  CentroidSplittingOptions other;
  other.terminals = 300;
  document.setGrowthOptions(other);
  document.compareMethods();
  EXPECT_TRUE(document.comparing());
  wait();
  EXPECT_FALSE(document.comparing());
  EXPECT_NE(document.comparison(), first);
}

TEST_F(ComparisonTest, IsForgottenInOtherLobes) {
  compare();
  document.openOrgan("right-lung");
  wait();
  EXPECT_EQ(document.comparison(), nullptr);
}

TEST_F(ComparisonTest, ACancelledOneLeavesNothing) {
  KitaokaOptions large;
  large.terminals = 2000000;
  document.setGrowthOptions(large);
  document.compareMethods();
  QTest::qWait(300);
  ASSERT_TRUE(document.jobs().busy());
  QElapsedTimer clock;
  clock.start();
  document.jobs().cancel();
  wait();
  EXPECT_LT(clock.elapsed(), 500 * machineLoad());
  EXPECT_EQ(document.comparison(), nullptr);
  EXPECT_EQ(document.model().growth, nullptr);
}

TEST_F(ComparisonTest, TheTableHasTheFiguresAndTheFileTheCommandsHave) {
  compare();
  const auto lines = comparisonLines(*document.comparison(), ComparisonFigures::Main);
  const auto all = comparisonLines(*document.comparison(), ComparisonFigures::All);
  EXPECT_GT(all.size(), lines.size() + 10);
  EXPECT_EQ(lines[0].label.toStdString(), "time to grow");
  EXPECT_EQ(lines[1].values[0].toStdString(), "0 (0.00 %)");
  const auto branches =
      std::ranges::find(lines, QStringLiteral("branches"), &ComparisonLine::label);
  ASSERT_NE(branches, lines.end());
  EXPECT_EQ(branches->values.size(), 3);
  EXPECT_EQ(branches->published.toStdString(), "54,000");
  const QTemporaryDir folder;
  const auto path = std::filesystem::path(folder.path().toStdString()) / "table.csv";
  document.saveComparison(path);
  wait();
  EXPECT_EQ(readFile(path), compareCsv(document.comparison()->measured));
}

TEST_F(ComparisonTest, IsCopiedAsCommands) {
  EXPECT_NE(compareCommand(document).obstacle, "");
  compare();
  EXPECT_EQ(
      compareCommand(document).text().toStdString(),
      "pneuma grow --organ sphere --set terminals=120 -o kitaoka.vtp\n"
      "pneuma grow --organ sphere --method centroid --set terminals=200 -o centroid.vtp\n"
      "pneuma grow --organ sphere --method dla --set particles=3000 -o dla.vtp\n"
      "pneuma compare kitaoka.vtp centroid.vtp dla.vtp --organ sphere --csv -o comparison.csv");
}

}  // namespace
}  // namespace pneuma
