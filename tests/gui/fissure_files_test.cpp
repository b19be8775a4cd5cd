#include <QSignalSpy>
#include <QTemporaryDir>
#include <QTest>
#include <fstream>

#include <gtest/gtest.h>

#include "document/fissure_editor.h"
#include "document/lobes_sheet.h"
#include "io/surface_file.h"
#include "render/generated_lungs.h"

// Fissures from files and into them, and what a file can say: weights, angles, surfaces.
namespace pneuma {
namespace {

class FissureFilesTest : public ::testing::Test {
 protected:
  void SetUp() override {
    for (const auto& [name, x] : {std::pair{"right.stl", -75.0}, std::pair{"left.stl", 75.0}}) {
      writeSurface(lungs / name, test::ellipsoid(Vec3(x, 0.0, 0.0), Vec3(55.0, 80.0, 115.0)));
    }
    document.open({lungs});
    ASSERT_TRUE(idle());
    ASSERT_TRUE(editor.available());
    editor.setCurrent(Fissure::RightOblique);
  }

  bool idle() {
    return QTest::qWaitFor([this] { return !document.jobs().busy(); }, 300000);
  }

  std::filesystem::path inFolder(const char* name) const {
    return std::filesystem::path(folder.path().toStdString()) / name;
  }

  QString failure() { return failed.isEmpty() ? QString() : failed.last().at(1).toString(); }

  /// A square about the left lung's middle, lying as z = y; half its side, mm.
  void writeSquare(const char* name, double half) const {
    TriangleMesh mesh;
    for (const auto& [x, y] :
         {std::pair{-1.0, -1.0}, std::pair{1.0, -1.0}, std::pair{1.0, 1.0}, std::pair{-1.0, 1.0}}) {
      mesh.points.emplace_back(75.0 + half * x, half * y, half * y);
    }
    mesh.triangles = {{0, 1, 2}, {0, 2, 3}};
    writeSurface(inFolder(name), mesh);
  }

