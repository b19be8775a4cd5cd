// Several series in one folder: which is recommended, what is said of each, and opening one.
#include "document/series_list.h"

#include <QSignalSpy>
#include <QTemporaryDir>
#include <QTest>

#include <gtest/gtest.h>

#include "document/document.h"
#include "document/shell_command.h"
#include "io/ct_file.h"
#include "render/grey_window.h"
#include "support/dicom_maker.h"

namespace pneuma {
namespace {

namespace fs = std::filesystem;

using Use = SeriesRow::Use;

constexpr const char* ThinUid = "1.2.826.0.1.3680043.9.8.1";
constexpr const char* ThickUid = "1.2.826.0.1.3680043.9.8.2";

/// Axial slices of two lungs of 40 mm radius and 200 mm length in a body.
void writeChest(const fs::path& folder, const char* uid, double stepMm) {
  testing::SeriesSpec spec;
  spec.columns = spec.rows = 64;
  spec.pixelMm = 5.0;
  spec.origin = Vec3(-160.0, -160.0, 0.0);
  spec.step = Vec3(0.0, 0.0, stepMm);
  spec.slices = static_cast<int>(240.0 / stepMm);
  spec.uid = uid;
  spec.hu = [](const Vec3& p) {
    const double beside = std::abs(p.x()) - 60.0;
    if (p.z() > 20.0 && p.z() < 220.0 && std::hypot(beside, p.y()) < 40.0) return -850.0;
    return std::hypot(p.x(), p.y()) < 130.0 ? 40.0 : -1000.0;
  };
  writeSeries(folder, spec);
}

class SeriesListTest : public ::testing::Test {
 protected:
  SeriesListTest() {
    QObject::connect(&document, &Document::seriesToChoose,
                     [this](const SeriesList& list) { asked.push_back(list); });
    QObject::connect(&document, &Document::failed,
                     [this](const QString&, const QString& text) { failure = text; });
    QObject::connect(
        &document, &Document::seriesDrawn,
        [this](const SeriesList&, int row, const Picture& picture) { drawn[row] = picture; });
  }

  void open() {
    document.open({place()});
    wait();
  }

  void wait() {
    ASSERT_TRUE(QTest::qWaitFor([this] { return !document.jobs().busy(); }, 300000));
  }

  fs::path place() const { return folder.path().toStdString(); }

  static const SeriesRow& row(const SeriesList& list, const char* description) {
    for (const SeriesRow& one : list.rows) {
      if (one.description == QLatin1String(description)) return one;
    }
    throw std::runtime_error(std::string("no series ") + description);
  }

