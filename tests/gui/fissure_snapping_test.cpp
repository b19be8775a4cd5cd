#include <QSignalSpy>
#include <QTemporaryDir>
#include <QTest>
#include <cmath>

#include <gtest/gtest.h>

#include "document/fissure_editor.h"
#include "document/lobes_sheet.h"
#include "io/volume_file.h"
#include "render/generated_chest.h"

// Fissures drawn onto those that show in a CT.
namespace pneuma {
namespace {

/// How far a point lies above the chest's fissures: both lungs have one.
double aboveTruth(const Vec3& p) {
  const bool left = p.x() > 0.0;
  const double slope = left ? 1.2 : 0.9;
  const double offset = left ? -5.0 : -4.0;
  const double bend = 4.0 * std::sin(p.x() / 25.0);
  return (p.z() - offset - slope * p.y() - bend) / std::hypot(1.0, slope);
}

/// A chest whose fissures are sheets a millimetre thick.
CtImage chest(double thickMm) {
  ImageGeometry geometry;
  geometry.size = {200, 134, static_cast<int>(260.0 / thickMm)};
  geometry.spacing = Vec3(1.5, 1.5, thickMm);
  geometry.origin = Vec3(-149.25, -99.75, -130.0);
  test::GeneratedChest made = test::generatedChest(geometry);
  for (int k = 0; k < geometry.size[2]; ++k) {
    for (int j = 0; j < geometry.size[1]; ++j) {
      for (int i = 0; i < geometry.size[0]; ++i) {
        std::int16_t& hu = made.ct.at(i, j, k);
        if (hu != -860) continue;
        const double away = std::abs(aboveTruth(geometry.worldFromVoxel(Vec3(i, j, k))));
        hu = static_cast<std::int16_t>(-860.0 + 260.0 * std::clamp(1.5 - away, 0.0, 1.0));
      }
    }
  }
  return made.ct;
}

class FissureSnappingTest : public ::testing::Test {
 protected:
  void openCt(double thickMm) {
    writeVolume(ct(), chest(thickMm));
    document.open({ct()});
    ASSERT_TRUE(idle());
    ASSERT_TRUE(editor.available());
    editor.setCurrent(Fissure::LeftOblique);
  }

  std::filesystem::path ct() const {
    return std::filesystem::path(folder.path().toStdString()) / "ct.nii.gz";
  }

  bool idle() {
    return QTest::qWaitFor([this] { return !document.jobs().busy(); }, 300000);
  }

  /// Mean distance of the fissure from the true one, inside the lung, mm.
  double awayFromTruth(Fissure fissure) {
    const TriangleMesh patch = editor.preview(side(fissure))->patch(fissure, 6.0);
    double sum = 0.0;
    for (const Vec3& p : patch.points) sum += std::abs(aboveTruth(p));
    return sum / static_cast<double>(patch.points.size());
  }

