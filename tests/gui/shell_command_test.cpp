// Commands to copy: options that differ from the defaults, words that a shell takes as they are.
#include "document/shell_command.h"

#include <QTemporaryDir>
#include <QTest>

#include <gtest/gtest.h>

#include "document/document.h"
#include "growth/centroid_splitting.h"
#include "growth/kitaoka.h"
#include "io/surface_file.h"
#include "io/tree_file.h"
#include "pipeline/sample_chest.h"

namespace pneuma {
namespace {

namespace fs = std::filesystem;

class ShellCommandTest : public ::testing::Test {
 protected:
  void wait() {
    ASSERT_TRUE(QTest::qWaitFor([this] { return !document.jobs().busy(); }, 300000));
  }

  std::string text(WorkStep step, const ExportWish& wish = {}) const {
    const ShellCommand command = shellCommand(step, document, wish);
    EXPECT_EQ(command.obstacle.toStdString(), "");
    return command.text().toStdString();
  }

  std::string obstacle(WorkStep step, const ExportWish& wish = {}) const {
    const ShellCommand command = shellCommand(step, document, wish);
    EXPECT_TRUE(command.lines.isEmpty()) << command.text().toStdString();
    return command.obstacle.toStdString();
  }

  /// Two lobes and central airways in files, opened.
  void openFilesOfTheSample() {
    const SampleChest sample = sampleChest(6.0);
    writeSurface(at("rul.vtp"), *sample.lobes[0].mesh);
    writeSurface(at("it's lll.vtp"), *sample.lobes[4].mesh);
    writeTree(at("central.swc"), sample.central);
    document.open({at("rul.vtp"), at("it's lll.vtp"), at("central.swc")});
    wait();
    ASSERT_TRUE(document.canGrow());
  }

  fs::path at(const char* name) const { return fs::path(folder.path().toStdString()) / name; }

  std::string inFolder(const char* name) const { return at(name).string(); }

