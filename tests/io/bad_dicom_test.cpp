#include <cstdlib>
#include <fstream>
#include <functional>
#include <limits>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include "core/error.h"
#include "io/atomic_file.h"
#include "io/ct_file.h"
#include "io/temp_folder.h"
#include "support/dicom_maker.h"

namespace pneuma {
namespace {

using ::testing::ContainsRegex;
using testing::DicomMaker;
using testing::DicomSyntax;
using testing::SeriesSpec;
using testing::TempFolder;
using testing::writeSeries;

/// One way to spoil a series of six slices, and the sentence that must follow.
struct BadSeries {
  const char* name;
  ExitCode code;
  const char* sentence;  ///< regular expression
  std::function<void(SeriesSpec& spec)> spoil;
  std::function<void(const TempFolder& folder)> after = [](const TempFolder&) {};
};

void cut(const std::filesystem::path& file, std::size_t bytes) {
  std::filesystem::resize_file(file, std::filesystem::file_size(file) - bytes);
}

void damage(const std::filesystem::path& file, std::size_t fromEnd, const std::string& bytes) {
  std::fstream stream(file, std::ios::binary | std::ios::in | std::ios::out);
  stream.seekp(-static_cast<std::streamoff>(fromEnd), std::ios::end);
  stream << bytes;
}

/// Changes every slice, or one of them.
std::function<void(SeriesSpec&)> each(const std::function<void(DicomMaker&)>& change,
                                      int only = -1) {
  return [=](SeriesSpec& spec) {
    spec.change = [=](DicomMaker& maker, int k) {
      if (only < 0 || k == only) change(maker);
      return true;
    };
  };
}

std::function<void(SeriesSpec&)> inSyntax(DicomSyntax syntax) {
  return each([=](DicomMaker& maker) { maker.syntax(syntax); });
}

const double NaN = std::numeric_limits<double>::quiet_NaN();

const std::vector<BadSeries> Cases = {
    {"another modality", ExitCode::Unsupported, "no CT: its modality is MR",
     each([](DicomMaker& m) { m.setText(0x00080060, "CS", "MR"); })},
    {"no modality", ExitCode::Unsupported, "no CT: its modality is not stated",
     each([](DicomMaker& m) { m.erase(0x00080060); })},
    {"a localizer only", ExitCode::Unsupported, "localizer",
     each([](DicomMaker& m) { m.setText(0x00080008, "CS", "ORIGINAL\\PRIMARY\\LOCALIZER"); })},
    {"colour", ExitCode::Unsupported, "001.dcm.*RGB, not a CT slice",
     each([](DicomMaker& m) { m.setShort(0x00280002, 3).setText(0x00280004, "CS", "RGB"); })},
    {"inverted grey", ExitCode::Unsupported, "001.dcm.*MONOCHROME1",
     each([](DicomMaker& m) { m.setText(0x00280004, "CS", "MONOCHROME1"); })},
    {"32 bits", ExitCode::Unsupported, "001.dcm.*bits",
     each([](DicomMaker& m) { m.setShort(0x00280100, 32).setShort(0x00280101, 32); })},
    {"a video", ExitCode::Unsupported, "001.dcm.*compressed as", inSyntax(DicomSyntax::Unknown)},
    {"no HU", ExitCode::Unsupported, "does not look like a chest CT in HU.*rescale",
     each([](DicomMaker& m) { m.rescale(1.0, 0.0); })},
    {"one slice", ExitCode::InputInvalid, "one slice only \\(\"001.dcm\"\\)",
     [](SeriesSpec& spec) { spec.slices = 1; }},
    {"no slice", ExitCode::InputMissing, "no DICOM picture in .*holds no files",
     [](SeriesSpec& spec) { spec.slices = 0; }},
    {"a slice cut short", ExitCode::InputInvalid, "003.dcm\" ends early|003.dcm.*cut off",
     [](SeriesSpec&) {}, [](const TempFolder& f) { cut(f / "003.dcm", 100); }},
    {"the last slice cut within its header", ExitCode::InputInvalid, "006.dcm.*cut off",
     [](SeriesSpec&) {},
     [](const TempFolder& f) { std::filesystem::resize_file(f / "006.dcm", 350); }},
    {"a missing slice", ExitCode::InputInvalid, "1 slice is missing between S 103 mm and S 109 mm",
     [](SeriesSpec&) {}, [](const TempFolder& f) { std::filesystem::remove(f / "003.dcm"); }},
    {"more slices missing than there", ExitCode::InputInvalid, "more are missing",
     each([](DicomMaker& m) { m.position(Vec3(-12.0, -10.0, 400.0)); }, 5)},
    {"two slices in one place", ExitCode::InputInvalid, "different slices in one place",
     each([](DicomMaker& m) { m.position(Vec3(-12.0, -10.0, 112.0)); }, 5),
     [](const TempFolder&) {}},
    {"all slices in one place", ExitCode::InputInvalid, "stand in the same place",
     each([](DicomMaker& m) { m.position(Vec3(0.0, 0.0, 0.0)); })},
    {"mixed sizes", ExitCode::InputInvalid, "005.dcm\" has 6 x 6 pixels, \"001.dcm\" 12 x 10",
     each([](DicomMaker& m) { m.size(6, 6); }, 4)},
    {"mixed orientations", ExitCode::InputInvalid, "002.dcm\" is oriented otherwise",
     each([](DicomMaker& m) { m.axes(Vec3::UnitY(), Vec3::UnitZ()); }, 1)},
    {"mixed pixel spacing", ExitCode::InputInvalid, "002.dcm\" has pixels of 3 mm",
     each(
         [](DicomMaker& m) {
           m.setNumbers(0x00280030, {3.0, 3.0});
         },
         1)},
    {"slices shifted sideways", ExitCode::InputInvalid, "shifted sideways by up to",
     each([](DicomMaker& m) { m.position(Vec3(40.0, -10.0, 106.0)); }, 2)},
    {"no position", ExitCode::InputInvalid, "001.dcm\" does not say where it lies",
     each([](DicomMaker& m) { m.erase(0x00200032); })},
    {"an empty position", ExitCode::InputInvalid, "004.dcm\" does not say where it lies",
     each([](DicomMaker& m) { m.setText(0x00200032, "DS", "\\\\"); }, 3)},
    {"no pixel spacing", ExitCode::InputInvalid, "001.dcm\" does not state its pixel spacing",
     each([](DicomMaker& m) { m.erase(0x00280030); })},
    {"negative pixel spacing", ExitCode::InputInvalid, "001.dcm\" states a pixel spacing of 2 x -2",
     each([](DicomMaker& m) {
       m.setNumbers(0x00280030, {2.0, -2.0});
     })},
    {"pixel spacing that is no number", ExitCode::InputInvalid, "001.dcm\".*spacing",
     each([](DicomMaker& m) {
       m.setNumbers(0x00280030, {NaN, NaN});
     })},
    {"pixels of a metre", ExitCode::InputInvalid, "1000, 1000 and 3 mm apart, not 0.01 to 100 mm",
     each([](DicomMaker& m) {
       m.setNumbers(0x00280030, {1000.0, 1000.0});
     })},
    {"slices a metre apart", ExitCode::InputInvalid, "2, 2 and 1000 mm apart, not 0.01 to 100 mm",
     [](SeriesSpec& spec) { spec.step = Vec3(0.0, 0.0, 1000.0); }},
    {"positions beyond all measure", ExitCode::InputInvalid, "position or direction",
     [](SeriesSpec& spec) { spec.step = Vec3(0.0, 0.0, 1e200); }},
    {"another part of the body", ExitCode::Unsupported,
     "not of the chest.*body part \"HEAD\".*import --series 1",
     each([](DicomMaker& m) { m.setText(0x00180015, "CS", "HEAD"); })},
    {"a rescale slope of 0", ExitCode::InputInvalid, "001.dcm\" states a rescale slope of 0",
     each([](DicomMaker& m) { m.setNumbers(0x00281053, {0.0}); })},
    {"directions that are no right angle", ExitCode::InputInvalid, "no right angle",
     each([](DicomMaker& m) { m.axes(Vec3::UnitX(), Vec3(0.5, 0.866, 0.0)); })},
    {"an absurd size", ExitCode::InputInvalid, "001.dcm\".*(65535|ends early)",
     each([](DicomMaker& m) { m.setShort(0x00280010, 65535).setShort(0x00280011, 65535); })},
    {"no rows", ExitCode::InputInvalid, "001.dcm\" states a size of 12 x 0",
     each([](DicomMaker& m) { m.setShort(0x00280010, 0); })},
    {"more pixels stated than there", ExitCode::InputInvalid, "002.dcm\" ends early",
     each([](DicomMaker& m) { m.stored(std::vector<std::uint16_t>(50)); }, 1)},
    {"a JPEG cut short", ExitCode::InputInvalid, "003.dcm.*(cut off|decoded|damaged)",
     inSyntax(DicomSyntax::JpegLossless), [](const TempFolder& f) { cut(f / "003.dcm", 40); }},
    {"a JPEG damaged inside", ExitCode::InputInvalid, "004.dcm.*(damaged|decoded)",
     inSyntax(DicomSyntax::JpegLossless),
     [](const TempFolder& f) { damage(f / "004.dcm", 120, std::string(40, '\xFF')); }},
    {"a compressed slice with values of no scanner", ExitCode::InputInvalid,
     "004.dcm.*damaged inside.*it holds -9000 HU", each([](DicomMaker& m) {
       m.setShort(0x00280103, 1).syntax(DicomSyntax::JpegLossless);
       if (m.bytes().find("1.2.826.0.1.3680043.9.1.9.4") == std::string::npos) return;
       m.pixels([](int i, int j) { return i == 5 && j == 5 ? -9000.0 : -800.0; });
     })},
    {"run lengths cut short", ExitCode::InputInvalid, "002.dcm.*(cut off|decoded|damaged)",
     inSyntax(DicomSyntax::Rle), [](const TempFolder& f) { cut(f / "002.dcm", 60); }},
    {"nothing but other files", ExitCode::InputMissing, "no DICOM picture in .*2 files",
     [](SeriesSpec& spec) { spec.slices = 0; },
     [](const TempFolder& f) { f.put("a.txt", "text"), f.put("b.dcm", "no DICOM"); }},
    {"nothing but padding", ExitCode::InputInvalid, "nothing but padding", each([](DicomMaker& m) {
       m.setShort(0x00280103, 1).rescale(1.0, 0.0).pixels([](int, int) { return -2000.0; });
     })},
};

class BadDicom : public ::testing::TestWithParam<BadSeries> {};

TEST_P(BadDicom, IsRefusedWithASentenceThatNamesIt) {
  const BadSeries& bad = GetParam();
  const TempFolder folder;
  SeriesSpec spec;
  bad.spoil(spec);
  writeSeries(folder.path(), spec);
  bad.after(folder);
  ::testing::internal::CaptureStderr();
  try {
    readCt(folder.path());
    ADD_FAILURE() << "it was read";
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), bad.code) << error.what();
    EXPECT_THAT(error.what(), ContainsRegex(bad.sentence));
  }
  EXPECT_EQ(::testing::internal::GetCapturedStderr(), "");
}

