#include "io/dicom_anonymizer.h"

#include <algorithm>
#include <cstdlib>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/error.h"
#include "io/atomic_file.h"
#include "io/ct_file.h"
#include "io/detail/dicom_elements.h"
#include "io/temp_folder.h"
#include "support/dicom_maker.h"

namespace pneuma {
namespace {

using testing::DicomMaker;
using testing::DicomSyntax;
using ::testing::HasSubstr;
using ::testing::Not;
using testing::SeriesSpec;
using ::testing::StartsWith;
using testing::TempFolder;
using testing::writeSeries;

const std::string Key = "a key";

/// A slice with everything that tells of a person, and the word SECRET in it.
DicomMaker telling() {
  DicomMaker maker(10.0);
  maker.setText(0x00080020, "DA", "20040101").setText(0x00080030, "TM", "101010");
  maker.setText(0x00080050, "SH", "SECRET1").setText(0x00080080, "LO", "SECRET Hospital");
  maker.setText(0x00080090, "PN", "SECRET^Doctor").setText(0x00081010, "SH", "SECRETSTATION");
  maker.setText(0x0008103E, "LO", "Chest 5 mm of Mr SECRET 20040101");
  maker.setText(0x00081070, "PN", "SECRET^Operator");
  maker.setText(0x00080070, "LO", "Maker");
  maker.setText(0x00100010, "PN", "SECRET^Jane").setText(0x00100020, "LO", "SECRET99");
  maker.setText(0x00100030, "DA", "19500101").setText(0x00101010, "AS", "054Y");
  maker.setText(0x00104000, "LT", "SECRET history");
  maker.setText(0x00181000, "LO", "SECRET serial").setText(0x00200010, "SH", "SECRET");
  maker.setText(0x00204000, "LT", "SECRET comment");
  maker.setText(0x00090010, "LO", "SECRET maker").setText(0x00091001, "LO", "SECRET value");
  maker.setText(0x00324000, "LT", "SECRET").setText(0x00400254, "LO", "SECRET procedure");
  maker.setText(0x60003000, "OW", "SECRET overlay");
  maker.setText(0x00080052, "UI", "1.2.3.4.5");
  return maker;
}

std::string textAt(const std::string& file, std::uint32_t tag) {
  for (const DicomElement& element : dicomElements(file, "file").data) {
    if (element.tag == tag) return element.text();
  }
  return "(none)";
}

TEST(AnonymizedDicom, TellsNothingOfThePerson) {
  for (const DicomSyntax syntax : {DicomSyntax::ExplicitLittle, DicomSyntax::ImplicitLittle,
                                   DicomSyntax::Rle, DicomSyntax::JpegLossless}) {
    const std::string original = telling().syntax(syntax).bytes();
    ASSERT_THAT(original, HasSubstr("SECRET^Jane"));
    const AnonymizedDicom result = anonymizedDicom(original, Key, "file");
    EXPECT_THAT(result.content, Not(HasSubstr("SECRET")));
    for (const char* date : {"20040101", "19500101", "054Y", "101010"}) {
      EXPECT_THAT(result.content, Not(HasSubstr(date)));
    }
    EXPECT_THAT(result.content, Not(HasSubstr("1.2.826.0.1.3680043.9.1")));
    EXPECT_EQ(result.privateRemoved, 2u);
    EXPECT_EQ(result.removed.at("PatientName"), 1u);
    EXPECT_EQ(textAt(result.content, 0x00120062), "YES");
    EXPECT_THAT(textAt(result.content, 0x00120063), HasSubstr("PS3.15"));
    EXPECT_THAT(textAt(result.content, 0x00100010), StartsWith("ANON-"));
    EXPECT_EQ(textAt(result.content, 0x0008103E), "Chest 5 mm of");
    EXPECT_EQ(textAt(result.content, 0x00080070), "Maker");
    EXPECT_EQ(textAt(result.content, 0x00181210), "B30f");
    EXPECT_EQ(textAt(result.content, 0x00080016), "1.2.840.10008.5.1.4.1.1.2");
  }
}

/// A slice with one sequence of one item: a code, and what else is given.
std::string withCode(std::uint32_t sequence, const std::string& designator,
                     const std::string& meaning) {
  DicomElements elements = dicomElements(DicomMaker(10.0).bytes(), "file");
  DicomElement added;
  added.tag = sequence;
  added.vr = "SQ";
  added.items = {{dicomText(0x00080100, "SH", "113690"), dicomText(0x00080102, "SH", designator),
                  dicomText(0x00080104, "LO", meaning)}};
  elements.data.push_back(std::move(added));
  std::ranges::stable_sort(elements.data, {}, &DicomElement::tag);
  return dicomFile(elements);
}

TEST(AnonymizedDicom, KeepsOnlyTheSequencesThatACtNeeds) {
  // InstitutionCode, ReferringPhysicianIdentification, physicians and operators, admitting
  // diagnoses, procedures, persons, acquisition context, one that no dictionary knows
  for (const std::uint32_t sequence :
       {0x00080082u, 0x00080096u, 0x00081032u, 0x00081049u, 0x00081052u, 0x00081062u, 0x00081072u,
        0x00081084u, 0x00081120u, 0x00321064u, 0x00400260u, 0x00400555u, 0x00401101u, 0x0040A730u,
        0x00880200u, 0x00186666u}) {
    const std::string original = withCode(sequence, "DCM", "Dr Jane SECRET");
    ASSERT_THAT(original, HasSubstr("SECRET"));
    const AnonymizedDicom result = anonymizedDicom(original, Key, "file");
    EXPECT_THAT(result.content, Not(HasSubstr("SECRET"))) << std::hex << sequence;
    EXPECT_EQ(result.removed.size(), 1u + 2u) << "the sequence, and name and ID of the patient";
  }
}

TEST(AnonymizedDicom, KeepsCodesOfTheStandardsOnly) {
  constexpr std::uint32_t PhantomTypeCode = 0x00189346;
  const std::string kept =
      anonymizedDicom(withCode(PhantomTypeCode, "DCM", "IEC Head Dosimetry Phantom"), Key, "file")
          .content;
  EXPECT_THAT(kept, HasSubstr("IEC Head Dosimetry Phantom"));
  EXPECT_THAT(kept, HasSubstr("113690"));
  for (const char* designator : {"99SAINTMARY", "L", ""}) {
    const std::string gone =
        anonymizedDicom(withCode(PhantomTypeCode, designator, "SECRET"), Key, "file").content;
    EXPECT_THAT(gone, Not(HasSubstr("SECRET"))) << designator;
    EXPECT_THAT(gone, Not(HasSubstr("113690"))) << designator;
  }
}

TEST(AnonymizedDicom, DropsCodesOutsideOfSequences) {
  DicomMaker maker(10.0);
  maker.setText(0x00080102, "SH", "DCM").setText(0x00080104, "LO", "SECRET");
  EXPECT_THAT(anonymizedDicom(maker.bytes(), Key, "file").content, Not(HasSubstr("SECRET")));
}

TEST(AnonymizedDicom, KeepsPixelsAndPlacesBitForBit) {
  const TempFolder folder;
  for (const DicomSyntax syntax : {DicomSyntax::ExplicitLittle, DicomSyntax::ImplicitLittle,
                                   DicomSyntax::Rle, DicomSyntax::JpegLossless}) {
    const std::string name = std::to_string(static_cast<int>(syntax));
    SeriesSpec spec;
    spec.change = [&](DicomMaker& maker, int) {
      maker.syntax(syntax);
      return true;
    };
    writeSeries(folder / name, spec);
    std::filesystem::create_directory(folder / (name + "a"));
    for (const auto& entry : std::filesystem::directory_iterator(folder / name)) {
      const std::string file = readFile(entry.path());
      const AnonymizedDicom result = anonymizedDicom(file, Key, "file");
      EXPECT_EQ(textAt(result.content, 0x7FE00010), textAt(file, 0x7FE00010));
      writeFile(folder / (name + "a") / entry.path().filename(), result.content);
    }
    const CtFile before = readCt(folder / name);
    const CtFile after = readCt(folder / (name + "a"));
    EXPECT_EQ(after.image.voxels, before.image.voxels);
    EXPECT_EQ(after.image.geometry, before.image.geometry);
  }
}

TEST(AnonymizedDicom, HasTheSameUidsForTheSameKeyOnly) {
  EXPECT_EQ(anonymizedUid("1.2.3", Key), anonymizedUid("1.2.3", Key));
  EXPECT_NE(anonymizedUid("1.2.3", Key), anonymizedUid("1.2.4", Key));
  EXPECT_NE(anonymizedUid("1.2.3", Key), anonymizedUid("1.2.3", "another key"));
  for (int i = 0; i < 200; ++i) {
    const std::string uid = anonymizedUid(std::to_string(i), Key);
    EXPECT_THAT(uid, ::testing::MatchesRegex("2\\.25\\.[1-9][0-9]{30,38}"));
  }
}

TEST(AnonymizedDicom, ReadsWhatItWrites) {
  const std::string original = telling().bytes();
  const std::string again = dicomFile(dicomElements(original, "file"));
  EXPECT_EQ(again, original);
}

TEST(AnonymizedDicom, RefusesDamageWithASentence) {
  const std::string whole = telling().bytes();
  EXPECT_THROW(anonymizedDicom("no DICOM", Key, "x.dcm"), Unsupported);
  int refused = 0;
  for (std::size_t size = 140; size < whole.size(); size += 3) {
    try {
      anonymizedDicom(whole.substr(0, size), Key, "x.dcm");
    } catch (const InvalidInput& error) {
      EXPECT_THAT(error.what(), HasSubstr("x.dcm"));
      ++refused;
    }
  }
  EXPECT_GT(refused, 100);
}

TEST(AnonymizedDicom, WarnsOfTextInThePicture) {
  DicomMaker maker;
  EXPECT_EQ(anonymizedDicom(maker.bytes(), Key, "f").burnedIn, "");
  maker.setText(0x00280301, "CS", "YES");
  EXPECT_THAT(anonymizedDicom(maker.bytes(), Key, "f").burnedIn, HasSubstr("drawn into it"));
}

TEST(AnonymizedDicom, OfARealSeriesReadsTheSame) {
  const char* data = std::getenv("PNEUMA_TEST_DATA");
  const auto series =
      std::filesystem::path(data == nullptr ? "" : data) / "ct_cip64" / "ct-64Dicom";
  if (!std::filesystem::exists(series)) GTEST_SKIP() << "PNEUMA_TEST_DATA has no ct_cip64";
  const TempFolder folder;
  for (const auto& entry : std::filesystem::directory_iterator(series)) {
    const AnonymizedDicom result =
        anonymizedDicom(readFile(entry.path()), Key, entry.path().filename().string());
    writeFile(folder / entry.path().filename().string(), result.content);
  }
  const CtFile before = readCt(series);
  const CtFile after = readCt(folder.path());
  EXPECT_EQ(after.image.voxels, before.image.voxels);
  EXPECT_EQ(after.image.geometry, before.image.geometry);
  EXPECT_EQ(after.series->identifiers.size(), 4u);  // two pseudonyms, two UIDs
}

}  // namespace
}  // namespace pneuma