  QTemporaryDir folder;
  Document document;
};

TEST(ShellWord, IsQuotedWhereAShellWouldReadItOtherwise) {
  EXPECT_EQ(shellWord("/data/rul.stl"), "/data/rul.stl");
  EXPECT_EQ(shellWord("60,-20,-150,15=5"), "60,-20,-150,15=5");
  EXPECT_EQ(shellWord(""), "''");
  EXPECT_EQ(shellWord("two words"), "'two words'");
  EXPECT_EQ(shellWord("$(rm) `x` \"y\""), "'$(rm) `x` \"y\"'");
  EXPECT_EQ(shellWord("it's"), "'it'\\''s'");
  EXPECT_EQ(shellWord("a\nb"), "'a\nb'");
  EXPECT_EQ(shellWord("~"), "'~'");
  EXPECT_EQ(shellWord("l\xc3\xbcng"), QString::fromUtf8("'l\xc3\xbcng'"));
}

TEST_F(ShellCommandTest, NothingIsOpen) {
  for (const WorkStep step : {WorkStep::Open, WorkStep::Lungs, WorkStep::Lobes, WorkStep::Airways,
                              WorkStep::Breathing, WorkStep::Export}) {
    EXPECT_NE(obstacle(step), "");
  }
}

TEST_F(ShellCommandTest, ASampleIsMadeFirst) {
  document.openSample();
  wait();
  const std::string sample = "pneuma sample chest --format vtp";
  EXPECT_EQ(text(WorkStep::Open), sample);
  EXPECT_EQ(text(WorkStep::Airways),
            sample + "\npneuma grow chest --central chest/central.vtp -o tree.vtp");
  EXPECT_EQ(text(WorkStep::Breathing), sample + "\npneuma breathe chest -o breath.pvd");
  EXPECT_NE(text(WorkStep::Export, {ExportKind::Print, false, {}, "ply"}).find("--as ply"),
            std::string::npos);
  EXPECT_EQ(text(WorkStep::Export, {ExportKind::Print, false, {}, "stl"}),
            text(WorkStep::Export, {ExportKind::Print, false, {}}));
  EXPECT_EQ(text(WorkStep::Export, {ExportKind::Print, false, {}}),
            sample + "\npneuma export chest --preset print -o print");
  EXPECT_NE(obstacle(WorkStep::Lungs), "");
}

TEST_F(ShellCommandTest, AnOrganIsNamed) {
  document.openOrgan("sphere");
  wait();
  CentroidSplittingOptions options;
  options.terminals = 300;
  document.setGrowthOptions(options);
  EXPECT_EQ(text(WorkStep::Airways),
            "pneuma grow --organ sphere --method centroid --set terminals=300 -o tree.vtp");
  EXPECT_NE(obstacle(WorkStep::Breathing), "");
  EXPECT_NE(obstacle(WorkStep::Export, {ExportKind::Print, false, {}}), "");
}

TEST_F(ShellCommandTest, FilesAreNamedAsTheyWereOpened) {
  openFilesOfTheSample();
  const std::string quoted = "'" + folder.path().toStdString() + "/it'\\''s lll.vtp'";
  const std::string lobes = inFolder("rul.vtp") + " " + quoted;
  EXPECT_EQ(text(WorkStep::Airways),
            "pneuma grow " + lobes + " --central " + inFolder("central.swc") + " -o tree.vtp");
  EXPECT_EQ(text(WorkStep::Export, {ExportKind::Tree, false, {}}),
            "pneuma export " + lobes + " " + inFolder("central.swc") + " --preset tree -o tree");
  EXPECT_EQ(text(WorkStep::Export, {ExportKind::Report, true, {}}),
            "pneuma report " + lobes + " " + inFolder("central.swc") + " --identify -o report.pdf");
  EXPECT_EQ(
      text(WorkStep::Export, {ExportKind::Figure, false, {-10.0, 6.0}}),
      "pneuma render " + lobes + " " + inFolder("central.swc") + " --view=-10,6 -o figure.png");
}

TEST_F(ShellCommandTest, OptionsThatDifferAreTold) {
  openFilesOfTheSample();
  KitaokaOptions kitaoka;
  kitaoka.terminals = 150;
  document.setGrowthOptions(kitaoka);
  const std::string grow = text(WorkStep::Airways);
  EXPECT_NE(grow.find(" --set terminals=150 -o tree.vtp"), std::string::npos) << grow;
  EXPECT_EQ(grow.find("--method"), std::string::npos) << grow;

  document.setRegions({{Lobe::RightUpper, Vec3::Zero(), 0.0, 0.5},
                       {Lobe::Whole, Vec3(-60.5, 20.0, -150.0), 15.0, 5.0}},
                      "place");
  BreatheOptions breathe = document.breatheOptions();
  breathe.scenario = Breathing::VitalCapacity;
  breathe.tidalMl = 1200.5;
  document.setBreatheOptions(breathe);
  const std::string breath = text(WorkStep::Breathing);
  EXPECT_NE(breath.find(" --scenario vital-capacity --tidal 1200.5 --stiffness RUL=0.5 "
                        "--stiffness=-60.5,20,-150,15=5 -o breath.pvd"),
            std::string::npos)
      << breath;
}

TEST_F(ShellCommandTest, WorkThatIsInNoFileIsSavedFirst) {
  openFilesOfTheSample();
  CentroidSplittingOptions options;
  options.terminals = 100;
  document.setGrowthOptions(options);
  document.grow();
  wait();
  EXPECT_NE(obstacle(WorkStep::Export), "");
  // The breath takes the tree that its own command grows before.
  const ShellCommand breath = shellCommand(WorkStep::Breathing, document);
  ASSERT_EQ(breath.lines.size(), 2);
  EXPECT_TRUE(breath.lines[0].startsWith("pneuma grow "));
  EXPECT_TRUE(breath.lines[1].contains(" tree.vtp "));

  document.saveProject(at("case.pneuma"), CtStorage::Linked, Json::object(), {});
  wait();
  const std::string project = inFolder("case.pneuma");
  EXPECT_EQ(text(WorkStep::Export), "pneuma export " + project + " --preset paraview -o paraview");
  EXPECT_EQ(text(WorkStep::Airways),
            "pneuma grow " + project + " --method centroid --set terminals=100 -o tree.vtp");
  EXPECT_EQ(text(WorkStep::Open), "pneuma info " + project);
  document.undo();
  EXPECT_NE(obstacle(WorkStep::Airways), "");
}

TEST_F(ShellCommandTest, AFilmIsDrawnFromWhereOneLooks) {
  document.openSample();
  wait();
  EXPECT_NE(obstacle(WorkStep::Export, {ExportKind::Film, false, {}}), "");
  document.breathe();
  wait();
  EXPECT_NE(obstacle(WorkStep::Export, {ExportKind::Share, false, {}}), "");
  document.saveProject(at("case.pneuma"), CtStorage::Linked, Json::object(), {});
  wait();
  const std::string start = "pneuma export " + inFolder("case.pneuma") + " --preset ";
  EXPECT_EQ(text(WorkStep::Export, {ExportKind::Share, false, {}}), start + "share -o share");
  EXPECT_EQ(text(WorkStep::Export, {ExportKind::Film, false, {-10.04, 6.0}}),
            start + "film --view=-10,6 -o film");
}

}  // namespace
}  // namespace pneuma
