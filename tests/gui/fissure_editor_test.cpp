#include "document/fissure_editor.h"

#include <QSignalSpy>
#include <QTemporaryDir>
#include <QTest>

#include <gtest/gtest.h>

#include "document/lobes_sheet.h"
#include "io/surface_file.h"
#include "io/volume_file.h"
#include "render/generated_lungs.h"
#include "render/slice_picture.h"

namespace pneuma {
namespace {

class FissureEditorTest : public ::testing::Test {
 protected:
  void openLungs() {
    write("right.stl", -75.0);
    write("left.stl", 75.0);
    document.open({folder.path().toStdString()});
    ASSERT_TRUE(idle());
    ASSERT_TRUE(editor.available());
  }

  void write(const char* name, double x) const {
    writeSurface(std::filesystem::path(folder.path().toStdString()) / name,
                 test::ellipsoid(Vec3(x, 0.0, 0.0), Vec3(55.0, 80.0, 115.0)));
  }

  bool idle() {
    return QTest::qWaitFor([this] { return !document.jobs().busy(); }, 300000);
  }

  void split() {
    document.splitLobes();
    ASSERT_TRUE(idle());
    ASSERT_EQ(failed.count(), 0) << failed.at(0).at(1).toString().toStdString();
  }

  /// Points of a plane that leans to the back, `up` mm higher.
  void setPoints(double up) {
    for (const Vec3& p : {Vec3(-75.0, -60.0, -50.0), Vec3(-55.0, 0.0, 0.0), Vec3(-95.0, 0.0, 0.0),
                          Vec3(-75.0, 60.0, 50.0)}) {
      editor.addPoint(p + Vec3(0.0, 0.0, up));
    }
  }

  double ml(Lobe lobe) const { return editor.volumesMm3().at(lobe) / 1000.0; }