  QTemporaryDir folder;
  Document document;
  std::vector<SeriesList> asked;
  std::map<int, Picture> drawn;
  QString failure;
};

TEST_F(SeriesListTest, OneUsableSeriesOpensAtOnce) {
  writeChest(place() / "chest", ThinUid, 2.5);
  testing::writeOddSeries(place());
  fs::remove_all(place() / "Chest, gaps");
  open();
  EXPECT_TRUE(asked.empty());
  ASSERT_NE(document.model().ct, nullptr) << failure.toStdString();
  EXPECT_EQ(document.model().ct->geometry.size[2], 96);
  EXPECT_EQ(document.model().ctSource->series, "");
}

TEST_F(SeriesListTest, OfTwoTheBetterIsRecommendedAndTheChoiceIsKept) {
  writeChest(place() / "thick", ThickUid, 5.0);
  writeChest(place() / "thin", ThinUid, 2.5);
  open();
  EXPECT_EQ(document.model().ct, nullptr);
  ASSERT_EQ(asked.size(), 1u);
  const SeriesList& list = asked[0];
  ASSERT_EQ(list.rows.size(), 2u);
  EXPECT_EQ(list.chosen, 0);
  EXPECT_EQ(list.rows[0].use, Use::Recommended);
  EXPECT_EQ(list.rows[0].spacing.left(4), "2.50");
  EXPECT_EQ(list.rows[0].size, QString::fromUtf8("64 × 64 × 96"));
  EXPECT_TRUE(list.rows[0].why.startsWith("Recommended: axial, covers 240 mm"))
      << list.rows[0].why.toStdString();
  EXPECT_EQ(list.rows[1].use, Use::Possible);

  document.openSeries(list, 1, false);
  wait();
  ASSERT_NE(document.model().ct, nullptr) << failure.toStdString();
  EXPECT_EQ(document.model().ct->geometry.size[2], 48);
  // Kept and copied by a name that does not tell the UID.
  const std::string kept = seriesName(ThickUid);
  EXPECT_EQ(document.model().ctSource->series, kept);
  const QString command = shellCommand(WorkStep::Lungs, document, {}).text();
  EXPECT_TRUE(command.contains(QStringLiteral("--series ") + QString::fromStdString(kept)))
      << command.toStdString();

  document.saveProject(place() / "case.pneuma", CtStorage::Linked, {}, {});
  wait();
  Document again;
  again.open({place() / "case.pneuma"});
  ASSERT_TRUE(QTest::qWaitFor([&] { return !again.jobs().busy(); }, 300000));
  EXPECT_EQ(again.model().ctSource->series, kept);
  ASSERT_NE(again.model().ct, nullptr);
  EXPECT_EQ(again.model().ct->geometry.size[2], 48);
}

TEST_F(SeriesListTest, SaysOfEachWhyItCannotBeUsedAndNamesNobody) {
  writeChest(place() / "chest", ThinUid, 2.5);
  writeChest(place() / "thick", ThickUid, 5.0);
  testing::writeOddSeries(place());
  open();
  ASSERT_EQ(asked.size(), 1u);
  const SeriesList& list = asked[0];
  ASSERT_EQ(list.rows.size(), 7u);
  EXPECT_EQ(row(list, "Scout").why,
            "Cannot be opened. It is a localizer (an overview picture), not a stack of slices.");
  EXPECT_EQ(row(list, "Heart MR").why, "Cannot be opened. It is no CT: its modality is MR.");
  EXPECT_TRUE(row(list, "Single").why.startsWith("Cannot be opened. It has one slice only"));
  EXPECT_EQ(row(list, "Head").use, Use::Doubtful);
  EXPECT_TRUE(row(list, "Head").why.contains("HEAD"));
  EXPECT_EQ(row(list, "Chest, gaps").use, Use::WithGapsOnly);
  EXPECT_TRUE(row(list, "Chest, gaps").why.contains("2 slices are missing between"));
  for (const SeriesRow& one : list.rows) {
    for (const QString& text : {one.description, one.why, one.kernel}) {
      EXPECT_FALSE(text.contains("Jane") || text.contains("12345")) << text.toStdString();
    }
  }
}

TEST_F(SeriesListTest, GapsAreFilledOnlyWhenAskedFor) {
  testing::writeOddSeries(place());
  for (const char* other : {"Scout", "Heart MR", "Head", "Single"}) fs::remove_all(place() / other);
  open();
  ASSERT_EQ(asked.size(), 1u) << "a doubtful one is not opened without asking";
  EXPECT_EQ(asked[0].chosen, 0);
  document.openSeries(asked[0], 0, true);
  wait();
  ASSERT_NE(document.model().ct, nullptr) << failure.toStdString();
  EXPECT_EQ(document.model().ct->geometry.size[2], 20);
  EXPECT_TRUE(document.model().ctSource->corrections.fillGaps);
}

TEST_F(SeriesListTest, OneThatCannotBeReadIsRefusedAsEver) {
  testing::writeOddSeries(place());
  for (const char* other : {"Chest, gaps", "Heart MR", "Head", "Single"}) {
    fs::remove_all(place() / other);
  }
  open();
  EXPECT_TRUE(asked.empty());
  EXPECT_TRUE(failure.contains("localizer")) << failure.toStdString();
}

TEST_F(SeriesListTest, WhereNoneCanBeReadTheTableSaysWhy) {
  testing::writeOddSeries(place());
  for (const char* other : {"Chest, gaps", "Head"}) fs::remove_all(place() / other);
  open();
  ASSERT_EQ(asked.size(), 1u);
  EXPECT_EQ(asked[0].chosen, -1);
  EXPECT_TRUE(asked[0].sentence().contains("none can be opened"));
}

TEST_F(SeriesListTest, OthersAreListedAgainWithTheOneThatIsOpen) {
  writeChest(place() / "thick", ThickUid, 5.0);
  writeChest(place() / "thin", ThinUid, 2.5);
  open();
  document.openSeries(asked.at(0), 1, false);
  wait();
  ASSERT_TRUE(document.hasOtherSeries());
  document.listSeries();
  wait();
  ASSERT_EQ(asked.size(), 2u);
  EXPECT_FALSE(asked[1].rows[0].opened);
  EXPECT_TRUE(asked[1].rows[1].opened);
}

TEST_F(SeriesListTest, ThumbnailsShowTheMiddleSliceInTheLungWindow) {
  writeChest(place() / "thick", ThickUid, 5.0);
  writeChest(place() / "thin", ThinUid, 2.5);
  testing::writeOddSeries(place());
  open();
  document.drawSeries(asked.at(0));
  EXPECT_TRUE(document.drawingSeries());
  wait();
  EXPECT_FALSE(document.drawingSeries());
  ASSERT_EQ(drawn.size(), asked[0].rows.size());
  const Picture& chest = drawn[0];
  ASSERT_EQ(chest.width, 64);
  ASSERT_EQ(chest.height, 64);
  const auto grey = [&](int x, int y) { return static_cast<int>(chest.rgb[3 * (y * 64 + x)]); };
  EXPECT_EQ(grey(44, 32), static_cast<int>(GreyWindow{}.grey(-850.0)));  // in the left lung
  EXPECT_EQ(grey(32, 32), static_cast<int>(GreyWindow{}.grey(40.0)));    // between them
}

TEST_F(SeriesListTest, DrawingIsGivenUpForWhatIsOpened) {
  writeChest(place() / "thick", ThickUid, 5.0);
  writeChest(place() / "thin", ThinUid, 2.5);
  open();
  const QSignalSpy said(&document, &Document::said);
  for (int i = 0; i < 50; ++i) document.drawSeries(asked.at(0));
  document.openSeries(asked[0], 0, false);
  EXPECT_FALSE(document.drawingSeries());
  wait();
  EXPECT_NE(document.model().ct, nullptr);
  for (const auto& sentence : said) {
    EXPECT_FALSE(sentence.at(0).toString().contains("stopped"))
        << qPrintable(sentence.at(0).toString());
  }
}

}  // namespace
}  // namespace pneuma
