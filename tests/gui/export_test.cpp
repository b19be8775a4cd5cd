// Exporting from the document: what is there, what is missing, what is replaced.
#include <QSignalSpy>
#include <QTemporaryDir>
#include <QTest>
#include <cmath>

#include <gtest/gtest.h>

#include "document/document.h"
#include "document/export_list.h"
#include "growth/centroid_splitting.h"
#include "io/atomic_file.h"
#include "io/tree_file.h"
#include "views/case_export.h"

namespace pneuma {
namespace {

namespace fs = std::filesystem;

class ExportTest : public ::testing::Test {
 protected:
  void wait() {
    ASSERT_TRUE(QTest::qWaitFor([this] { return !document.jobs().busy(); }, 300000));
  }

  bool offers(ExportKind kind) const {
    return exportRows(document.snapshot())[static_cast<std::size_t>(kind)].lack.isEmpty();
  }

  fs::path at(const char* name) const { return fs::path(folder.path().toStdString()) / name; }

  std::size_t filesIn(const fs::path& where) const {
    return static_cast<std::size_t>(
        std::distance(fs::directory_iterator(where), fs::directory_iterator{}));
  }

  QTemporaryDir folder;
  Document document;
  QSignalSpy failed{&document, &Document::failed};
};

TEST_F(ExportTest, OffersWhatTheCaseHas) {
  for (int kind = 0; kind < ExportKinds; ++kind) {
    EXPECT_FALSE(offers(static_cast<ExportKind>(kind))) << kind;
  }
  document.openSample();
  wait();
  EXPECT_TRUE(offers(ExportKind::Paraview));
  EXPECT_TRUE(offers(ExportKind::Print));
  EXPECT_FALSE(offers(ExportKind::Segmentation));
  EXPECT_TRUE(offers(ExportKind::Tree));
  EXPECT_TRUE(offers(ExportKind::Figure));
  EXPECT_TRUE(offers(ExportKind::Report));
  document.openOrgan("sphere");
  wait();
  EXPECT_FALSE(offers(ExportKind::Print));
  EXPECT_TRUE(offers(ExportKind::Tree));
}

TEST_F(ExportTest, WritesEveryFileOfAPreset) {
  document.openSample();
  wait();
  document.exportCase(ExportPreset::Print, at("print"));
  wait();
  document.exportCase(ExportPreset::Tree, at("tree"));
  wait();
  ASSERT_EQ(failed.count(), 0) << failed.at(0).at(1).toString().toStdString();
  EXPECT_EQ(filesIn(at("print")), 5U);
  EXPECT_EQ(filesIn(at("tree")), 4U);
  for (const char* file : {"tree/tree.vtp", "tree/tree.json"}) {
    EXPECT_EQ(readTree(at(file)).tree.size(), document.tree()->size()) << file;
  }
  EXPECT_TRUE(document.treeSaved());
  EXPECT_EQ(filesIn(at("")), 2U);
}

TEST_F(ExportTest, WritesABreathAsAnimation) {
  document.openSample();
  wait();
  EXPECT_FALSE(offers(ExportKind::Share));
  EXPECT_FALSE(offers(ExportKind::Film));
  EXPECT_TRUE(document.filesInTheWay(ExportPreset::Share, at("share")).empty());
  BreatheOptions options = document.breatheOptions();
  options.periodSeconds = 3.0;
  options.frames = 4;
  document.setBreatheOptions(options);
  document.breathe();
  wait();
  EXPECT_TRUE(offers(ExportKind::Share));
  EXPECT_TRUE(offers(ExportKind::Film));
  document.exportCase(ExportPreset::Share, at("share"));
  wait();
  ASSERT_EQ(failed.count(), 0) << failed.at(0).at(1).toString().toStdString();
  EXPECT_EQ(filesIn(at("share")), 1U);
  const std::string file = readFile(at("share/breath.glb"));
  constexpr std::size_t Head = 20;  // of the file and of its first part
  const Json parts = Json::parse(file.substr(Head, file.find(std::string("BIN\0", 4)) - Head - 4));
  EXPECT_EQ(parts.at("meshes").size(), 7U);  // five lobes, the airways of each lung
  const Json& times =
      parts.at("accessors")
          .at(parts.at("animations").at(0).at("samplers").at(0).at("input").get<std::size_t>());
  EXPECT_EQ(times.at("count"), 5);  // the first moment comes again in the end
  EXPECT_EQ(times.at("max").at(0), 3.0);
  EXPECT_EQ(document.filesInTheWay(ExportPreset::Share, at("share")),
            std::vector<fs::path>{"breath.glb"});
}

TEST_F(ExportTest, RefusesAFilmWhereNothingCanBeDrawn) {
  document.openSample();
  wait();
  document.breathe();
  wait();
  const QByteArray display = qgetenv("DISPLAY");
  qputenv("DISPLAY", ":no-such-display");
  document.exportCase(ExportPreset::Film, at("film"));
  wait();
  if (display.isNull()) {
    qunsetenv("DISPLAY");
  } else {
    qputenv("DISPLAY", display);
  }
  ASSERT_EQ(failed.count(), 1);
  EXPECT_TRUE(failed.at(0).at(1).toString().contains("no picture can be made"))
      << failed.at(0).at(1).toString().toStdString();
  EXPECT_FALSE(fs::exists(at("film")));
  EXPECT_EQ(filesIn(at("")), 0U);
}

TEST(SavedView, IsTheProjectsCameraOrTheFront) {
  const auto view =
      savedView(Json::parse(R"({"camera": {"azimuth_deg": 90, "elevation_deg": 5}})"));
  EXPECT_EQ(view.azimuthDeg, 90.0);
  EXPECT_EQ(view.elevationDeg, 5.0);
  for (const char* text : {"{}", R"({"camera": 3})", R"({"camera": {"azimuth_deg": "left"}})"}) {
    EXPECT_EQ(savedView(Json::parse(text)).azimuthDeg, 0.0) << text;
  }
  const ViewDirection told = toTenths({-0.04, 12.34});
  EXPECT_EQ(told.azimuthDeg, 0.0);
  EXPECT_FALSE(std::signbit(told.azimuthDeg));
  EXPECT_EQ(told.elevationDeg, 12.3);
}

TEST_F(ExportTest, TellsWhatItWouldReplace) {
  document.openSample();
  wait();
  fs::create_directory(at("print"));
  writeFile(at("print/rml.stl"), "mine");
  writeFile(at("print/other.stl"), "mine");
  EXPECT_EQ(document.filesInTheWay(ExportPreset::Print, at("print")),
            std::vector<fs::path>{"rml.stl"});
  EXPECT_TRUE(document.filesInTheWay(ExportPreset::Tree, at("print")).empty());
}

TEST_F(ExportTest, LeavesNothingIfItIsCancelled) {
  document.openSample();
  wait();
  document.breathe();
  wait();
  fs::create_directory(at("there"));
  for (const ExportPreset preset : {ExportPreset::Paraview, ExportPreset::Share}) {
    for (const char* where : {"there", "new"}) {
      document.exportCase(preset, at(where));
      document.jobs().cancel();
      wait();
    }
  }
  EXPECT_EQ(failed.count(), 0);
  // Either nothing, or all of it if it was done before.
  for (const auto& entry : fs::directory_iterator(at(""))) {
    EXPECT_NE(entry.path().filename().string().front(), '.') << entry.path();
  }
}

TEST_F(ExportTest, SaysWhereItCannotWrite) {
  document.openSample();
  wait();
  document.exportCase(ExportPreset::Tree, at("no/such"));
  wait();
  ASSERT_EQ(failed.count(), 1);
  EXPECT_FALSE(failed.at(0).at(1).toString().contains(folder.path()));
  document.saveReport(at("report.txt"), {});
  wait();
  EXPECT_EQ(failed.count(), 2);
}

TEST_F(ExportTest, ATreeThatWasNotGrownIsSavedToo) {
  document.openSample();
  wait();
  document.saveTree(at("tree.vtp"));
  wait();
  EXPECT_EQ(failed.count(), 0);
  EXPECT_EQ(readTree(at("tree.vtp")).metadata.count("method"), 0U);
}

TEST_F(ExportTest, AReportNamesNobodyUnlessItIsAsked) {
  document.openSample();
  wait();
  for (const bool identify : {false, true}) {
    CaseReportOptions options;
    options.identify = identify;
    document.saveReport(at("report.json"), options);
    wait();
    const Json report = Json::parse(readFile(at("report.json")));
    EXPECT_EQ(report.at("case").is_null(), !identify);
    EXPECT_EQ(report.at("volumes").size(), 6U);
  }
}

}  // namespace
}  // namespace pneuma
