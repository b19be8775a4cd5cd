#include <QSignalSpy>
#include <QTemporaryDir>
#include <QTest>

#include <gtest/gtest.h>

#include "breathing/motion_form.h"
#include "document/breath_player.h"
#include "document/document.h"
#include "document/region_editor.h"
#include "document/shell_command.h"
#include "geometry/test_surfaces.h"
#include "io/atomic_file.h"
#include "io/surface_file.h"
#include "pipeline/breath_curve.h"
#include "pipeline/person_motion.h"

namespace pneuma {
namespace {

namespace fs = std::filesystem;

/// A document of two ellipsoids of 2.5 and 2.2 l for lungs.
class BreathingTest : public ::testing::Test {
 protected:
  void SetUp() override {
    writeLung("right.stl", -75.0, 120.0);
    writeLung("left.stl", 75.0, 105.0);
    document.open({fs::path(folder.path().toStdString())});
    ASSERT_TRUE(idle());
    ASSERT_EQ(failed.count(), 0) << failed.at(0).at(1).toString().toStdString();
  }

  void writeLung(const char* name, double x, double half) const {
    TriangleMesh mesh = testing::sphere(1.0, Vec3::Zero(), 4);
    for (Vec3& p : mesh.points) p = Vec3(x, 0.0, 0.0) + p.cwiseProduct(Vec3(58.0, 85.0, half));
    writeSurface(fs::path(folder.path().toStdString()) / name, mesh);
  }

  bool idle() {
    return QTest::qWaitFor([this] { return !document.jobs().busy(); }, 60000);
  }

  void breathe() {
    document.breathe();
    EXPECT_TRUE(document.breathing());
    ASSERT_TRUE(idle());
    ASSERT_EQ(failed.count(), 0) << failed.at(0).at(1).toString().toStdString();
    ASSERT_NE(document.snapshot().breath, nullptr);
    EXPECT_FALSE(document.breathing());
  }

