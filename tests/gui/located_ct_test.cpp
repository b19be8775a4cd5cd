// A project whose CT moved: it opens without, and has it again once it is found.
#include <QTemporaryDir>
#include <QTest>
#include <fstream>

#include <gtest/gtest.h>

#include "document/document.h"
#include "io/ct_file.h"
#include "io/volume_file.h"
#include "pipeline/lobes_model.h"
#include "render/generated_chest.h"
#include "support/dicom_maker.h"

namespace pneuma {
namespace {

namespace fs = std::filesystem;

class LocatedCtTest : public ::testing::Test {
 protected:
  LocatedCtTest() {
    listen(document);
    fs::create_directories(at("before"));
    fs::create_directories(at("after"));
  }

  void listen(Document& to) {
    QObject::connect(&to, &Document::ctMissed,
                     [this](const QString&, const QString& text) { missed << text; });
    QObject::connect(&to, &Document::ctFound, [this](bool wasSaved) { found = wasSaved; });
  }

  void wait(Document& on) {
    ASSERT_TRUE(QTest::qWaitFor([&] { return !on.jobs().busy(); }, 300000));
  }

  /// Opens a CT and saves it in case.pneuma, which is opened again without it.
  void openWithoutItsCt(const fs::path& ct) {
    {
      Document first;
      first.open({ct});
      wait(first);
      first.saveProject(at("case.pneuma"), CtStorage::Linked, {}, {});
      wait(first);
    }
    fs::rename(ct, at("after") / ct.filename());
    document.open({at("case.pneuma")});
    wait(document);
    ASSERT_TRUE(document.ctMissing());
    ASSERT_EQ(missed.size(), 1);
    EXPECT_TRUE(missed[0].contains("is not where it was")) << missed[0].toStdString();
  }

  void locate(const fs::path& path) {
    missed.clear();
    document.locateCt(path);
    wait(document);
  }

  fs::path at(const std::string& name) const {
    return fs::path(folder.path().toStdString()) / name;
  }

  QTemporaryDir folder;
  Document document;
  QStringList missed;
  std::optional<bool> found;
};

TEST_F(LocatedCtTest, AVolumeIsFoundAgainAndItsLinkIsSaved) {
  writeVolume(at("before/ct.nii.gz"), test::generatedChest(test::chestGrid()).ct);
  openWithoutItsCt(at("before/ct.nii.gz"));
  EXPECT_NE(document.model().lungs, nullptr) << "all else works without";
  locate(at("after/ct.nii.gz"));
  EXPECT_TRUE(missed.isEmpty()) << missed.join(' ').toStdString();
  ASSERT_NE(document.model().ct, nullptr);
  EXPECT_FALSE(document.ctMissing());
  EXPECT_EQ(found, true);
  EXPECT_TRUE(document.modified());
  document.saveProject(at("case.pneuma"), CtStorage::Linked, {}, {});
  wait(document);
  Document again;
  again.open({at("case.pneuma")});
  wait(again);
  ASSERT_NE(again.model().ct, nullptr);
  EXPECT_EQ(again.model().ctSource->path, at("after/ct.nii.gz"));
  EXPECT_EQ(again.model().ct->voxels, document.model().ct->voxels);
}

TEST_F(LocatedCtTest, EveryStepToUndoHasItAgain) {
  writeVolume(at("before/ct.nii.gz"), test::generatedChest(test::chestGrid()).ct);
  openWithoutItsCt(at("before/ct.nii.gz"));
  ASSERT_TRUE(document.canUndo());
  locate(at("after/ct.nii.gz"));
  const auto ct = document.model().ct;
  document.undo();
  EXPECT_EQ(document.model().lungs, nullptr);
  EXPECT_EQ(document.model().ct, ct);
}

TEST_F(LocatedCtTest, AnotherCtIsRefusedAndSaysHowItDiffers) {
  const CtImage chest = test::generatedChest(test::chestGrid()).ct;
  writeVolume(at("before/ct.nrrd"), chest);
  openWithoutItsCt(at("before/ct.nrrd"));
  CtImage other = chest;
  for (std::int16_t& value : other.voxels) value = static_cast<std::int16_t>(value + 1);
  writeVolume(at("other.nrrd"), other);
  locate(at("other.nrrd"));
  EXPECT_EQ(document.model().ct, nullptr);
  ASSERT_EQ(missed.size(), 1);
  EXPECT_TRUE(missed[0].contains("'other.nrrd' is another CT")) << missed[0].toStdString();
  EXPECT_FALSE(missed[0].contains(folder.path())) << "folders often carry names";
  EXPECT_FALSE(found.has_value());
  EXPECT_FALSE(document.modified());
  std::ofstream(at("notes.txt")) << "no CT";
  locate(at("notes.txt"));
  ASSERT_EQ(missed.size(), 1);
  EXPECT_TRUE(missed[0].contains("holds no CT")) << missed[0].toStdString();
  locate(at("absent.nrrd"));
  ASSERT_EQ(missed.size(), 1);
  EXPECT_EQ(document.model().ct, nullptr);
}

TEST_F(LocatedCtTest, ASeriesIsFoundAmongOthersByOneOfItsFiles) {
  testing::SeriesSpec spec;
  spec.columns = spec.rows = 64;
  spec.pixelMm = 5.0;
  spec.origin = Vec3(-160.0, -160.0, 0.0);
  spec.step = Vec3(0.0, 0.0, 5.0);
  spec.slices = 48;
  spec.hu = [](const Vec3& p) {
    const double beside = std::abs(p.x()) - 60.0;
    if (p.z() > 20.0 && p.z() < 220.0 && std::hypot(beside, p.y()) < 40.0) return -850.0;
    return std::hypot(p.x(), p.y()) < 130.0 ? 40.0 : -1000.0;
  };
  writeSeries(at("before/ct"), spec);
  openWithoutItsCt(at("before/ct"));
  const std::string uid = spec.uid;
  // A better one came into the folder that the project's lies in now.
  spec.uid += ".77";
  spec.step.z() = 2.5;
  spec.slices = 96;
  writeSeries(at("after/better"), spec);
  locate(at("after"));
  EXPECT_TRUE(missed.isEmpty()) << missed.join(' ').toStdString();
  ASSERT_NE(document.model().ct, nullptr);
  EXPECT_EQ(document.model().ct->geometry.size[2], 48);
  EXPECT_EQ(document.model().ctSource->series, seriesName(uid));
}

}  // namespace
}  // namespace pneuma
