#include "io/detail/dicom_header.h"

#include <algorithm>
#include <cmath>
#include <fstream>
#include <utility>

#include <vtkDICOMMetaData.h>
#include <vtkDICOMParser.h>
#include <vtkDICOMUtilities.h>
#include <vtkNew.h>

#include "io/detail/dicom_nesting.h"
#include "io/detail/person_words.h"
#include "io/detail/text_fields.h"
#include "io/detail/vtk_errors.h"

namespace pneuma {
namespace {

constexpr unsigned int Encapsulated = 0xFFFFFFFF;  // length of compressed pixel data
constexpr int MostPixels = 1 << 15;                // along a row or column; no detector has more
constexpr std::string_view CtStorage = "1.2.840.10008.5.1.4.1.1.2";  // and enhanced CT
constexpr int MostFrames = 100000;

constexpr std::array<std::pair<DC::EnumType, const char*>, 22> IdentifierTags = {{
    {DC::PatientName, "PatientName"},
    {DC::PatientID, "PatientID"},
    {DC::PatientBirthDate, "PatientBirthDate"},
    {DC::PatientSex, "PatientSex"},
    {DC::PatientAge, "PatientAge"},
    {DC::PatientSize, "PatientSize"},
    {DC::PatientWeight, "PatientWeight"},
    {DC::OtherPatientIDs, "OtherPatientIDs"},
    {DC::PatientAddress, "PatientAddress"},
    {DC::AccessionNumber, "AccessionNumber"},
    {DC::StudyID, "StudyID"},
    {DC::StudyDate, "StudyDate"},
    {DC::StudyDescription, "StudyDescription"},
    {DC::AcquisitionDate, "AcquisitionDate"},
    {DC::InstitutionName, "InstitutionName"},
    {DC::InstitutionAddress, "InstitutionAddress"},
    {DC::ReferringPhysicianName, "ReferringPhysicianName"},
    {DC::PerformingPhysicianName, "PerformingPhysicianName"},
    {DC::OperatorsName, "OperatorsName"},
    {DC::StationName, "StationName"},
    {DC::StudyInstanceUID, "StudyInstanceUID"},
    {DC::SeriesInstanceUID, "SeriesInstanceUID"},
}};

enum class Coding { Plain, Compressed, Unreadable };

Coding codingOf(const std::string& transferSyntax) {
  static constexpr std::array<std::string_view, 5> Plain = {
      "", "1.2.840.10008.1.2", "1.2.840.10008.1.2.1", "1.2.840.10008.1.2.2", "1.2.840.113619.5.2"};
  // JPEG 8 and 12 bit, lossless (two), JPEG-LS (two), JPEG 2000 (two), RLE
  static constexpr std::array<std::string_view, 9> Compressed = {
      "1.2.840.10008.1.2.4.50", "1.2.840.10008.1.2.4.51", "1.2.840.10008.1.2.4.57",
      "1.2.840.10008.1.2.4.70", "1.2.840.10008.1.2.4.80", "1.2.840.10008.1.2.4.81",
      "1.2.840.10008.1.2.4.90", "1.2.840.10008.1.2.4.91", "1.2.840.10008.1.2.5"};
  if (std::ranges::find(Plain, transferSyntax) != Plain.end()) return Coding::Plain;
  return std::ranges::find(Compressed, transferSyntax) != Compressed.end() ? Coding::Compressed
                                                                           : Coding::Unreadable;
}

std::string syntaxName(const std::string& uid) {
  const char* name = vtkDICOMUtilities::GetUIDName(uid.c_str());
  return name == nullptr || *name == '\0' ? uid : name;
}

/// The attributes of one file, read in one go.
class Attributes {
 public:
  explicit Attributes(vtkDICOMMetaData& data) : data_(data) {}

  bool has(vtkDICOMTag tag) const { return data_.Get(0, tag).IsValid(); }

  std::string text(vtkDICOMTag tag) const {
    const vtkDICOMValue& value = data_.Get(0, tag);
    return value.IsValid() ? std::string(trimmed(value.AsUTF8String())) : std::string();
  }

  double number(vtkDICOMTag tag, double otherwise, int frame = 0) const {
    const vtkDICOMValue& value = data_.Get(0, frame, tag);
    return value.IsValid() && value.GetNumberOfValues() > 0 ? value.GetDouble(0) : otherwise;
  }

  int whole(vtkDICOMTag tag, int otherwise) const {
    const vtkDICOMValue& value = data_.Get(0, tag);
    return value.IsValid() && value.GetNumberOfValues() > 0 ? value.GetInt(0) : otherwise;
  }

