#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace pneuma {

/// One attribute of a DICOM data set, its value as stored.
struct DicomElement {
  using DataSet = std::vector<DicomElement>;

  std::uint32_t tag = 0;  ///< group and element in one number: 0x00100010
  std::string vr;         ///< two letters, from the dictionary where the file does not say; "UN"
  std::string value;      ///< little endian, of even length; fragments as they are, if compressed
  std::vector<DataSet> items;  ///< of a sequence
  bool encapsulated =
      false;  ///< compressed pixels: value is all items up to the end of the sequence

  bool isPrivate() const { return (tag >> 16) % 2 == 1; }

  /// The value as text without padding.
  std::string text() const;
};

using DicomDataSet = DicomElement::DataSet;

/// A text value, padded to an even length as its representation asks.
DicomElement dicomText(std::uint32_t tag, const std::string& vr, std::string value);

/// A file of explicit or implicit little endian, whatever its pixels are compressed with.
struct DicomElements {
  DicomDataSet meta;  ///< group 0002, without its length
  DicomDataSet data;
  bool isExplicit = true;
};

/// Every element of a file, in its order.
/// @throws InvalidInput if it is damaged, Unsupported if it is big endian or deflated; `name` is in
/// the sentence
DicomElements dicomElements(std::string_view file, const std::string& name);

/// The file with these elements; tags must ascend. Pixels are written as they were read, bit for
/// bit; sequences get lengths.
std::string dicomFile(const DicomElements& elements);

}  // namespace pneuma
