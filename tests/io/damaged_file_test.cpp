#include <cstdlib>
#include <functional>

#include <gtest/gtest.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPolyData.h>
#include <vtkSmartPointer.h>
#include <vtkUnstructuredGrid.h>
#include <vtkXMLPolyDataReader.h>
#include <vtkXMLPolyDataWriter.h>
#include <vtkXMLUnstructuredGridWriter.h>

#include "core/error.h"
#include "core/random.h"
#include "io/atomic_file.h"
#include "io/surface_file.h"
#include "io/tree_file.h"
#include "io_samples.h"
#include "temp_folder.h"

/// Whatever happens to a file, reading it ends with an Error or a sound result, and without a word
/// on the terminal.
namespace pneuma {
namespace {

using testing::sampleSurface;
using testing::sampleTree;
using testing::TempFolder;

/// How often a file is damaged at random; PNEUMA_FUZZ_TRIALS for a longer search.
int trials() {
  const char* text = std::getenv("PNEUMA_FUZZ_TRIALS");
  return text == nullptr ? 300 : std::atoi(text);
}

struct Format {
  std::string name;
  std::function<std::string()> content;
  std::function<void(const std::filesystem::path&)> read;
};

void PrintTo(const Format& format, std::ostream* out) { *out << format.name; }

Format treeFormat(const std::string& extension) {
  return {"tree." + extension,
          [extension] {
            return treeText(sampleTree(), extension, {{"seed", "1"}});
          },
          [](const std::filesystem::path& path) { readTree(path); }};
}

Format surfaceFormat(const std::string& extension) {
  return {"surface." + extension,
          [extension] {
            const TempFolder folder;
            writeSurface(folder / ("s." + extension), sampleSurface());
            return readFile(folder / ("s." + extension));
          },
          [](const std::filesystem::path& path) { readSurface(path); }};
}

enum class Encoding { Text, Inline, AppendedBase64, AppendedRaw };

/// The sample tree as another program would write it.
template <class Writer>
std::string encoded(vtkDataObject* data, Encoding encoding, int compressor) {
  vtkNew<Writer> writer;
  writer->SetInputData(data);
  writer->WriteToOutputStringOn();
  writer->SetCompressorType(compressor);
  writer->SetBlockSize(128);  // several blocks to an array
  if (encoding == Encoding::Text) writer->SetDataModeToAscii();
  if (encoding == Encoding::Inline) writer->SetDataModeToBinary();
  if (encoding == Encoding::AppendedRaw) writer->EncodeAppendedDataOff();
  writer->Write();
  return writer->GetOutputString();
}

vtkSmartPointer<vtkPolyData> samplePolyData() {
  vtkNew<vtkXMLPolyDataReader> reader;
  reader->ReadFromInputStringOn();
  reader->SetInputString(treeText(sampleTree(), "vtp", {{"seed", "1"}}));
  reader->Update();
  return reader->GetOutput();
}

Format foreignVtp(const std::string& name, Encoding encoding, int compressor) {
  return {name + ".vtp",
          [=] { return encoded<vtkXMLPolyDataWriter>(samplePolyData(), encoding, compressor); },
          [](const std::filesystem::path& path) { readTree(path); }};
}

Format foreignVtu(const std::string& name, Encoding encoding, int compressor) {
  return {name + ".vtu",
          [=] {
            const auto polyData = samplePolyData();
            vtkNew<vtkUnstructuredGrid> grid;
            grid->SetPoints(polyData->GetPoints());
            grid->SetCells(VTK_POLY_LINE, polyData->GetLines());
            grid->GetPointData()->ShallowCopy(polyData->GetPointData());
            return encoded<vtkXMLUnstructuredGridWriter>(grid, encoding, compressor);
          },
          [](const std::filesystem::path& path) { readTree(path); }};
}

class DamagedFile : public ::testing::TestWithParam<Format> {
 protected:
  /// Reads the content as a file of the format; true if it was accepted.
  bool accepts(const std::string& content) {
    try {
      GetParam().read(folder_.put(GetParam().name, content));
    } catch (const Error&) {
      return false;
    }
    return true;
  }