  QTemporaryDir surfaces;
  std::filesystem::path lungs = surfaces.path().toStdString();
  QTemporaryDir folder;
  Document document;
  FissureEditor editor{document};
  QSignalSpy failed{&document, &Document::failed};
};

TEST_F(FissureFilesTest, WhatIsSavedOpensAsItWasSet) {
  for (const double y : {-50.0, 0.0, 20.0, 50.0}) editor.addPoint({-75.0 + y / 5.0, y, y});
  editor.setWeight(Fissure::RightOblique, 2, 5.0);
  editor.setMethod(Fissure::LeftOblique, FissureMethod::Plane);
  const LobeEdits set = document.snapshot().lobeEdits;
  document.saveFissures(inFolder("all.json"));
  ASSERT_TRUE(idle());
  ASSERT_EQ(failure(), QString());
  for (const Fissure fissure : {Fissure::RightOblique, Fissure::LeftOblique}) {
    editor.setCurrent(fissure);
    editor.clear();
  }
  document.openFissures(inFolder("all.json"));
  ASSERT_TRUE(idle());
  ASSERT_EQ(failure(), QString());
  EXPECT_EQ(editor.edit(Fissure::RightOblique), set.fissures.at(Fissure::RightOblique));
  const FissureEdit& plane = editor.edit(Fissure::LeftOblique);
  ASSERT_EQ(plane.method, FissureMethod::Plane);
  const FissurePlane before = planeThrough(*set.fissures.at(Fissure::LeftOblique).handles);
  for (const Vec3& handle : *plane.handles) {
    EXPECT_NEAR((handle - before.point).dot(before.normal), 0.0, 1e-9);
  }
  EXPECT_EQ(document.undoName(), "open fissures");
  document.undo();
  EXPECT_TRUE(editor.marks().empty());
}

TEST_F(FissureFilesTest, PointsGoToSlicerAndBack) {
  for (const double y : {-50.0, 0.0, 20.0, 50.0}) editor.addPoint({-75.0 + y / 5.0, y, y});
  const std::vector<Vec3> points = editor.points(Fissure::RightOblique);
  for (const char* name : {"points.mrk.json", "points.fcsv", "points.csv"}) {
    document.saveFissures(inFolder(name));
    ASSERT_TRUE(idle());
    editor.clear();
    document.openFissures(inFolder(name));
    ASSERT_TRUE(idle());
    ASSERT_EQ(failure(), QString()) << name;
    const std::vector<Vec3> read = editor.points(Fissure::RightOblique);
    ASSERT_EQ(read.size(), points.size()) << name;
    for (std::size_t i = 0; i < read.size(); ++i) EXPECT_LT((read[i] - points[i]).norm(), 1e-3);
  }
}

TEST_F(FissureFilesTest, WhatAFormatDoesNotHaveIsRefusedInASentence) {
  document.saveFissures(inFolder("none.json"));
  EXPECT_TRUE(failure().contains("No fissure was set"));
  editor.setMethod(Fissure::LeftOblique, FissureMethod::Plane);
  document.saveFissures(inFolder("plane.fcsv"));
  ASSERT_TRUE(idle());
  EXPECT_TRUE(failure().contains("plane"));
  EXPECT_FALSE(std::filesystem::exists(inFolder("plane.fcsv")));
  EXPECT_FALSE(failure().contains(folder.path()));
}

TEST_F(FissureFilesTest, AFileThatIsNoneChangesNothing) {
  std::ofstream(inFolder("bad.json")) << "{\"schema\": \"something else\"}";
  const LobeEdits before = document.snapshot().lobeEdits;
  document.openFissures(inFolder("bad.json"));
  ASSERT_TRUE(idle());
  EXPECT_EQ(failed.count(), 1);
  EXPECT_EQ(document.snapshot().lobeEdits, before);
}

TEST_F(FissureFilesTest, ASurfaceIsTakenAndOneThatEndsInsideIsExtendedWhenAsked) {
  writeSquare("large.stl", 80.0);
  document.openFissureSurface(Fissure::LeftOblique, inFolder("large.stl"));
  ASSERT_TRUE(idle());
  EXPECT_EQ(editor.problem(Fissure::LeftOblique), QString());
  EXPECT_EQ(editor.used(Fissure::LeftOblique).source, FissureSource::Surface);
  EXPECT_EQ(fissureLine(editor, Fissure::LeftOblique), "Surface from a file");

  writeSquare("small.stl", 60.0);
  document.openFissureSurface(Fissure::LeftOblique, inFolder("small.stl"));
  ASSERT_TRUE(idle());
  EXPECT_TRUE(editor.problem(Fissure::LeftOblique).contains("ends inside"));
  ASSERT_TRUE(editor.canExtend(Fissure::LeftOblique));
  editor.extendSurfaces();
  EXPECT_EQ(editor.problem(Fissure::LeftOblique), QString());
  EXPECT_FALSE(editor.canExtend(Fissure::LeftOblique));
  EXPECT_EQ(document.undoName(), "extend a surface");

  writeSquare("tiny.stl", 20.0);  // farther than a surface may be extended
  document.openFissureSurface(Fissure::LeftOblique, inFolder("tiny.stl"));
  ASSERT_TRUE(idle());
  EXPECT_TRUE(editor.problem(Fissure::LeftOblique).contains("ends inside"));
  EXPECT_FALSE(editor.canExtend(Fissure::LeftOblique));
}

TEST_F(FissureFilesTest, APlaneLiesAsItsAnglesSayAboutTheMiddleOfItsHandles) {
  editor.setMethod(Fissure::RightOblique, FissureMethod::Plane);
  const Vec3 middle = planeThrough(*editor.edit(Fissure::RightOblique).handles).point;
  editor.setAngles(Fissure::RightOblique, {50.0, -10.0});
  const std::array<Vec3, 3> handles = *editor.edit(Fissure::RightOblique).handles;
  EXPECT_NEAR(anglesOf(handles).tiltDeg, 50.0, 1e-6);
  EXPECT_NEAR(anglesOf(handles).turnDeg, -10.0, 1e-6);
  EXPECT_LT((planeThrough(handles).point - middle).norm(), 1e-9);
  // Tilted, the back edge is higher.
  const HeightSurface& surface = editor.preview(Side::Right)->surface(Fissure::RightOblique);
  EXPECT_GT(surface.height(middle - Vec3(0.0, 30.0, 0.0)), 15.0);
  EXPECT_EQ(document.undoName(), "turn a plane");
}

TEST_F(FissureFilesTest, AHeavierPointHoldsTheFissure) {
  for (const double x : {-95.0, -55.0}) {
    for (const double y : {-50.0, 0.0, 50.0}) editor.addPoint({x, y, y});
  }
  editor.addPoint({-75.0, 5.0, 25.0});
  editor.dragSmoothness(1.0);
  editor.release();
  const auto away = [&] {
    return std::abs(
        editor.preview(Side::Right)->surface(Fissure::RightOblique).distance({-75.0, 5.0, 25.0}));
  };
  const double before = away();
  editor.setWeight(Fissure::RightOblique, 6, 50.0);
  EXPECT_LT(away(), 0.5 * before);
  EXPECT_EQ(document.undoName(), "weigh a point");
  EXPECT_TRUE(fissurePointLines(editor, Fissure::RightOblique)[6].contains("x50"));
  editor.removePoint(Fissure::RightOblique, 0);
  EXPECT_EQ(editor.edit(Fissure::RightOblique).weights[5], 50.0);
}

}  // namespace
}  // namespace pneuma