  QTemporaryDir folder;
  Document document;
  FissureEditor editor{document};
  QSignalSpy failed{&document, &Document::failed};
};

TEST_F(FissureEditorTest, TheProposalIsThereAsSoonAsTheLungsAre) {
  EXPECT_FALSE(editor.available());
  openLungs();
  EXPECT_EQ(editor.fissures().size(), 3U);
  EXPECT_EQ(fissureLine(editor, Fissure::RightOblique), "Proposed by the lung's shape");
  for (const Lobe lobe : FiveLobes) EXPECT_GT(ml(lobe), 100.0) << shortName(lobe);
  EXPECT_FALSE(editor.exact());
  EXPECT_FALSE(document.canUndo() && document.undoName() != "open");
}

TEST_F(FissureEditorTest, TakesPointsFromTheThirdOnAndBackAgain) {
  openLungs();
  editor.setCurrent(Fissure::RightOblique);
  const double proposed = ml(Lobe::RightLower);
  const double left = ml(Lobe::LeftLower);
  editor.addPoint({-75.0, -60.0, 0.0});
  editor.addPoint({-55.0, 0.0, 40.0});
  EXPECT_TRUE(fissureLine(editor, Fissure::RightOblique).contains("2 of 3"));
  EXPECT_EQ(ml(Lobe::RightLower), proposed);
  editor.addPoint({-95.0, 0.0, 40.0});
  EXPECT_GT(ml(Lobe::RightLower), proposed + 50.0);
  EXPECT_EQ(ml(Lobe::LeftLower), left);
  editor.removeLast();
  EXPECT_EQ(ml(Lobe::RightLower), proposed);
  document.undo();
  EXPECT_EQ(editor.edit(Fissure::RightOblique).points.size(), 3U);
  EXPECT_GT(ml(Lobe::RightLower), proposed + 50.0);
}

TEST_F(FissureEditorTest, ADragIsSeenAtOnceAndIsOneStepToUndo) {
  openLungs();
  editor.setCurrent(Fissure::RightOblique);
  setPoints(0.0);
  const double before = ml(Lobe::RightLower);
  const FissureEditor::Mark mark = editor.marks().back();
  for (int i = 1; i <= 5; ++i) editor.drag(mark, mark.place + Vec3(0.0, 0.0, 6.0 * i));
  EXPECT_GT(ml(Lobe::RightLower), before + 20.0);
  EXPECT_EQ(document.snapshot().lobeEdits.fissures.at(Fissure::RightOblique).points.back(),
            mark.place);
  editor.release();
  EXPECT_EQ(document.undoName(), "move a point");
  document.undo();
  EXPECT_EQ(document.undoName(), "set a point");
  EXPECT_NEAR(ml(Lobe::RightLower), before, 1e-6);
}

TEST_F(FissureEditorTest, APlaneBeginsWhereTheFissureIsAndTurnsByItsHandles) {
  openLungs();
  const double proposed = ml(Lobe::LeftLower);
  editor.setMethod(Fissure::LeftOblique, FissureMethod::Plane);
  EXPECT_NEAR(ml(Lobe::LeftLower), proposed, 0.12 * (proposed + ml(Lobe::LeftUpper)));
  ASSERT_EQ(editor.marks().size(), 3U);
  const double plane = ml(Lobe::LeftLower);
  for (const FissureEditor::Mark& mark : editor.marks()) {
    editor.drag(mark, mark.place + Vec3(0.0, 0.0, 15.0));
  }
  editor.release();
  EXPECT_GT(ml(Lobe::LeftLower), plane + 50.0);
  editor.setMethod(Fissure::LeftOblique, FissureMethod::Points);
  EXPECT_NEAR(ml(Lobe::LeftLower), proposed, 1e-6);
}

TEST_F(FissureEditorTest, PointsOnOneLineAreAProblemAndTheFissureStays) {
  openLungs();
  editor.setCurrent(Fissure::RightOblique);
  const double proposed = ml(Lobe::RightLower);
  for (int i = 0; i < 3; ++i) editor.addPoint({-75.0, 10.0 * i, 10.0 * i});
  EXPECT_TRUE(fissureLine(editor, Fissure::RightOblique).contains("on one line"));
  EXPECT_EQ(ml(Lobe::RightLower), proposed);
}

TEST_F(FissureEditorTest, TheLobesOfASplitFollowEveryEdit) {
  openLungs();
  editor.setCurrent(Fissure::RightOblique);
  setPoints(0.0);
  const double preview = ml(Lobe::RightLower);
  split();
  EXPECT_TRUE(editor.exact());
  EXPECT_EQ(document.model().surfaces->size(), 5U);
  EXPECT_NEAR(ml(Lobe::RightLower), preview, 0.01 * preview);
  const double exact = ml(Lobe::RightLower);
  const FissureEditor::Mark mark = editor.marks().back();
  editor.drag(mark, mark.place + Vec3(0.0, 0.0, 30.0));
  EXPECT_FALSE(editor.exact());
  editor.release();
  EXPECT_TRUE(document.splitting());
  ASSERT_TRUE(idle());
  EXPECT_TRUE(editor.exact());
  EXPECT_GT(ml(Lobe::RightLower), exact + 20.0);
  document.undo();  // the edit and its lobes together
  EXPECT_TRUE(editor.exact());
  EXPECT_NEAR(ml(Lobe::RightLower), exact, 1e-9);
}

TEST_F(FissureEditorTest, AnEditWhileTheLobesFollowTheOneBeforeIsNotLost) {
  openLungs();
  split();
  editor.setCurrent(Fissure::RightOblique);
  setPoints(0.0);  // the last two come while the lobes of the third point are being split
  ASSERT_TRUE(idle());
  EXPECT_EQ(editor.edit(Fissure::RightOblique).points.size(), 4U);
  EXPECT_TRUE(editor.exact());
  EXPECT_EQ(document.model().lobes->fissures.at(Fissure::RightOblique).points, 4U);
  EXPECT_EQ(failed.count(), 0);
}

TEST_F(FissureEditorTest, WantedVolumesAreReached) {
  openLungs();
  const double lung = ml(Lobe::LeftUpper) + ml(Lobe::LeftLower);
  editor.setShares({{Side::Left, {0.6, 0.4}}});
  EXPECT_NEAR(ml(Lobe::LeftUpper) / lung, 0.6, 0.005);
  split();
  EXPECT_NEAR(ml(Lobe::LeftUpper) / (ml(Lobe::LeftUpper) + ml(Lobe::LeftLower)), 0.6, 1e-4);
  editor.setShares({});
  ASSERT_TRUE(idle());
  EXPECT_GT(std::abs(ml(Lobe::LeftUpper) / lung - 0.6), 0.02);
}

TEST_F(FissureEditorTest, MarksAreFoundInTheSlicesThatShowThem) {
  openLungs();
  editor.setCurrent(Fissure::RightOblique);
  setPoints(0.0);
  const Vec3 point(-75.0, 60.0, 50.0);
  EXPECT_EQ(editor.markAt(point + Vec3(1.5, 2.0, 0.0), 0, 3.0)->index, 3U);
  EXPECT_FALSE(editor.markAt(point + Vec3(2.5, 0.0, 0.0), 0, 3.0));  // another slice
  EXPECT_FALSE(editor.markAt(point + Vec3(0.0, 4.0, 0.0), 0, 3.0));
}

TEST_F(FissureEditorTest, OtherLungsBeginWithProposalsAgain) {
  openLungs();
  editor.setCurrent(Fissure::RightOblique);
  setPoints(0.0);
  write("right.stl", -80.0);
  document.open({folder.path().toStdString()});
  ASSERT_TRUE(idle());
  EXPECT_TRUE(editor.marks().empty());
  document.undo();
  EXPECT_EQ(editor.marks().size(), 4U);
}

TEST_F(FissureEditorTest, SurfacesTellTheSlicesOfACtWithoutLabelsWhereTheLungsAre) {
  openLungs();
  EXPECT_EQ(document.snapshot().lungLabels, nullptr);
  CtImage ct;
  ct.geometry.size = {40, 30, 40};
  ct.geometry.spacing = Vec3::Constant(8.0);
  ct.geometry.origin = Vec3(-160.0, -120.0, -160.0);
  ct.voxels.assign(ct.geometry.voxelCount(), -1000);
  for (int i = 5; i < 35; ++i) {
    for (int j = 5; j < 25; ++j) {
      for (int k = 0; k < 40; ++k) ct.at(i, j, k) = 40;
    }
  }
  const auto file = std::filesystem::path(folder.path().toStdString()) / "ct.nii.gz";
  writeVolume(file, ct);
  document.open({file});
  ASSERT_TRUE(idle());  // nothing but flesh: no lungs are found in it
  ASSERT_NE(document.model().ct, nullptr) << failed.at(0).at(1).toString().toStdString();
  EXPECT_FALSE(editor.available());
  document.open(
      {folder.path().toStdString() + "/right.stl", folder.path().toStdString() + "/left.stl"});
  ASSERT_TRUE(idle());
  ASSERT_NE(document.model().ct, nullptr);
  ASSERT_EQ(document.model().labels, nullptr);
  ASSERT_TRUE(editor.available());
  const auto labels = document.snapshot().lungLabels;
  ASSERT_NE(labels, nullptr);
  EXPECT_EQ(labelAt(*labels, {75.0, 0.0, 0.0}), static_cast<std::uint8_t>(Lobe::LeftLung));
  EXPECT_EQ(labelAt(*labels, {-75.0, 0.0, 0.0}), static_cast<std::uint8_t>(Lobe::RightLung));
  EXPECT_EQ(labelAt(*labels, {0.0, 0.0, 0.0}), std::uint8_t{0});
}

TEST_F(FissureEditorTest, ATreeIsOutOfDateOnceTheLobesAreOthers) {
  openLungs();
  split();
  CentroidSplittingOptions options;
  options.terminals = 500;
  document.setGrowthOptions(options);
  document.grow();
  ASSERT_TRUE(idle());
  ASSERT_EQ(failed.count(), 0) << failed.at(0).at(1).toString().toStdString();
  EXPECT_FALSE(document.growthOutOfDate());
  editor.setCurrent(Fissure::RightOblique);
  setPoints(0.0);
  ASSERT_TRUE(idle());
  EXPECT_TRUE(document.growthOutOfDate());
  EXPECT_NE(document.tree(), nullptr);
}

}  // namespace
}  // namespace pneuma
