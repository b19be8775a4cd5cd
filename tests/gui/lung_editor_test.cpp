// Lungs corrected by hand in the slices: what the document makes of strokes, undo, files.
#include "document/lung_editor.h"

#include <QElapsedTimer>
#include <QSignalSpy>
#include <QTemporaryDir>
#include <QTest>
#include <numbers>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "document/shell_command.h"
#include "io/atomic_file.h"
#include "io/volume_file.h"
#include "pipeline/ct_model.h"
#include "pipeline/lung_edits_file.h"
#include "render/generated_chest.h"

namespace pneuma {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;
using Tool = LungEditor::Tool;

/// In the belly, beside both lungs.
const Vec3 BesideLungs(10.0, 20.0, -130.0);

class LungEditorTest : public ::testing::Test {
 protected:
  void openChest(Document& one) {
    if (!std::filesystem::exists(at("ct.nii.gz"))) {
      writeVolume(at("ct.nii.gz"), test::generatedChest(test::chestGrid()).ct);
    }
    one.open({at("ct.nii.gz")});
    ASSERT_TRUE(idle(one));
    ASSERT_NE(one.model().lungs, nullptr);
    slices.show(one.model().ct, one.model().labels);
  }

  static bool idle(const Document& one) {
    return QTest::qWaitFor([&] { return !one.jobs().busy(); }, 300000);
  }

  std::filesystem::path at(const char* name) const {
    return std::filesystem::path(folder.path().toStdString()) / name;
  }

  /// One stroke with a tool, from one place to another.
  void draw(Tool tool, const Vec3& from, const Vec3& to) {
    editor.setTool(tool);
    editor.press(SlicePlane::Axial, from);
    editor.drag(0.5 * (from + to));
    editor.drag(to);
    editor.release();
  }

  /// Paints the right lung, 20 mm around a line of so many mm from beside the lungs on.
  void paintRight(double length) {
    editor.setChoice(LungEditor::Choice::Right);
    editor.setRadius(20.0);
    draw(Tool::Brush, BesideLungs, BesideLungs + Vec3(length, 0.0, 0.0));
  }

  static std::size_t count(const Document& one, std::uint8_t label) {
    const auto& voxels = one.model().labels->voxels;
    return static_cast<std::size_t>(std::count(voxels.begin(), voxels.end(), label));
  }

  static double surfaceMl(const Document& one, Lobe lobe) {
    for (const LobeSurface& surface : *one.model().surfaces) {
      if (surface.lobe == lobe) return surface.health.volumeMl;
    }
    return 0.0;
  }

