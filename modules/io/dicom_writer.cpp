#include "io/dicom_writer.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <string_view>

#include "core/error.h"
#include "core/units.h"

namespace pneuma {
namespace {

constexpr std::string_view CtImageStorage = "1.2.840.10008.5.1.4.1.1.2";
constexpr std::string_view ExplicitLittleEndian = "1.2.840.10008.1.2.1";
constexpr int Intercept = -1024;

void appendLittleEndian(std::string& bytes, std::uint64_t value, int count) {
  for (int i = 0; i < count; ++i) {
    bytes += static_cast<char>(static_cast<unsigned char>(value >> (8 * i)));
  }
}

/// Data elements in explicit VR little endian; they must come in the order of their tags.
class Elements {
 public:
  /// Text is padded to an even length as its representation wants.
  void text(std::uint32_t tag, std::string_view vr, std::string_view value) {
    std::string padded(value);
    if (padded.size() % 2 != 0) padded += vr == "UI" ? '\0' : ' ';
    element(tag, vr, padded);
  }

  void number(std::uint32_t tag, std::uint16_t value) {
    std::string bytes;
    appendLittleEndian(bytes, value, 2);
    element(tag, "US", bytes);
  }

  void signedNumber(std::uint32_t tag, std::int16_t value) {
    std::string bytes;
    appendLittleEndian(bytes, static_cast<std::uint16_t>(value), 2);
    element(tag, "SS", bytes);
  }

  void element(std::uint32_t tag, std::string_view vr, std::string_view value) {
    appendLittleEndian(bytes_, tag >> 16, 2);
    appendLittleEndian(bytes_, tag & 0xffffU, 2);
    bytes_ += vr;
    if (vr == "OB" || vr == "OW") {
      bytes_.append(2, '\0');
      appendLittleEndian(bytes_, value.size(), 4);
    } else {
      appendLittleEndian(bytes_, value.size(), 2);
    }
    bytes_ += value;
  }

  const std::string& bytes() const { return bytes_; }