  QTemporaryDir folder;
  Document document;
  FissureEditor editor{document};
  QSignalSpy failed{&document, &Document::failed};
  QSignalSpy said{&document, &Document::said};
};

TEST_F(FissureSnappingTest, NeedsThinSlicesAndSaysWhyNot) {
  EXPECT_TRUE(document.snapObstacle().contains("Needs a CT"));
  openCt(2.5);
  EXPECT_TRUE(document.snapObstacle().contains("2.50 mm"));
  document.setSnapping(true);
  EXPECT_FALSE(document.jobs().busy());
  EXPECT_FALSE(document.snapshot().lobeEdits.snap);
  EXPECT_TRUE(said.last().at(0).toString().contains("1.5 mm"));
  document.splitLobes();
  ASSERT_TRUE(idle());
  EXPECT_EQ(failed.count(), 0);
  EXPECT_EQ(editor.traced(Fissure::LeftOblique)->complete, std::nullopt);
}

TEST_F(FissureSnappingTest, DrawsProposalsPointsAndLobesOntoTheFissures) {
  openCt(1.25);
  EXPECT_EQ(document.snapObstacle(), QString());
  const double proposed = awayFromTruth(Fissure::LeftOblique);
  EXPECT_GT(proposed, 3.0);

  // Stopped, nothing has changed.
  document.setSnapping(true);
  EXPECT_TRUE(document.lookingForFissures());
  document.jobs().cancel();
  ASSERT_TRUE(idle());
  EXPECT_FALSE(document.snapshot().lobeEdits.snap);
  EXPECT_EQ(document.sheets(Side::Left), nullptr);

  document.setSnapping(true);
  ASSERT_TRUE(idle());
  ASSERT_EQ(failed.count(), 0) << failed.at(0).at(1).toString().toStdString();
  EXPECT_EQ(document.undoName(), "snap to the CT");
  for (const Fissure fissure : {Fissure::LeftOblique, Fissure::RightOblique}) {
    EXPECT_LT(awayFromTruth(fissure), 0.7) << shortName(fissure);
    ASSERT_NE(editor.traced(fissure), nullptr);
    EXPECT_GT(editor.traced(fissure)->complete->share, 0.7) << shortName(fissure);
  }
  EXPECT_TRUE(fissureLine(editor, Fissure::LeftOblique).contains("Found in the CT"));
  EXPECT_TRUE(fissureShows(editor, Fissure::LeftOblique).contains("% of it shows"));
  // There is no horizontal one.
  EXPECT_LT(editor.traced(Fissure::RightHorizontal)->complete->share, 0.4);
  const auto sheets = document.sheets(Side::Left);

  document.undo();
  ASSERT_TRUE(idle());
  EXPECT_NEAR(awayFromTruth(Fissure::LeftOblique), proposed, 0.01);
  document.redo();
  ASSERT_TRUE(idle());
  EXPECT_LT(awayFromTruth(Fissure::LeftOblique), 0.7);
  EXPECT_EQ(document.sheets(Side::Left), sheets);  // looked for once

  // Taken back while the fissure still follows it.
  editor.addPoint(Vec3(75.0, 0.0, 20.0));
  ASSERT_TRUE(document.jobs().busy());
  document.undo();
  ASSERT_TRUE(idle());
  EXPECT_EQ(document.undoName(), "snap to the CT");
  EXPECT_LT(awayFromTruth(Fissure::LeftOblique), 0.7);

  // Points that are set 2 mm off lie on the fissure, at once and while they are dragged.
  for (const Vec3& place : {Vec3(55.0, -40.0, 0.0), Vec3(90.0, -35.0, 0.0), Vec3(60.0, 30.0, 0.0),
                            Vec3(95.0, 25.0, 0.0), Vec3(75.0, 0.0, 0.0), Vec3(72.0, 45.0, 0.0)}) {
    Vec3 point = place;
    point.z() -= aboveTruth(point) * std::hypot(1.0, 1.2);
    editor.addPoint(point + Vec3(0.0, 0.0, 2.5));
  }
  double away = 0.0;
  for (const Vec3& point : editor.points(Fissure::LeftOblique)) away += std::abs(aboveTruth(point));
  EXPECT_LT(away / 6.0, 0.4);
  const FissureEditor::Mark mark = editor.marks().back();
  editor.drag(mark, mark.place + Vec3(0.0, 0.0, 2.0));
  EXPECT_LT(std::abs(aboveTruth(editor.marks().back().place)), 0.5);
  editor.release();
  ASSERT_TRUE(idle());
  EXPECT_NEAR(document.snapshot().lobeEdits.fissures.at(Fissure::LeftOblique).points.back().z(),
              mark.place.z() + 2.0, 1e-9);

  // The lobes are split as the preview shows them, with what was looked for before.
  const TracedFissure preview = *editor.traced(Fissure::LeftOblique);
  document.splitLobes();
  ASSERT_TRUE(idle());
  ASSERT_EQ(failed.count(), 0) << failed.at(0).at(1).toString().toStdString();
  EXPECT_TRUE(editor.exact());
  EXPECT_EQ(document.sheets(Side::Left), sheets);
  const TracedFissure& exact = *editor.traced(Fissure::LeftOblique);
  EXPECT_EQ(exact.points, preview.points);
  EXPECT_EQ(exact.used.surface.weights, preview.used.surface.weights);
  EXPECT_NEAR(exact.complete->share, preview.complete->share, 0.05);

  document.setSnapping(false);
  ASSERT_TRUE(idle());
  EXPECT_FALSE(document.model().lobes->snapped.contains(Fissure::LeftOblique));
  EXPECT_TRUE(editor.exact());
}

}  // namespace
}  // namespace pneuma