  QTemporaryDir folder;
  Document document;
  SliceViews slices;
  LungEditor editor{document, slices};
};

TEST_F(LungEditorTest, AStrokeIsOneStepWithAName) {
  openChest(document);
  const auto found = document.model().labels;
  const double foundMl = document.model().lungs->right.volumeMl;
  paintRight(40.0);
  EXPECT_EQ(document.undoName(), "paint right lung");
  EXPECT_TRUE(document.followingLungs());
  ASSERT_TRUE(idle(document));
  const double capsuleMl = std::numbers::pi * 400.0 * (40.0 + 80.0 / 3.0) / 1000.0;
  const double painted = document.model().lungs->right.volumeMl - foundMl;
  EXPECT_NEAR(painted, capsuleMl, 0.12 * capsuleMl) << "a part may lie in the lung already";
  EXPECT_EQ(document.model().corrections->edits.size(), 1U);
  EXPECT_EQ(document.model().corrections->found->labels.voxels, found->voxels);
  EXPECT_TRUE(document.snapshot().lungsFollow());
  draw(Tool::Eraser, BesideLungs, BesideLungs);
  EXPECT_EQ(document.undoName(), "erase right lung");
  ASSERT_TRUE(idle(document));
  const double erased = document.model().lungs->right.volumeMl;
  EXPECT_LT(erased, foundMl + painted - 20.0);
  document.undo();
  ASSERT_TRUE(idle(document));
  EXPECT_NEAR(document.model().lungs->right.volumeMl, foundMl + painted, 1e-9);
  document.undo();
  ASSERT_TRUE(idle(document));
  EXPECT_EQ(document.model().labels, found);
  EXPECT_EQ(document.model().corrections, nullptr);
  EXPECT_EQ(document.model().lungs->right.volumeMl, foundMl);
  document.redo();
  document.redo();
  ASSERT_TRUE(idle(document));
  EXPECT_EQ(document.model().lungs->right.volumeMl, erased);
  EXPECT_EQ(document.model().corrections->edits.size(), 2U);
  ASSERT_NE(document.model().labels, nullptr);
  EXPECT_EQ(document.model().labels->voxels, correctedLabels(document.model())->voxels);
}

TEST_F(LungEditorTest, TheDraftIsSeenWhileItIsDrawnAndCanBeGivenUp) {
  openChest(document);
  editor.setTool(Tool::Brush);
  editor.setChoice(LungEditor::Choice::Left);
  const QSignalSpy seen(&slices, &SliceViews::changed);
  editor.press(SlicePlane::Axial, BesideLungs);
  ASSERT_TRUE(editor.stroking());
  EXPECT_TRUE(slices.probe(BesideLungs).contains("left lung"));
  editor.drag(BesideLungs + Vec3(15.0, 0.0, 0.0));
  EXPECT_TRUE(slices.probe(BesideLungs + Vec3(15.0, 0.0, 0.0)).contains("left lung"));
  EXPECT_GE(seen.count(), 2);
  EXPECT_FALSE(document.canUndo() && document.undoName() == "paint left lung");
  editor.abandon();
  EXPECT_FALSE(editor.stroking());
  EXPECT_FALSE(slices.probe(BesideLungs).contains("left lung"));
  EXPECT_EQ(document.model().corrections, nullptr);
  // A stroke that changes nothing is no step.
  const QString before = document.undoName();
  draw(Tool::Eraser, BesideLungs, BesideLungs);
  EXPECT_EQ(document.undoName(), before);
}

TEST_F(LungEditorTest, TheLungIsTheNearestOneOrTheOneThatWasChosen) {
  openChest(document);
  editor.setRadius(4.0);
  const Vec3 byLeft(140.0, 0.0, 0.0);
  draw(Tool::Brush, byLeft, byLeft);
  EXPECT_EQ(document.undoName(), "paint left lung");
  ASSERT_TRUE(idle(document));
  editor.setChoice(LungEditor::Choice::Right);
  draw(Tool::Brush, byLeft, byLeft);
  EXPECT_EQ(document.undoName(), "paint right lung");
  ASSERT_TRUE(idle(document));
  editor.setChoice(LungEditor::Choice::Nearest);
  draw(Tool::Eraser, byLeft, byLeft);
  EXPECT_EQ(document.undoName(), "erase lung");
  ASSERT_TRUE(idle(document));
}

TEST_F(LungEditorTest, ASeedTakesBackWhatWasErasedAndSaysWhereItCannot) {
  openChest(document);
  const std::size_t whole = count(document, 10);
  const Vec3 inLung(-72.0, 20.0, 60.0);
  editor.setRadius(15.0);
  draw(Tool::Eraser, inLung, inLung);
  ASSERT_TRUE(idle(document));
  EXPECT_LT(count(document, 10), whole);
  const std::size_t edits = document.model().corrections->edits.size();
  editor.setTool(Tool::Seed);
  QSignalSpy failed(&document, &Document::failed);
  editor.press(SlicePlane::Axial, BesideLungs);  // nearest: none, or tissue
  ASSERT_TRUE(idle(document));
  editor.setChoice(LungEditor::Choice::Right);
  editor.press(SlicePlane::Axial, BesideLungs);
  ASSERT_TRUE(idle(document));
  ASSERT_GE(failed.count(), 1);
  EXPECT_TRUE(failed.back().at(1).toString().contains("not less dense than -500 HU"));
  EXPECT_EQ(document.model().corrections->edits.size(), edits);
  editor.press(SlicePlane::Axial, inLung);
  ASSERT_TRUE(idle(document));
  EXPECT_EQ(document.undoName(), "grow right lung from a seed");
  EXPECT_GT(count(document, 10), whole - whole / 200) << "but for vessels";
}

TEST_F(LungEditorTest, TheNextStrokeDoesNotWaitForSurfaces) {
  openChest(document);
  editor.setRadius(10.0);
  editor.setChoice(LungEditor::Choice::Right);
  for (int i = 0; i < 4; ++i) draw(Tool::Brush, BesideLungs + Vec3(0, 8.0 * i, 0), BesideLungs);
  EXPECT_EQ(document.model().corrections->edits.size(), 4U);
  EXPECT_TRUE(document.canUndo()) << "while the surfaces follow";
  document.undo();
  EXPECT_EQ(document.model().corrections->edits.size(), 3U);
  ASSERT_TRUE(idle(document));
  EXPECT_TRUE(document.snapshot().lungsFollow());
  const double voxelMl = document.model().labels->geometry.voxelMm3() / 1000.0;
  EXPECT_NEAR(document.model().lungs->right.volumeMl,
              static_cast<double>(count(document, 10)) * voxelMl, 1e-6);
}

TEST_F(LungEditorTest, LobesAndWhatGrewAreGoneAndComeBack) {
  openChest(document);
  const LobeEdits edits = [&] {
    LobeEdits changed = document.snapshot().lobeEdits;
    changed.options.smoothness = 0.25;
    return changed;
  }();
  document.setLobeEdits(edits, "smooth");
  document.splitLobes();
  ASSERT_TRUE(idle(document));
  ASSERT_NE(document.model().lobes, nullptr);
  const auto lobes = document.model().lobes;
  editor.setRadius(15.0);
  const Vec3 inLung(-72.0, 20.0, 60.0);
  draw(Tool::Eraser, inLung, inLung);
  ASSERT_TRUE(idle(document));
  EXPECT_EQ(document.model().lobes, nullptr);
  EXPECT_EQ(document.model().surfaces->size(), 2U);
  EXPECT_EQ(document.snapshot().lobeEdits, edits) << "fissures stay where they are";
  EXPECT_TRUE(document.canSplit());
  document.undo();
  ASSERT_TRUE(idle(document));
  EXPECT_EQ(document.model().lobes, lobes);
}

TEST_F(LungEditorTest, AProjectKeepsCorrectionsAndTheirSteps) {
  openChest(document);
  paintRight(20.0);
  draw(Tool::Eraser, BesideLungs, BesideLungs);
  ASSERT_TRUE(idle(document));
  document.saveProject(at("case.pneuma"), CtStorage::Linked, Json::object(), {});
  ASSERT_TRUE(idle(document));
  Document again;
  again.open({at("case.pneuma")});
  ASSERT_TRUE(idle(again));
  EXPECT_FALSE(again.modified());
  ASSERT_NE(again.model().corrections, nullptr);
  EXPECT_EQ(again.model().corrections->edits, document.model().corrections->edits);
  EXPECT_EQ(again.model().labels->voxels, document.model().labels->voxels);
  EXPECT_EQ(again.model().lungs->right.volumeMl, document.model().lungs->right.volumeMl);
  EXPECT_TRUE(again.snapshot().lungsFollow());
  for (Document* one : {&document, &again}) {
    EXPECT_EQ(one->undoName(), "erase right lung");
    one->undo();
    ASSERT_TRUE(idle(*one));
    EXPECT_EQ(one->undoName(), "paint right lung");
  }
  EXPECT_EQ(again.model().labels->voxels, document.model().labels->voxels);
  again.undo();
  ASSERT_TRUE(idle(again));
  EXPECT_EQ(again.model().corrections, nullptr);
  EXPECT_EQ(again.undoName(), "find lungs");
  again.redo();
  ASSERT_TRUE(idle(again));
  EXPECT_EQ(again.model().labels->voxels, document.model().labels->voxels);
}

TEST_F(LungEditorTest, LobesAreThoseOfCorrectedLungsThatAreStillDrawn) {
  openChest(document);
  paintRight(0.0);
  ASSERT_TRUE(document.followingLungs());
  document.splitLobes();
  EXPECT_FALSE(document.canUndo());
  ASSERT_TRUE(idle(document));
  ASSERT_NE(document.model().lobes, nullptr);
  EXPECT_TRUE(document.snapshot().lungsFollow());
  EXPECT_EQ(document.undoName(), "split lungs into lobes");
  document.undo();
  EXPECT_EQ(document.undoName(), "paint right lung");
  ASSERT_TRUE(idle(document));
  EXPECT_TRUE(document.snapshot().lungsFollow());
}

TEST_F(LungEditorTest, WhatWasNotDrawnYetIsDrawnAfterOpening) {
  openChest(document);
  paintRight(0.0);
  ASSERT_TRUE(document.followingLungs());
  writeProject(at("early.pneuma"), document.projectNow());  // as recovery would
  ASSERT_TRUE(idle(document));
  Document again;
  again.open({at("early.pneuma")});
  ASSERT_TRUE(idle(again));
  EXPECT_TRUE(again.snapshot().lungsFollow());
  EXPECT_EQ(surfaceMl(again, Lobe::RightLung), surfaceMl(document, Lobe::RightLung));
  EXPECT_EQ(again.model().lungs->right.volumeMl, document.model().lungs->right.volumeMl);
}

TEST_F(LungEditorTest, TheFileOfCorrectionsGivesTheSameLungs) {
  openChest(document);
  EXPECT_THAT(shellCommand(WorkStep::Lungs, document).text().toStdString(),
              Not(HasSubstr("edits")));
  editor.setRadius(17.3);
  draw(Tool::Eraser, Vec3(-72.123456789, 20.0, 60.0), Vec3(-60.0, 1.0 / 3.0, 60.0));
  ASSERT_TRUE(idle(document));
  editor.setTool(Tool::Seed);
  editor.setChoice(LungEditor::Choice::Right);
  editor.press(SlicePlane::Axial, Vec3(-72.0, 20.0, 60.0));
  ASSERT_TRUE(idle(document));
  ASSERT_EQ(document.model().corrections->edits.size(), 2U);
  document.saveLungEdits(at("lung-edits.json"));
  ASSERT_TRUE(idle(document));
  const std::vector<LungEdit> edits = readLungEdits(at("lung-edits.json"));
  EXPECT_EQ(edits, document.model().corrections->edits);
  // As the command line does it.
  const LungModel model = withLungEdits(withLungs(pneuma::openCt(at("ct.nii.gz"))), edits, -500.0);
  EXPECT_EQ(model.labels->voxels, document.model().labels->voxels);
  EXPECT_EQ(model.lungs->right.volumeMl, document.model().lungs->right.volumeMl);
  const std::string command = shellCommand(WorkStep::Lungs, document).text().toStdString();
  EXPECT_THAT(command, HasSubstr("# lung-edits.json holds the corrections by hand"));
  EXPECT_THAT(command, HasSubstr("--edits lung-edits.json"));
  EXPECT_THAT(shellCommand(WorkStep::Lobes, document).text().toStdString(),
              HasSubstr("--edits lung-edits.json"));
  // And in the window.
  Document other;
  openChest(other);
  other.openLungEdits(at("lung-edits.json"));
  ASSERT_TRUE(idle(other));
  EXPECT_EQ(other.model().labels->voxels, document.model().labels->voxels);
  EXPECT_EQ(other.undoName(), "open lung corrections");
}

TEST_F(LungEditorTest, ManyStrokesHoldLittle) {
  openChest(document);
  editor.setChoice(LungEditor::Choice::Right);
  editor.setRadius(10.0);
  for (int i = 0; i < 30; ++i) {
    draw(Tool::Brush, BesideLungs + Vec3(0, 2.0 * i, 0), BesideLungs + Vec3(10, 2.0 * i, 0));
  }
  ASSERT_TRUE(idle(document));
  const Project project = document.projectNow();
  std::size_t labels = 0;
  for (const ProjectStep& step : project.undo) {
    if (step.state.model.labels && step.state.model.corrections) ++labels;
  }
  EXPECT_EQ(labels, 0U) << "they are made again by the edits";
  for (int i = 0; i < 30; ++i) document.undo();
  ASSERT_TRUE(idle(document));
  EXPECT_EQ(document.undoName(), "find lungs");
}

TEST_F(LungEditorTest, CorrectsLabelsOfAFileToo) {
  writeVolume(at("ct.nii.gz"), test::generatedChest(test::chestGrid()).ct);
  writeVolume(at("labels.nii.gz"), test::generatedChest(test::chestGrid()).labels);
  document.open({at("ct.nii.gz"), at("labels.nii.gz")});
  ASSERT_TRUE(idle(document));
  ASSERT_EQ(document.model().lungs, nullptr);
  const std::size_t before = count(document, 20);
  editor.setRadius(12.0);
  draw(Tool::Eraser, Vec3(72.0, 0.0, 60.0), Vec3(72.0, 10.0, 60.0));
  ASSERT_TRUE(idle(document));
  EXPECT_LT(count(document, 20), before);
  EXPECT_NE(document.model().corrections->read, nullptr);
  EXPECT_EQ(document.model().surfaces->size(), 2U);
  EXPECT_NE(shellCommand(WorkStep::Lungs, document).obstacle, "");
  document.saveProject(at("case.pneuma"), CtStorage::Linked, Json::object(), {});
  ASSERT_TRUE(idle(document));
  Document again;
  again.open({at("case.pneuma")});
  ASSERT_TRUE(idle(again));
  EXPECT_EQ(again.model().corrections->read->voxels, document.model().corrections->read->voxels);
  again.undo();
  EXPECT_EQ(count(again, 20), before);
}

}  // namespace
}  // namespace pneuma