INSTANTIATE_TEST_SUITE_P(All, BadDicom, ::testing::ValuesIn(Cases), [](const auto& one) {
  std::string name = one.param.name;
  for (char& c : name) c = std::isalnum(static_cast<unsigned char>(c)) != 0 ? c : '_';
  return name;
});

TEST(BadDicomPath, ThatIsNotThere) { EXPECT_THROW(readCt("/nowhere/at/all"), InputMissing); }

TEST(BadDicomPath, ThatMayNotBeRead) {
  if (::geteuid() == 0) GTEST_SKIP() << "root may read everything";
  const TempFolder folder;
  writeSeries(folder / "closed", {});
  std::filesystem::permissions(folder / "closed", std::filesystem::perms::none);
  EXPECT_THROW(readCt(folder / "closed"), InputMissing);
  std::filesystem::permissions(folder / "closed", std::filesystem::perms::owner_all);
  for (const auto& entry : std::filesystem::directory_iterator(folder / "closed")) {
    std::filesystem::permissions(entry.path(), std::filesystem::perms::none);
  }
  EXPECT_THROW(readCt(folder / "closed"), InputMissing);
}

TEST(BadDicomPath, ThatIsAnotherFile) {
  const TempFolder folder;
  EXPECT_THROW(readCt(folder.put("ct.dcm", "this is no DICOM file")), Unsupported);
}

TEST(SeriesChoice, TakesAnotherPartOfTheBodyWhenAsked) {
  const TempFolder folder;
  SeriesSpec spec;
  each([](DicomMaker& m) { m.setText(0x00180015, "CS", "ABDOMEN"); })(spec);
  writeSeries(folder.path(), spec);
  EXPECT_THROW(readCt(folder.path()), Unsupported);
  EXPECT_EQ(readCt(folder.path(), {}, {}, {"1"}).series->bodyPart, "ABDOMEN");
}

TEST(SeriesChoice, RefusesWhatIsNotThere) {
  const TempFolder folder;
  writeSeries(folder.path(), {});
  EXPECT_EQ(readCt(folder.path(), {}, {}, {"1"}).series->slices.size(), 6u);
  EXPECT_EQ(readCt(folder.path(), {}, {}, {"1.2.826.0.1.3680043.9.1"}).series->number, 3);
  for (const char* wanted : {"0", "2", "-1", "1.2.3", "chest"}) {
    EXPECT_THROW(readCt(folder.path(), {}, {}, {wanted}), InvalidOption) << wanted;
  }
}

}  // namespace
}  // namespace pneuma
