#include "document/document.h"

#include <QElapsedTimer>
#include <QSignalSpy>
#include <QTemporaryDir>
#include <QTest>

#include <gtest/gtest.h>

#include "growth/kitaoka.h"
#include "io/surface_file.h"
#include "io/tree_file.h"
#include "machine_load.h"
#include "pipeline/sample_chest.h"

namespace pneuma {
namespace {

namespace fs = std::filesystem;

CentroidSplittingOptions optionsFor(std::uint64_t terminals) {
  CentroidSplittingOptions options;
  options.terminals = terminals;
  return options;
}

class DocumentTest : public ::testing::Test {
 protected:
  bool idle(int milliseconds = 300000) {
    return QTest::qWaitFor([this] { return !document.jobs().busy(); }, milliseconds);
  }

  void openSampleAndGrow(std::uint64_t terminals) {
    document.openSample();
    ASSERT_TRUE(idle());
    document.setGrowthOptions(optionsFor(terminals));
    document.grow();
    ASSERT_TRUE(idle());
    ASSERT_EQ(failed.count(), 0) << failed.at(0).at(1).toString().toStdString();
  }

  fs::path inFolder(const char* name) const { return fs::path(folder.path().toStdString()) / name; }

  QTemporaryDir folder;
  Document document;
  QSignalSpy failed{&document, &Document::failed};
};

TEST_F(DocumentTest, StartsEmpty) {
  EXPECT_EQ(document.tree(), nullptr);
  EXPECT_FALSE(document.canGrow());
  EXPECT_FALSE(document.canUndo());
  EXPECT_FALSE(document.canRedo());
}

TEST_F(DocumentTest, GrowsInTheSampleChest) {
  openSampleAndGrow(1000);
  EXPECT_EQ(document.model().surfaces->size(), 5U);
  EXPECT_NEAR(static_cast<double>(document.snapshot().figures->terminals), 1000.0, 60.0);
  EXPECT_FALSE(document.growthOutOfDate());
  document.setGrowthOptions(optionsFor(2000));
  EXPECT_TRUE(document.growthOutOfDate());
}

TEST_F(DocumentTest, EveryMethodKeepsItsOptions) {
  ASSERT_EQ(document.growthOptions(), growthMethods()[0].defaults);
  document.setGrowthOptions(kitaokaPaper());
  document.setGrowthOptions(optionsFor(1234));
  EXPECT_EQ(document.growthMethodIndex(), 1U);
  document.setGrowthMethod(0);
  EXPECT_EQ(document.growthOptions(), GrowthOptions(kitaokaPaper()));
  document.setGrowthMethod(1);
  EXPECT_EQ(document.growthOptions(), GrowthOptions(optionsFor(1234)));
}

TEST_F(DocumentTest, ABuiltInOrganOpensAndItsAirwaysStayInIt) {
  document.openOrgan("sphere");
  ASSERT_TRUE(idle());
  ASSERT_EQ(failed.count(), 0) << failed.at(0).at(1).toString().toStdString();
  EXPECT_TRUE(document.canGrow());
  EXPECT_EQ(document.snapshot().name, "Sphere (built in)");
  // The lobes of a person replace the organ; its trunk leads nowhere in them.
  const SampleChest chest = sampleChest(4.0);
  std::vector<fs::path> surfaces;
  for (const LobeSurface& lobe : chest.lobes) {
    surfaces.push_back(inFolder((std::string(shortName(lobe.lobe)) + ".stl").c_str()));
    writeSurface(surfaces.back(), *lobe.mesh);
  }
  document.open(surfaces);
  ASSERT_TRUE(idle());
  EXPECT_EQ(document.tree(), nullptr);
}

TEST_F(DocumentTest, AnOrganThatThereIsNotIsSaid) {
  document.openOrgan("spere");
  ASSERT_TRUE(idle());
  ASSERT_EQ(failed.count(), 1);
  EXPECT_TRUE(failed.at(0).at(1).toString().contains("sphere"));
}

TEST_F(DocumentTest, OnlyAGrownTreeThatIsInNoFileIsUnsaved) {
  document.openSample();
  ASSERT_TRUE(idle());
  EXPECT_FALSE(document.workUnsaved());
  openSampleAndGrow(200);
  EXPECT_TRUE(document.workUnsaved());
  QSignalSpy saved(&document, &Document::treeWasSaved);
  document.saveTree(inFolder("tree.vtp"));
  ASSERT_TRUE(idle());
  EXPECT_EQ(saved.count(), 1);
  EXPECT_FALSE(document.workUnsaved());
}

TEST_F(DocumentTest, UndoTakesAGrowthBackAndRedoBringsTheSameTreeAgain) {
  openSampleAndGrow(500);
  const auto grown = document.tree();
  ASSERT_TRUE(document.canUndo());
  document.undo();
  EXPECT_EQ(document.model().growth, nullptr);
  EXPECT_LT(document.tree()->size(), grown->size());
  ASSERT_TRUE(document.canRedo());
  document.redo();
  EXPECT_EQ(document.tree(), grown);
}

TEST_F(DocumentTest, AStepAfterAnUndoForgetsWhatWasUndone) {
  openSampleAndGrow(500);
  document.undo();
  document.grow();
  ASSERT_TRUE(idle());
  EXPECT_FALSE(document.canRedo());
  EXPECT_NE(document.model().growth, nullptr);
}

TEST_F(DocumentTest, ACancelledGrowthChangesNothing) {
  openSampleAndGrow(200);
  const auto before = document.tree();
  document.setGrowthOptions(optionsFor(5000000));
  document.grow();
  QTest::qWait(300);
  ASSERT_TRUE(document.jobs().busy());
  QElapsedTimer clock;
  clock.start();
  document.jobs().cancel();
  ASSERT_TRUE(idle());
  const auto elapsedMs = static_cast<double>(clock.elapsed());  // before the load is measured
  EXPECT_LT(elapsedMs, 500.0 * machineLoad());
  EXPECT_EQ(document.tree(), before);
  EXPECT_EQ(failed.count(), 0);
}

TEST_F(DocumentTest, ASavedTreeReadsBackEqual) {
  openSampleAndGrow(500);
  EXPECT_FALSE(document.treeSaved());
  document.saveTree(inFolder("tree.vtp"));
  ASSERT_TRUE(idle());
  ASSERT_EQ(failed.count(), 0);
  EXPECT_TRUE(document.treeSaved());
  const AirwayTree back = readTree(inFolder("tree.vtp")).tree;
  const AirwayTree& shown = *document.tree();
  ASSERT_EQ(back.size(), shown.size());
  for (std::size_t i = 0; i < back.size(); ++i) {
    ASSERT_EQ(back[i].parent, shown[i].parent);
    ASSERT_EQ(back[i].distal, shown[i].distal);
    ASSERT_EQ(back[i].radiusMm, shown[i].radiusMm);
    ASSERT_EQ(back[i].lobe, shown[i].lobe);
  }
}

TEST_F(DocumentTest, ATreeOpenedAloneJoinsTheLobesThatAreOpen) {
  const SampleChest chest = sampleChest(4.0);
  std::vector<fs::path> surfaces;
  for (const LobeSurface& lobe : chest.lobes) {
    surfaces.push_back(inFolder((std::string(shortName(lobe.lobe)) + ".stl").c_str()));
    writeSurface(surfaces.back(), *lobe.mesh);
  }
  writeTree(inFolder("central.vtp"), chest.central);
  document.open(surfaces);
  ASSERT_TRUE(idle());
  ASSERT_EQ(failed.count(), 0) << failed.at(0).at(1).toString().toStdString();
  EXPECT_EQ(document.tree(), nullptr);
  document.open({inFolder("central.vtp")});
  ASSERT_TRUE(idle());
  ASSERT_NE(document.tree(), nullptr);
  ASSERT_NE(document.model().surfaces, nullptr);
  EXPECT_EQ(document.model().surfaces->size(), 5U);
  EXPECT_EQ(document.tree()->size(), chest.central.size());
  document.undo();
  EXPECT_EQ(document.tree(), nullptr);
  EXPECT_NE(document.model().surfaces, nullptr);
}

TEST_F(DocumentTest, AMissingFileIsSaidWithoutItsFolder) {
  document.open({inFolder("missing_rul.stl")});
  ASSERT_TRUE(idle());
  ASSERT_EQ(failed.count(), 1);
  const QString sentence = failed.at(0).at(1).toString();
  EXPECT_TRUE(sentence.contains("missing_rul.stl")) << sentence.toStdString();
  EXPECT_FALSE(sentence.contains(folder.path())) << sentence.toStdString();
  EXPECT_FALSE(document.canUndo());
}

TEST_F(DocumentTest, AnOutputThatCannotBeWrittenIsSaid) {
  openSampleAndGrow(200);
  document.saveTree(inFolder("no such folder/tree.vtp"));
  ASSERT_TRUE(idle());
  EXPECT_EQ(failed.count(), 1);
  EXPECT_FALSE(document.treeSaved());
}

}  // namespace
}  // namespace pneuma