  QTemporaryDir folder;
  Document document;
  QSignalSpy failed{&document, &Document::failed};
};

TEST_F(BreathingTest, BreathesAndTakesItBack) {
  ASSERT_TRUE(document.canBreathe());
  breathe();
  const Breath& breath = *document.snapshot().breath;
  EXPECT_NEAR(1000.0 * breath.lungs.cycle.tidal, 500.0, 5.0);
  EXPECT_GT(breath.farthestMm, 2.0);
  EXPECT_FALSE(document.breathOutOfDate());
  BreatheOptions options = document.breatheOptions();
  options.tidalMl = 300.0;
  document.setBreatheOptions(options);
  EXPECT_TRUE(document.breathOutOfDate());
  document.undo();
  EXPECT_EQ(document.snapshot().breath, nullptr);
}

TEST_F(BreathingTest, VolumesAtAnyMomentAreTheCurves) {
  breathe();
  const Breath& breath = *document.snapshot().breath;
  for (const double phase : {0.0, 0.13, 0.4, 0.77, 1.2}) {
    const BreathScale scale = scaleAt(breath, phase);
    double sum = 0.0;
    for (const MovingSurface& surface : breath.lungs.surfaces) {
      sum += signedVolumeMm3(surfaceAt(surface, scale.of(surface.side))) / 1000.0;
    }
    EXPECT_NEAR(sum, volumeMlAt(breath, phase), 1e-3) << phase;
    double rest = 0.0;
    for (const auto& [side, volume] : breath.lungs.volume) rest += volume.a[0] / 1000.0;
    EXPECT_NEAR(sum - rest, 1000.0 * breath.lungs.cycle.at(phase).volume, 1e-3) << phase;
  }
}

TEST_F(BreathingTest, ABreathOfOneFrameMovesToo) {
  BreatheOptions options;
  options.frames = 1;
  document.setBreatheOptions(options);
  breathe();
  const Breath& breath = *document.snapshot().breath;
  const double full = fullestPhase(breath.lungs);
  EXPECT_NEAR(volumeMlAt(breath, full) - volumeMlAt(breath, 0.0), 1000.0 * breath.lungs.cycle.tidal,
              1.0);
  EXPECT_GT(scaleAt(breath, full).right, 0.9);
  EXPECT_GT(breath.farthestMm, 2.0);
}

TEST_F(BreathingTest, ShowsTheChestWallOfAPneumothoraxAndTheEndsOfTheBreath) {
  using Of = BreathingScene::Shell::Of;
  breathe();
  const auto count = [&](Of of) {
    return std::ranges::count(document.snapshot().breath->scenes[0]->shells, of,
                              &BreathingScene::Shell::of);
  };
  EXPECT_EQ(count(Of::ChestWall), 0);
  EXPECT_EQ(count(Of::Expiration), 2);
  EXPECT_EQ(count(Of::Inspiration), 2);
  BreatheOptions options;
  options.scenario = Breathing::Pneumothorax;
  document.setBreatheOptions(options);
  breathe();
  EXPECT_EQ(count(Of::ChestWall), 1);
  const Breath& breath = *document.snapshot().breath;
  EXPECT_GT(scaleAt(breath, fullestPhase(breath.lungs)).chestWall, 0.9);
  const auto& rows = breathSheet(breath).rows;
  EXPECT_TRUE(
      std::ranges::any_of(rows, [](const PropertyRow& row) { return row.label == "Pleural gap"; }));
}

TEST_F(BreathingTest, BallsArePlacedChangedRemovedAndTakenBack) {
  using Placing = RegionEditor::Placing;
  RegionEditor editor(document);
  const Vec3 place(-133.0, 0.0, 0.0);
  editor.placeAt(Lobe::RightLung, place);
  EXPECT_TRUE(editor.regions().empty()) << "clicks place nothing until they shall";
  editor.setPlacing(Placing::Lobe);
  editor.placeAt(Lobe::RightLung, place);
  EXPECT_TRUE(editor.regions().empty()) << "a whole lung has no lobes";
  editor.setPlacing(Placing::Ball);
  editor.setFactor(8.0);
  editor.setRadius(25.0);
  editor.placeAt(Lobe::RightLung, place);
  ASSERT_EQ(editor.regions().size(), 1U);
  EXPECT_EQ(editor.regions()[0], (StiffnessRegion{Lobe::Whole, place, 25.0, 8.0}));
  EXPECT_EQ(document.breatheOptions().regions, editor.regions());
  ASSERT_EQ(editor.balls().size(), 1U);
  EXPECT_TRUE(editor.balls()[0].chosen && editor.balls()[0].stiff);
  editor.setFactor(0.5);
  EXPECT_EQ(editor.regions()[0].factor, 0.5);
  breathe();
  EXPECT_EQ(editor.balls()[0].side, Side::Right);
  EXPECT_GT(editor.balls()[0].displacement.norm(), 0.1);
  document.undo();
  document.undo();
  EXPECT_EQ(editor.regions()[0].factor, 8.0);
  EXPECT_EQ(document.breatheOptions().regions[0].factor, 8.0);
  document.undo();
  EXPECT_TRUE(editor.regions().empty());
  EXPECT_TRUE(document.breatheOptions().regions.empty());
  document.redo();
  editor.choose(0);
  editor.removeChosen();
  EXPECT_TRUE(editor.regions().empty());
}

TEST_F(BreathingTest, AMeasuredBreathIsFittedAndGivenUpAgain) {
  breathe();
  const fs::path table = fs::path(folder.path().toStdString()) / "measured.csv";
  BreatheOptions small;
  small.tidalMl = 300.0;
  const BreathCycle& quiet = document.snapshot().breath->lungs.cycle;
  writeFile(table, breathCurveCsv(quiet));
  document.setBreatheOptions(small);
  document.openMeasuredBreath(table);
  ASSERT_TRUE(idle());
  ASSERT_EQ(failed.count(), 0) << failed.at(0).at(1).toString().toStdString();
  ASSERT_NE(document.breatheOptions().fit, nullptr);
  EXPECT_NEAR(document.breatheOptions().fit->tidal, quiet.tidal, 1e-3 * quiet.tidal);
  EXPECT_EQ(document.breatheOptions().tidalMl, 0.0) << "the measured breath has its own";
  breathe();
  const Json& report = document.snapshot().breath->report;
  EXPECT_TRUE(report.contains("fit"));
  EXPECT_EQ(report.at("inputs").back().at("path"), table.string());
  document.forgetMeasuredBreath();
  EXPECT_EQ(document.breatheOptions().fit, nullptr);
  EXPECT_TRUE(document.breathOutOfDate());
  writeFile(table, "seconds,pressure_cmH2O,volume_ml\n0,1,2\n", Existing::Replace);
  document.openMeasuredBreath(table);
  ASSERT_TRUE(idle());
  EXPECT_EQ(failed.count(), 1);
  EXPECT_EQ(document.breatheOptions().fit, nullptr);
}

TEST_F(BreathingTest, MovesByThePersonsOwnConstants) {
  breathe();
  const Json before = document.snapshot().breath->report;
  Json person = {{"schema", "pneuma/estimate/1"},
                 {"form", "deep"},
                 {"landmarks", {{"fitted", 40}, {"held_out", 0}}},
                 {"constants", Json::array()},
                 {"errors", Json::array()},
                 {"lungs", Json::array()}};
  for (const double value : constantsOf(evenForm(), FormKind::Deep)) {
    person["constants"].push_back({{"value", value}});
  }
  const fs::path file = fs::path(folder.path().toStdString()) / "person.json";
  writeFile(file, person.dump());
  document.openConstants(file);
  ASSERT_TRUE(idle());
  ASSERT_EQ(failed.count(), 0) << failed.at(0).at(1).toString().toStdString();
  ASSERT_NE(document.breatheOptions().person, nullptr);
  EXPECT_EQ(document.breatheOptions().person->name, "'person.json'") << "no folder is shown";
  EXPECT_TRUE(document.breathOutOfDate());
  breathe();
  const Json& report = document.snapshot().breath->report;
  EXPECT_NE(report.at("basis"), before.at("basis"));
  EXPECT_EQ(report.at("inputs").back().at("path"), file.string());
  EXPECT_TRUE(shellCommand(WorkStep::Breathing, document)
                  .text()
                  .contains(QString::fromStdString("--constants " + file.string())));
  document.forgetConstants();
  EXPECT_EQ(document.breatheOptions().person, nullptr);
}

TEST_F(BreathingTest, ScenesHaveAMotionForEverySurface) {
  breathe();
  const Breath& breath = *document.snapshot().breath;
  ASSERT_EQ(breath.surfaces.size(), 2U);
  for (const auto& scene : breath.scenes) {
    ASSERT_EQ(scene->surfaces.size(), 2U);
    for (std::size_t i = 0; i < 2; ++i) {
      EXPECT_EQ(scene->surfaces[i].displacement.size(), breath.surfaces[i].mesh->points.size());
    }
  }
  EXPECT_TRUE(breath.scenes[0]->surfaces[0].values.empty());
  EXPECT_FALSE(breath.scenes[1]->surfaces[0].values.empty());
  EXPECT_FALSE(breath.scenes[2]->surfaces[0].values.empty());
}

TEST_F(BreathingTest, ABreathThatFoldsIsRefusedAndNothingChanges) {
  BreatheOptions options;
  options.tidalMl = 9999.0;
  document.setBreatheOptions(options);
  document.breathe();
  ASSERT_TRUE(idle());
  ASSERT_EQ(failed.count(), 1);
  EXPECT_EQ(document.snapshot().breath, nullptr);
  EXPECT_FALSE(document.breathing());
}

TEST_F(BreathingTest, SavesABreathForParaView) {
  breathe();
  const fs::path pvd = fs::path(folder.path().toStdString()) / "breath.pvd";
  document.saveBreath(pvd);
  ASSERT_TRUE(idle());
  EXPECT_EQ(failed.count(), 0);
  EXPECT_TRUE(fs::exists(pvd));
  EXPECT_TRUE(fs::exists(pvd.parent_path() / "breath_0019.vtp"));
}

TEST_F(BreathingTest, ThePlayerGoesOnWithTheClockAndRoundAndRound) {
  breathe();
  BreathPlayer player;
  player.setPlaying(true);
  EXPECT_FALSE(player.playing()) << "there is nothing to play";
  player.setBreath(document.snapshot().breath);
  QSignalSpy moved(&player, &BreathPlayer::moved);
  player.setSpeed(4.0);
  player.setPlaying(true);
  EXPECT_TRUE(QTest::qWaitFor([&] { return player.phase() > 0.1; }, 5000));
  EXPECT_GT(moved.count(), 2);
  player.setPlaying(false);
  player.setPhase(3.25);
  EXPECT_NEAR(player.phase(), 0.25, 1e-12);
  player.step(1);
  EXPECT_NEAR(player.phase(), 0.3, 1e-12);
  player.setPhase(0.0);
  player.step(-1);
  EXPECT_NEAR(player.phase(), 0.95, 1e-12);
  player.setPlaying(true);
  player.setBreath(nullptr);
  EXPECT_FALSE(player.playing());
}

}  // namespace
}  // namespace pneuma
