#include <QSignalSpy>
#include <QTemporaryDir>
#include <QTest>

#include <gtest/gtest.h>

#include "document/document.h"
#include "document/held_bytes.h"
#include "io/surface_file.h"
#include "render/generated_lungs.h"

namespace pneuma {
namespace {

/// A snapshot that holds a mesh of so many bytes of points.
Snapshot holding(std::size_t bytes) {
  TriangleMesh mesh;
  mesh.points.resize(bytes / sizeof(Vec3));
  LobeSurface surface;
  surface.mesh = std::make_shared<const TriangleMesh>(std::move(mesh));
  Snapshot snapshot;
  snapshot.model.surfaces =
      std::make_shared<const std::vector<LobeSurface>>(std::vector{std::move(surface)});
  return snapshot;
}

TEST(HeldBytes, CountsWhatIsSharedOnce) {
  const Snapshot a = holding(2400);
  const Snapshot b = holding(4800);
  Snapshot both = b;
  both.model.wholeLungs = a.model.surfaces;
  const std::vector<const Snapshot*> others = {&b, &both, &a};
  EXPECT_EQ(heldBytes(a, others), 4800U) << "what is shown is held anyway";
  EXPECT_EQ(heldBytes(Snapshot(), others), 7200U);
}

TEST(HeldBytes, KeepsTheNearestStepsAndAlwaysOne) {
  const Snapshot a = holding(2400);
  const Snapshot b = holding(2400);
  const Snapshot c = holding(2400);
  const Snapshot shown;
  const std::vector<const Snapshot*> steps = {&a, &a, &b, &c};
  EXPECT_EQ(keptWithin(7200, shown, steps), 4U);
  EXPECT_EQ(keptWithin(7199, shown, steps), 3U);
  EXPECT_EQ(keptWithin(2400, shown, steps), 2U) << "the second holds nothing of its own";
  EXPECT_EQ(keptWithin(0, shown, steps), 1U);
  EXPECT_EQ(keptWithin(0, shown, {}), 0U);
}

class UndoTest : public ::testing::Test {
 protected:
  void openLungs(Document& document) const {
    write("right.stl", -75.0);
    write("left.stl", 75.0);
    document.open({folder.path().toStdString()});
    ASSERT_TRUE(idle(document));
  }

  void write(const char* name, double x) const {
    writeSurface(std::filesystem::path(folder.path().toStdString()) / name,
                 test::ellipsoid(Vec3(x, 0.0, 0.0), Vec3(55.0, 80.0, 115.0)));
  }

  static bool idle(const Document& document) {
    return QTest::qWaitFor([&] { return !document.jobs().busy(); }, 300000);
  }

  static void smooth(Document& document, double smoothness) {
    LobeEdits edits = document.snapshot().lobeEdits;
    edits.options.smoothness = smoothness;
    document.setLobeEdits(edits, QStringLiteral("smoothness %1").arg(smoothness));
    ASSERT_TRUE(idle(document));
  }

  static double smoothness(const Document& document) {
    return document.snapshot().lobeEdits.options.smoothness;
  }

  void saveAndOpen(Document& document, Document& again) const {
    const QTemporaryDir other;
    const auto file = std::filesystem::path(other.path().toStdString()) / "case.pneuma";
    document.saveProject(file, CtStorage::Linked, Json::object(), {});
    ASSERT_TRUE(idle(document));
    const QSignalSpy failed(&again, &Document::failed);
    again.open({file});
    ASSERT_TRUE(idle(again));
    ASSERT_EQ(failed.count(), 0);
    EXPECT_FALSE(again.modified());
  }

  QTemporaryDir folder;
};

TEST_F(UndoTest, AHundredStepsAreKeptAndComeBackByTheirNames) {
  Document document;
  openLungs(document);
  for (int i = 1; i <= 103; ++i) smooth(document, 0.001 * i);
  Document again;
  saveAndOpen(document, again);
  for (Document* one : {&document, &again}) {
    for (int i = 103; i > 3; --i) {
      ASSERT_TRUE(one->canUndo()) << i;
      EXPECT_EQ(one->undoName(), QStringLiteral("smoothness %1").arg(0.001 * i));
      one->undo();
      EXPECT_NEAR(smoothness(*one), 0.001 * (i - 1), 1e-12);
    }
    EXPECT_FALSE(one->canUndo());
  }
}

TEST_F(UndoTest, WhatWasUndoneCanBeDoneAgainAfterReopening) {
  Document document;
  openLungs(document);
  document.splitLobes();
  ASSERT_TRUE(idle(document));
  smooth(document, 0.25);
  smooth(document, 0.5);
  const auto last = document.model().lobes->lobeMm3;
  document.undo();
  const auto middle = document.model().lobes->lobeMm3;
  document.undo();
  const auto first = document.model().lobes->lobeMm3;
  Document again;
  saveAndOpen(document, again);
  EXPECT_EQ(again.model().lobes->lobeMm3, first);
  EXPECT_EQ(again.redoName(), "smoothness 0.25");
  again.redo();
  EXPECT_EQ(again.model().lobes->lobeMm3, middle);
  EXPECT_EQ(again.redoName(), "smoothness 0.5");
  again.redo();
  EXPECT_EQ(again.model().lobes->lobeMm3, last);
  EXPECT_FALSE(again.canRedo());
  EXPECT_TRUE(again.modified());
  // And back through all of it.
  again.undo();
  again.undo();
  EXPECT_EQ(again.undoName(), document.undoName());
  EXPECT_EQ(again.model().lobes->lobeMm3, first);
  // Another step takes what could be done again away, for the file too.
  smooth(again, 0.75);
  Document third;
  saveAndOpen(again, third);
  EXPECT_FALSE(third.canRedo());
}

TEST_F(UndoTest, AProjectOfLittleHistoryHasTheNearestSteps) {
  Document document;
  openLungs(document);
  document.splitLobes();
  ASSERT_TRUE(idle(document));
  for (int i = 1; i <= 4; ++i) smooth(document, 0.1 * i);
  document.undo();
  document.undo();
  const Project all = document.projectNow();
  EXPECT_EQ(all.undo.size(), 4U);  // opening, splitting, two edits
  ASSERT_EQ(all.redo.size(), 2U);
  EXPECT_EQ(all.redo.front().name, "smoothness 0.3");
  const Project one = document.projectNow(0);
  EXPECT_TRUE(one.redo.empty());
  ASSERT_EQ(one.undo.size(), 1U);
  EXPECT_EQ(one.undo.front().name, "smoothness 0.2");
}

}  // namespace
}  // namespace pneuma
