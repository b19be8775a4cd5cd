#include "document/review_walk.h"

#include <QSignalSpy>
#include <QTemporaryDir>
#include <QTest>

#include <gtest/gtest.h>

#include "io/surface_file.h"
#include "pipeline/review_stations.h"
#include "render/generated_lungs.h"

namespace pneuma {
namespace {

/// Two lungs, and slices in which to look at them.
class ReviewWalkTest : public ::testing::Test {
 protected:
  void SetUp() override {
    write("right.stl", -75.0);
    write("left.stl", 75.0);
    document.open({folder.path().toStdString()});
    ASSERT_TRUE(QTest::qWaitFor([this] { return !document.jobs().busy(); }, 300000));
    ASSERT_TRUE(editor.available());
    auto ct = std::make_shared<CtImage>();
    ct->geometry.size = {70, 40, 60};
    ct->geometry.spacing = Vec3(4.0, 4.0, 4.0);
    ct->geometry.origin = Vec3(-140.0, -80.0, -120.0);
    ct->voxels.assign(ct->geometry.voxelCount(), -850);
    slices.show(ct, nullptr);
  }

  void write(const char* name, double x) const {
    writeSurface(std::filesystem::path(folder.path().toStdString()) / name,
                 test::ellipsoid(Vec3(x, 0.0, 0.0), Vec3(55.0, 80.0, 115.0)));
  }

  void passAll() {
    const Fissure fissure = walk.fissure();
    for (std::size_t i = 0; i < StationsPerFissure; ++i) {
      if (walk.active() && walk.fissure() == fissure) walk.looksRight();
    }
  }

  QTemporaryDir folder;
  Document document;
  FissureEditor editor{document};
  SliceViews slices;
  ReviewWalk walk{document, editor, slices};
};

TEST_F(ReviewWalkTest, LeadsThroughEveryFissureAndThenIsComplete) {
  EXPECT_FALSE(walk.active());
  walk.start();
  ASSERT_TRUE(walk.active());
  EXPECT_EQ(walk.stations(), StationsPerFissure);
  EXPECT_EQ(walk.fissure(), editor.current());
  const Vec3 first = slices.point();
  EXPECT_LT(std::abs(editor.preview(Side::Left)->surface(Fissure::LeftOblique).distance(first)),
            4.0);
  walk.looksRight();
  EXPECT_EQ(walk.station(), 1U);
  EXPECT_GT(slices.point().x(), first.x());
  EXPECT_FALSE(document.reviewed(Fissure::LeftOblique));
  passAll();
  EXPECT_TRUE(document.reviewed(Fissure::LeftOblique));
  EXPECT_FALSE(walk.complete());
  EXPECT_EQ(walk.fissure(), Fissure::RightOblique);
  passAll();
  passAll();
  EXPECT_TRUE(walk.complete());
  EXPECT_FALSE(walk.active());
  EXPECT_FALSE(document.snapshot().reviews.at(Fissure::RightOblique).skipped);
  document.undo();
  EXPECT_FALSE(walk.complete());
}

TEST_F(ReviewWalkTest, AnEditTakesTheReviewOfItsFissureBackAlone) {
  walk.accept();
  EXPECT_TRUE(walk.complete());
  EXPECT_TRUE(document.snapshot().reviews.at(Fissure::LeftOblique).skipped);
  editor.setMethod(Fissure::RightOblique, FissureMethod::Plane);
  EXPECT_FALSE(document.reviewed(Fissure::RightOblique));
  EXPECT_TRUE(document.reviewed(Fissure::LeftOblique));
  document.undo();
  EXPECT_TRUE(walk.complete());
}

TEST_F(ReviewWalkTest, EditingHereGoesOnAtTheSamePlaceAndWhatMovedIsSeenAgain) {
  editor.setMethod(Fissure::LeftOblique, FissureMethod::Plane);
  walk.start();
  for (int i = 0; i < 6; ++i) walk.looksRight();
  walk.editHere();
  EXPECT_FALSE(walk.active());
  walk.start();
  EXPECT_EQ(walk.station(), 6U);
  walk.editHere();
  // The plane is tilted about its middle: stations near the axis stay, those far out move.
  const PlaneAngles angles = anglesOf(*editor.edit(Fissure::LeftOblique).handles);
  editor.setAngles(Fissure::LeftOblique, {angles.tiltDeg, angles.turnDeg + 6.0});
  walk.start();
  ASSERT_TRUE(walk.active());
  EXPECT_EQ(walk.station(), 0U);
  EXPECT_LT(walk.passed(), 6U);
  EXPECT_GT(walk.passed(), 0U);
}

TEST_F(ReviewWalkTest, OtherLungsEndIt) {
  walk.start();
  write("right.stl", -80.0);
  document.open({folder.path().toStdString()});
  ASSERT_TRUE(QTest::qWaitFor([this] { return !document.jobs().busy(); }, 300000));
  EXPECT_FALSE(walk.active());
  EXPECT_EQ(walk.stations(), 0U);
}

}  // namespace
}  // namespace pneuma