  /// Nothing unless there are at least `count` finite numbers.
  std::optional<std::vector<double>> numbers(vtkDICOMTag tag, std::size_t count, int frame) const {
    const vtkDICOMValue& value = data_.Get(0, frame, tag);
    if (!value.IsValid() || value.GetNumberOfValues() < count) return std::nullopt;
    std::vector<double> result(count);
    for (std::size_t i = 0; i < count; ++i) {
      // An empty component is no number, though vtk-dicom takes it for 0.
      if (trimmed(value.GetString(i)).empty()) return std::nullopt;
      result[i] = value.GetDouble(i);
      if (!std::isfinite(result[i])) return std::nullopt;
    }
    return result;
  }

 private:
  vtkDICOMMetaData& data_;
};

/// A value of 16 bits, read as the pixels are.
std::optional<int> paddingValue(const Attributes& attributes, vtkDICOMTag tag, bool isSigned) {
  if (!attributes.has(tag)) return std::nullopt;
  const int value = attributes.whole(tag, 0);
  return isSigned ? static_cast<int>(static_cast<std::int16_t>(value)) : value & 0xFFFF;
}

void setFault(DicomHeader& header, ExitCode code, std::string sentence) {
  if (!header.fault.empty()) return;
  header.fault = std::move(sentence);
  header.faultCode = code;
}

/// Size and place of every frame.
void readFrames(DicomHeader& header, const Attributes& attributes, int frames) {
  DicomSlice slice = header.series.slices.front();
  header.series.slices.clear();
  for (int frame = 0; frame < frames; ++frame) {
    slice.frame = frame;
    const auto position = attributes.numbers(DC::ImagePositionPatient, 3, frame);
    const auto axes = attributes.numbers(DC::ImageOrientationPatient, 6, frame);
    const auto spacing = attributes.numbers(DC::PixelSpacing, 2, frame);
    slice.slope = attributes.number(DC::RescaleSlope, 1.0, frame);
    slice.intercept = attributes.number(DC::RescaleIntercept, 0.0, frame);
    if (position) slice.position = Vec3((*position)[0], (*position)[1], (*position)[2]);
    header.series.slices.push_back(slice);
    if (!position || !axes) {
      setFault(header, ExitCode::InputInvalid,
               "does not say where it lies in the patient (image position and orientation)");
      return;
    }
    if (!spacing || (*spacing)[0] <= 0.0 || (*spacing)[1] <= 0.0) {
      setFault(header, ExitCode::InputInvalid,
               spacing ? "states a pixel spacing of " + numberText((*spacing)[0]) + " x " +
                             numberText((*spacing)[1]) + " mm, which must be positive"
                       : std::string("does not state its pixel spacing"));
      return;
    }
    if (!std::isfinite(slice.slope) || !std::isfinite(slice.intercept) || slice.slope == 0.0) {
      setFault(header, ExitCode::InputInvalid,
               "states a rescale slope of " + numberText(slice.slope) + " and an intercept of " +
                   numberText(slice.intercept) + ", which give no HU");
      return;
    }
    const Vec3 row((*axes)[0], (*axes)[1], (*axes)[2]);
    const Vec3 column((*axes)[3], (*axes)[4], (*axes)[5]);
    if (std::abs(row.norm() - 1.0) > 0.01 || std::abs(column.norm() - 1.0) > 0.01 ||
        std::abs(row.dot(column)) > 0.01) {
      setFault(header, ExitCode::InputInvalid, "states directions that are no right angle");
      return;
    }
    const Vec3 unitRow = row.normalized();
    if (frame > 0 && (header.row - unitRow).norm() > 1e-3) {
      setFault(header, ExitCode::InputInvalid, "holds frames of different orientation");
      return;
    }
    header.row = unitRow;
    header.column = (column - unitRow * unitRow.dot(column)).normalized();
    header.pixelMm = {(*spacing)[1], (*spacing)[0]};  // stated as distance of rows, of columns
  }
}

/// Whether pixels of this kind can be read, and all are there.
void checkPixels(DicomHeader& header, const Attributes& attributes, vtkDICOMParser& parser,
                 int frames) {
  const DicomSeries& series = header.series;
  const std::string syntax = attributes.text(DC::TransferSyntaxUID);
  const int bits = attributes.whole(DC::BitsAllocated, 0);
  if (header.samplesPerPixel != 1 || header.photometric != "MONOCHROME2") {
    setFault(header, ExitCode::Unsupported,
             "is a picture in " + (header.photometric.empty() ? "colour" : header.photometric) +
                 ", not a CT slice in grey values (MONOCHROME2)");
  } else if (codingOf(syntax) == Coding::Unreadable) {
    setFault(header, ExitCode::Unsupported,
             "is compressed as '" + syntaxName(syntax) +
                 "', which is not supported; convert it, for example with gdcmconv --raw");
  } else if (series.rows <= 0 || series.columns <= 0 || series.rows > MostPixels ||
             series.columns > MostPixels || frames > MostFrames) {
    setFault(header, ExitCode::InputInvalid,
             "states a size of " + std::to_string(series.columns) + " x " +
                 std::to_string(series.rows) + " pixels, which cannot be");
  } else if ((bits != 8 && bits != 16) || series.slices.front().bitsStored < 1 ||
             series.slices.front().bitsStored > bits) {
    setFault(header, ExitCode::Unsupported,
             "holds " + std::to_string(series.slices.front().bitsStored) + " bits in " +
                 std::to_string(bits) + ", not up to 16 in 8 or 16");
  } else if (parser.GetPixelDataVL() != Encapsulated && codingOf(syntax) == Coding::Plain) {
    const std::int64_t needed = std::int64_t{series.rows} * series.columns * frames * (bits / 8);
    const std::int64_t there = std::min<std::int64_t>(
        parser.GetPixelDataVL(), parser.GetFileSize() - parser.GetFileOffset());
    if (there < needed) {
      setFault(header, ExitCode::InputInvalid,
               "ends early: " + std::to_string(there) + " of " + std::to_string(needed) +
                   " bytes of pixels are there; copy it again from its source");
    }
  }
}

}  // namespace

bool isDicomFile(const std::filesystem::path& file) {
  // Opening a pipe would wait for somebody who writes to it.
  std::error_code error;
  return std::filesystem::is_regular_file(file, error) &&
         vtkDICOMUtilities::IsDICOMFile(file.c_str());
}

std::optional<DicomHeader> readDicomHeader(const std::filesystem::path& file,
                                           const std::string& name) {
  std::error_code error;
  if (!std::filesystem::is_regular_file(file, error) || !std::ifstream(file, std::ios::binary)) {
    throw InputMissing(quotedName(name) + " cannot be read; check its permissions");
  }
  if (!isDicomFile(file)) return std::nullopt;
  if (const std::string fault = nestingFault(file); !fault.empty()) {
    DicomHeader unsound;
    setFault(unsound, ExitCode::InputInvalid, fault);
    return unsound;
  }
  const vtkNew<vtkDICOMMetaData> data;
  const vtkNew<vtkDICOMParser> parser;
  const VtkErrors errors(static_cast<vtkObject&>(*parser));
  parser->SetMetaData(data);
  parser->SetFileName(file.c_str());
  parser->Update();
  const Attributes attributes(*data);

  DicomHeader header;
  DicomSeries& series = header.series;
  series.modality = attributes.text(DC::Modality);
  series.description = attributes.text(DC::SeriesDescription);
  series.kernel = attributes.text(DC::ConvolutionKernel);
  series.bodyPart = attributes.text(DC::BodyPartExamined);
  series.imageType = attributes.text(DC::ImageType);
  series.number = attributes.whole(DC::SeriesNumber, 0);
  series.rows = attributes.whole(DC::Rows, 0);
  series.columns = attributes.whole(DC::Columns, 0);
  series.thicknessMm = attributes.number(DC::SliceThickness, 0.0);
  series.uid = attributes.text(DC::SeriesInstanceUID);
  const std::string syntax = attributes.text(DC::TransferSyntaxUID);
  if (codingOf(syntax) != Coding::Plain) series.compression = syntaxName(syntax);
  for (const auto& [tag, keyword] : IdentifierTags) {
    const std::string value = attributes.text(tag);
    if (!value.empty()) series.identifiers[keyword] = value;
  }
  series.description = withoutPerson(series.description, series.identifiers);
  header.instanceUid = attributes.text(DC::SOPInstanceUID);
  header.photometric = attributes.text(DC::PhotometricInterpretation);
  header.samplesPerPixel = attributes.whole(DC::SamplesPerPixel, 1);
  header.hasPixels = parser->GetPixelDataFound() || attributes.has(DC::Rows);
  header.localizer = series.imageType.find("LOCALIZER") != std::string::npos;

  DicomSlice slice;
  slice.file = file;
  slice.name = name;
  slice.isSigned = attributes.whole(DC::PixelRepresentation, 0) != 0;
  slice.bitsStored = attributes.whole(DC::BitsStored, 16);
  slice.padding = paddingValue(attributes, DC::PixelPaddingValue, slice.isSigned);
  slice.paddingLimit = paddingValue(attributes, DC::PixelPaddingRangeLimit, slice.isSigned);
  series.slices = {slice};
  if (!header.hasPixels) {
    // A CT without a picture was cut off within its header.
    if (attributes.text(DC::MediaStorageSOPClassUID).starts_with(CtStorage)) {
      setFault(header, ExitCode::InputInvalid, "is cut off; copy it again from its source");
    }
    return header;
  }

  const int frames = std::max(1, attributes.whole(DC::NumberOfFrames, 1));
  checkPixels(header, attributes, *parser, frames);
  if (!parser->GetPixelDataFound() || parser->GetErrorCode() != 0) {
    setFault(header, ExitCode::InputInvalid,
             "is cut off or damaged" + (errors.first().empty() ? "" : " (" + errors.first() + ")") +
                 "; copy it again from its source");
  }
  if (header.fault.empty()) readFrames(header, attributes, frames);
  return header;
}

}  // namespace pneuma