 private:
  TempFolder folder_;
};

TEST_P(DamagedFile, IsRefusedWhereverItWasCutOff) {
  const std::string content = GetParam().content();
  ASSERT_TRUE(accepts(content));
  ::testing::internal::CaptureStderr();
  for (std::size_t part = 0; part < 16; ++part) {
    EXPECT_FALSE(accepts(content.substr(0, content.size() * part / 16))) << part << "/16";
  }
  // The last bytes, where little seems to be missing.
  for (std::size_t missing = 2; missing < 60; ++missing) {
    EXPECT_FALSE(accepts(content.substr(0, content.size() - missing))) << missing << " missing";
  }
  EXPECT_EQ(::testing::internal::GetCapturedStderr(), "");
}

TEST_P(DamagedFile, NeverCrashesOnChangedBytes) {
  const std::string content = GetParam().content();
  Random random(3 + trials());
  ::testing::internal::CaptureStderr();
  for (int trial = 0; trial < trials(); ++trial) {
    std::string changed = content;
    for (std::uint64_t i = 0; i <= random.below(4); ++i) {
      changed[random.below(changed.size())] = static_cast<char>(random.below(256));
    }
    accepts(changed);
  }
  EXPECT_EQ(::testing::internal::GetCapturedStderr(), "");
}

TEST_P(DamagedFile, NeverCrashesOnChangedDigits) {
  const std::string content = GetParam().content();
  std::vector<std::size_t> digits;
  for (std::size_t i = 0; i < content.size(); ++i) {
    if (content[i] >= '0' && content[i] <= '9') digits.push_back(i);
  }
  if (digits.empty()) return;
  Random random(4 + trials());
  ::testing::internal::CaptureStderr();
  for (int trial = 0; trial < trials(); ++trial) {
    std::string changed = content;
    const std::size_t place = digits[random.below(digits.size())];
    const std::vector<std::string> texts = {"-1", "999999999", "4294967296", "1e30", "nan",
                                            "\"", ""};
    changed.replace(place, 1, texts[random.below(texts.size())]);
    accepts(changed);
  }
  EXPECT_EQ(::testing::internal::GetCapturedStderr(), "");
}

TEST_P(DamagedFile, IsRefusedIfItIsGarbage) {
  Random random(5);
  std::string garbage(20000, '\0');
  for (char& byte : garbage) byte = static_cast<char>(random.below(256));
  EXPECT_FALSE(accepts(garbage));
  EXPECT_FALSE(accepts(std::string(1000, '\0')));
  EXPECT_FALSE(accepts(std::string(1000, '\n')));
  EXPECT_FALSE(accepts(std::string(100000, '[')));
  std::string nested = "<VTKFile>";
  for (int i = 0; i < 100000; ++i) nested += "<a>";
  EXPECT_FALSE(accepts(nested + "</VTKFile>"));
}

INSTANTIATE_TEST_SUITE_P(Formats, DamagedFile,
                         ::testing::Values(treeFormat("vtp"), treeFormat("swc"), treeFormat("csv"),
                                           treeFormat("json"), surfaceFormat("stl"),
                                           surfaceFormat("obj"), surfaceFormat("ply"),
                                           surfaceFormat("vtp")));

INSTANTIATE_TEST_SUITE_P(
    Encodings, DamagedFile,
    ::testing::Values(foreignVtp("text", Encoding::Text, vtkXMLWriter::NONE),
                      foreignVtp("inline", Encoding::Inline, vtkXMLWriter::NONE),
                      foreignVtp("inline_zlib", Encoding::Inline, vtkXMLWriter::ZLIB),
                      foreignVtp("zlib", Encoding::AppendedBase64, vtkXMLWriter::ZLIB),
                      foreignVtp("raw_lz4", Encoding::AppendedRaw, vtkXMLWriter::LZ4),
                      foreignVtp("raw_lzma", Encoding::AppendedRaw, vtkXMLWriter::LZMA),
                      foreignVtu("raw", Encoding::AppendedRaw, vtkXMLWriter::NONE),
                      foreignVtu("zlib", Encoding::AppendedRaw, vtkXMLWriter::ZLIB)));

}  // namespace
}  // namespace pneuma