 private:
  std::string bytes_;
};

/// A decimal string of DICOM: at most 16 characters.
std::string decimal(double value) {
  std::array<char, 32> text{};
  const double kept = std::abs(value) < 1e-12 ? 0.0 : value;
  for (int digits = 12; digits > 0; --digits) {
    const auto end = std::to_chars(text.data(), text.data() + text.size(), kept,
                                   std::chars_format::general, digits);
    const std::string_view result(text.data(), static_cast<std::size_t>(end.ptr - text.data()));
    if (result.size() <= 16) return std::string(result);
  }
  return "0";
}

std::string decimals(std::initializer_list<double> values) {
  std::string result;
  for (const double value : values) {
    if (!result.empty()) result += '\\';
    result += decimal(value);
  }
  return result;
}

/// Angle from the normal of the slices to the way from slice to slice, radians; positive where
/// higher slices lie further along the columns.
double tilt(const ImageGeometry& geometry) {
  const Vec3 normal = geometry.direction.col(0).cross(geometry.direction.col(1));
  const Vec3 up = geometry.direction.col(2);
  const double along = up.dot(geometry.direction.col(1));
  const double sign = up.dot(normal) < 0.0 ? -1.0 : 1.0;
  return std::atan2(along, sign * up.dot(normal));
}

/// What is the same in all files of a series.
struct Series {
  const CtImage& image;
  const DicomWriting& writing;
  std::string studyUid;
  std::string seriesUid;
  std::string frameUid;
};

std::string fileMeta(const std::string& instanceUid) {
  Elements meta;
  meta.element(0x00020001, "OB", std::string_view("\0\1", 2));
  meta.text(0x00020002, "UI", CtImageStorage);
  meta.text(0x00020003, "UI", instanceUid);
  meta.text(0x00020010, "UI", ExplicitLittleEndian);
  meta.text(0x00020012, "UI", uidOf("pneuma"));  // of the implementation
  meta.text(0x00020013, "SH", "PNEUMA");
  Elements length;
  std::string bytes;
  appendLittleEndian(bytes, meta.bytes().size(), 4);
  length.element(0x00020000, "UL", bytes);
  return std::string(128, '\0') + "DICM" + length.bytes() + meta.bytes();
}

void addGeneral(Elements& out, const Series& series, const std::string& instanceUid) {
  const DicomWriting& writing = series.writing;
  out.text(0x00080005, "CS", "ISO_IR 192");
  out.text(0x00080008, "CS", "ORIGINAL\\PRIMARY\\AXIAL");
  out.text(0x00080016, "UI", CtImageStorage);
  out.text(0x00080018, "UI", instanceUid);
  out.text(0x00080020, "DA", "20000101");
  out.text(0x00080030, "TM", "120000");
  out.text(0x00080050, "SH", "");
  out.text(0x00080060, "CS", "CT");
  out.text(0x00080070, "LO", "Pneuma");
  out.text(0x00080090, "PN", "");
  out.text(0x00081030, "LO", writing.studyDescription);
  out.text(0x0008103e, "LO", writing.seriesDescription);
  out.text(0x00100010, "PN", writing.patientName);
  out.text(0x00100020, "LO", writing.patientId);
  out.text(0x00100030, "DA", "");
  out.text(0x00100040, "CS", "");
  out.text(0x00180015, "CS", "CHEST");
  out.text(0x00180050, "DS", decimal(series.image.geometry.spacing.z()));
  out.text(0x00180060, "DS", "");
  const double tiltDeg = degrees(tilt(series.image.geometry));
  if (std::abs(tiltDeg) > 1e-6) out.text(0x00181120, "DS", decimal(tiltDeg));
  out.text(0x00181210, "SH", writing.kernel);
  out.text(0x00185100, "CS", "HFS");
}

void addPlace(Elements& out, const Series& series, int k) {
  const ImageGeometry& geometry = series.image.geometry;
  const Vec3 position = geometry.worldFromVoxel({0.0, 0.0, static_cast<double>(k)});
  const Vec3 row = geometry.direction.col(0);
  const Vec3 column = geometry.direction.col(1);
  out.text(0x0020000d, "UI", series.studyUid);
  out.text(0x0020000e, "UI", series.seriesUid);
  out.text(0x00200010, "SH", "1");
  out.text(0x00200011, "IS", "1");
  out.text(0x00200012, "IS", "");
  out.text(0x00200013, "IS", std::to_string(k + 1));
  out.text(0x00200032, "DS", decimals({position.x(), position.y(), position.z()}));
  out.text(0x00200037, "DS",
           decimals({row.x(), row.y(), row.z(), column.x(), column.y(), column.z()}));
  out.text(0x00200052, "UI", series.frameUid);
  out.text(0x00201040, "LO", "");
  out.text(0x00201041, "DS", decimal(position.dot(row.cross(column))));
}

void addPixels(Elements& out, const Series& series, int k) {
  const ImageGeometry& geometry = series.image.geometry;
  out.number(0x00280002, 1);
  out.text(0x00280004, "CS", "MONOCHROME2");
  out.number(0x00280010, static_cast<std::uint16_t>(geometry.size[1]));
  out.number(0x00280011, static_cast<std::uint16_t>(geometry.size[0]));
  out.text(0x00280030, "DS", decimals({geometry.spacing.y(), geometry.spacing.x()}));
  out.number(0x00280100, 16);
  out.number(0x00280101, 16);
  out.number(0x00280102, 15);
  out.number(0x00280103, 1);
  out.signedNumber(0x00280120, PaddingHu - Intercept);
  out.text(0x00281050, "DS", "-600");
  out.text(0x00281051, "DS", "1500");
  out.text(0x00281052, "DS", std::to_string(Intercept));
  out.text(0x00281053, "DS", "1");
  out.text(0x00281054, "LO", "HU");
  std::string stored;
  stored.reserve(2 * geometry.sliceCount());
  const std::size_t first = geometry.index(0, 0, k);
  for (std::size_t i = first; i < first + geometry.sliceCount(); ++i) {
    const int value = std::min(series.image.voxels[i] - Intercept, 32767);
    appendLittleEndian(stored, static_cast<std::uint16_t>(value), 2);
  }
  out.element(0x7fe00010, "OW", stored);
}

void requireSound(const ImageGeometry& geometry) {
  if (geometry.size[0] > 65535 || geometry.size[1] > 65535) {
    throw InvalidInput("slices of " + std::to_string(geometry.size[0]) + " x " +
                       std::to_string(geometry.size[1]) +
                       " voxels cannot be written as DICOM, which holds 65535 in a row");
  }
  if (std::abs(geometry.direction.col(0).dot(geometry.direction.col(1))) > 1e-6) {
    throw InvalidInput(
        "the rows and columns of the image are not perpendicular; DICOM cannot tell that, "
        "resample it first");
  }
}

}  // namespace

std::string uidOf(const std::string& text) {
  std::string hex = sha256(text).substr(0, 32);
  hex[12] = '8';  // version 8: made from something of one's own
  hex[16] = "89ab"[static_cast<unsigned char>(hex[16]) % 4];
  // From base 16 to base 10: digits with the lowest first.
  std::string digits(1, '\0');
  for (const char c : hex) {
    int carry = c <= '9' ? c - '0' : c - 'a' + 10;
    for (char& digit : digits) {
      carry += 16 * digit;
      digit = static_cast<char>(carry % 10);
      carry /= 10;
    }
    for (; carry > 0; carry /= 10) digits += static_cast<char>(carry % 10);
  }
  std::string uid = "2.25.";
  while (digits.size() > 1 && digits.back() == '\0') digits.pop_back();
  for (auto digit = digits.rbegin(); digit != digits.rend(); ++digit) {
    uid += static_cast<char>('0' + *digit);
  }
  return uid;
}

std::vector<std::string> dicomFileNames(const CtImage& image, const DicomWriting& writing) {
  std::vector<std::string> names;
  for (int k = 0; k < image.geometry.size[2]; ++k) {
    if (std::ranges::find(writing.leftOut, k) != writing.leftOut.end()) continue;
    const std::string number = std::to_string(k + 1);
    names.push_back("slice-" + std::string(4 - std::min<std::size_t>(number.size(), 4), '0') +
                    number + ".dcm");
  }
  return names;
}

void writeDicomSeries(const std::filesystem::path& folder, const CtImage& image,
                      const DicomWriting& writing, Existing existing, const Progress& progress) {
  requireSound(image.geometry);
  const Series series{image, writing, uidOf(writing.identity + " study"),
                      uidOf(writing.identity + " series"), uidOf(writing.identity + " frame")};
  const std::vector<std::string> names = dicomFileNames(image, writing);
  std::size_t file = 0;
  for (int k = 0; k < image.geometry.size[2]; ++k) {
    if (std::ranges::find(writing.leftOut, k) != writing.leftOut.end()) continue;
    progress.report(static_cast<double>(file) / static_cast<double>(names.size()));
    const std::string instanceUid = uidOf(writing.identity + " slice " + std::to_string(k));
    Elements elements;
    addGeneral(elements, series, instanceUid);
    addPlace(elements, series, k);
    addPixels(elements, series, k);
    writeFile(folder / names[file++], fileMeta(instanceUid) + elements.bytes(), existing);
  }
  progress.report(1.0);
}

}  // namespace pneuma
