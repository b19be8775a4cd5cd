#include "io/detail/dicom_nesting.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "io/atomic_file.h"
#include "io/ct_file.h"
#include "io/dicom_series.h"
#include "support/dicom_maker.h"
#include "temp_folder.h"

namespace pneuma {
namespace {

using testing::DicomMaker;
using testing::DicomSyntax;
using ::testing::HasSubstr;
using testing::TempFolder;

std::string little(std::uint32_t value, int bytes) {
  std::string text;
  for (int i = 0; i < bytes; ++i) text += static_cast<char>(value >> (8 * i) & 0xFF);
  return text;
}

std::string tagText(std::uint32_t tag) { return little(tag >> 16, 2) + little(tag & 0xFFFF, 2); }

constexpr std::uint32_t Open = 0xFFFFFFFF;

/// An element as it stands in implicit files: tag, length, value.
std::string implicitElement(std::uint32_t tag, std::uint32_t length, const std::string& value) {
  return tagText(tag) + little(length, 4) + value;
}

std::string implicitElement(std::uint32_t tag, const std::string& value) {
  return implicitElement(tag, static_cast<std::uint32_t>(value.size()), value);
}

const std::string ItemEnd = implicitElement(0xFFFEE00D, "");
const std::string SequenceEnd = implicitElement(0xFFFEE0DD, "");

std::string openItem(const std::string& content) {
  return implicitElement(0xFFFEE000, Open, content) + ItemEnd;
}

class DicomNesting : public ::testing::Test {
 protected:
  /// What is said of a slice with a private element of this content, of no length if `open`.
  std::string faultOf(const std::string& vr, const std::string& content, bool open) {
    std::string bytes = DicomMaker().set(0x00291010, vr, content).bytes();
    if (open) bytes.replace(bytes.find(content) - 4, 4, little(Open, 4));
    writeFile(file_, bytes);
    return nestingFault(file_);
  }

  TempFolder folder_;
  std::filesystem::path file_ = folder_ / "slice.dcm";
};

TEST_F(DicomNesting, OfEveryFormIsTaken) {
  for (const DicomSyntax syntax : {DicomSyntax::ImplicitLittle, DicomSyntax::ExplicitLittle,
                                   DicomSyntax::Rle, DicomSyntax::JpegLossless}) {
    writeFile(file_, DicomMaker().syntax(syntax).bytes());
    EXPECT_EQ(nestingFault(file_), "") << static_cast<int>(syntax);
  }
  const std::string text = implicitElement(0x00080100, "CODE  ");
  // Sequences of unknown length are implicit inside (PS3.5, 6.2.2), those of known length may be.
  EXPECT_EQ(faultOf("UN", openItem(text) + SequenceEnd, true), "");
  EXPECT_EQ(faultOf("UN", implicitElement(0xFFFEE000, text) + SequenceEnd, true), "");
  EXPECT_EQ(faultOf("UN", openItem(text), false), "");
  const std::string inner = implicitElement(0x00081140, Open, openItem(text) + SequenceEnd);
  EXPECT_EQ(faultOf("UN", openItem(inner + text) + SequenceEnd, true), "");
  // Bytes that are anybody's.
  EXPECT_EQ(faultOf("UN", "abcdefgh", false), "");
  EXPECT_EQ(faultOf("OB", tagText(0xFFFEE000) + "abcd", false), "");
  EXPECT_EQ(faultOf("OB", implicitElement(0xFFFEE000, "abcd") + SequenceEnd, true), "");
  EXPECT_EQ(listDicomSeries(file_).size(), 1U);
  // Unknown things of a known length, whatever they begin with.
  EXPECT_EQ(faultOf("UN", tagText(0xFFFEE000) + "abcdefgh", false), "");
  const std::string explicitInside = tagText(0x00080100) + "SH" + little(6, 2) + "CODE  ";
  EXPECT_EQ(faultOf("UN", implicitElement(0xFFFEE000, explicitInside), false), "");
  EXPECT_EQ(faultOf("SQ", SequenceEnd, false), "");
  EXPECT_EQ(faultOf("SQ", implicitElement(0xFFFEE000, "") + ItemEnd + SequenceEnd, true), "");
  // What follows the pixels, such as padding of a tape.
  for (const std::string& padding :
       {std::string(9, ' '), std::string(512, '\0'), std::string("end")}) {
    writeFile(file_, DicomMaker().bytes() + padding);
    EXPECT_EQ(nestingFault(file_), "") << padding.size();
  }
}

TEST_F(DicomNesting, ThatLiesIsTold) {
  // vtk-dicom would allocate what these say.
  const std::string liar = implicitElement(0x00080100, 0xF0000000, "");
  EXPECT_THAT(faultOf("UN", openItem(liar), true), HasSubstr("longer than the file"));
  EXPECT_THAT(faultOf("UN", implicitElement(0xFFFEE000, 0xF0000000, ""), true),
              HasSubstr("longer than its sequence"));
  EXPECT_THAT(faultOf("OB", implicitElement(0xFFFEE000, 0xF0000000, ""), true),
              HasSubstr("ends within its compressed data"));
  EXPECT_THAT(faultOf("UN", "abcdefgh", true), HasSubstr("something else than items"));
  const std::string text = implicitElement(0x00080100, "CODE  ");
  EXPECT_THAT(faultOf("UN", implicitElement(0xFFFEE000, 10, text) + SequenceEnd, true),
              HasSubstr("longer than"));
  EXPECT_THROW(readCt(file_), InvalidInput);
  EXPECT_THAT(faultOf("SQ", SequenceEnd + SequenceEnd, false), HasSubstr("longer than it says"));
  const std::string written("1.2.840.10008.1.2.1\0", 20);
  std::string bytes = DicomMaker().bytes();
  const std::size_t at = bytes.find(written);
  ASSERT_NE(at, std::string::npos);
  bytes[at + 3] = '\1';
  writeFile(file_, bytes);
  EXPECT_THAT(nestingFault(file_), HasSubstr("transfer syntax"));
  bytes.replace(at, written.size(), "1.2.840.10008.1.2.1.99");
  bytes[at - 2] = 22;
  bytes[132 + 8] = static_cast<char>(bytes[132 + 8] + 2);  // the group's length
  writeFile(file_, bytes);
  EXPECT_THAT(nestingFault(file_), HasSubstr("deflated as a whole"));
}

TEST_F(DicomNesting, ThatIsTooDeepIsTold) {
  const auto nested = [](int depth) {
    const std::string item = implicitElement(0xFFFEE000, Open, "");
    std::string content = item;
    for (int i = 0; i < depth; ++i) content += implicitElement(0x00081140, Open, item);
    content += implicitElement(0x00080100, "CODE  ");
    for (int i = 0; i <= depth; ++i) content += ItemEnd + SequenceEnd;
    return content;
  };
  EXPECT_EQ(faultOf("UN", nested(20), true), "");
  EXPECT_THAT(faultOf("UN", nested(40), true), HasSubstr("too deep"));
  // The parser would take more stack than there is.
  EXPECT_THAT(faultOf("UN", nested(200000), true), HasSubstr("too deep"));
}

}  // namespace
}  // namespace pneuma
