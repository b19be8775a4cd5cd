#include <algorithm>

#include "core/error.h"
#include "io/detail/header_lines.h"
#include "io/detail/text_fields.h"
#include "io/detail/volume_fields.h"
#include "io/detail/volume_formats.h"

/// MetaImage as MetaIO defines it (itk.org/Wiki/MetaIO/Documentation).
namespace pneuma {
namespace {

struct MetaHeader {
  HeaderFields fields;
  std::size_t bytes = 0;  ///< up to the voxels
};

/// "Key = value" line by line; ElementDataFile is the last.
MetaHeader metaHeader(const ReadableFile& file, const std::string& name) {
  const std::string text = headerText(file);
  MetaHeader header;
  Lines lines(text);
  while (const std::optional<std::string_view> line = lines.next()) {
    const std::size_t mark = line->find_first_of("=:");
    const std::string_view key = trimmed(line->substr(0, mark));
    if (key.empty() && mark == std::string_view::npos) continue;
    if (mark == std::string_view::npos || key.empty()) {
      throw InvalidInput(name + ", line " + std::to_string(lines.number()) +
                         ": \"key = value\" was expected, not " + excerpt(*line) +
                         "; is the header damaged?");
    }
    header.fields.set(key, line->substr(mark + 1));
    if (lowerCase(key) != "elementdatafile") continue;
    const std::size_t end = static_cast<std::size_t>(line->data() - text.data()) + line->size();
    header.bytes = std::min(text.find('\n', end), text.size() - 1) + 1;
    return header;
  }
  throw InvalidInput(name + " is cut off: its header has no ElementDataFile; get it anew");
}

bool isTrue(const HeaderFields& fields, std::initializer_list<const char*> keys) {
  const std::string value = lowerCase(fields.firstOf(keys));
  return value == "true" || value == "t" || value == "1";
}

Scalar metaScalar(const HeaderFields& fields, const std::string& name) {
  constexpr std::array<std::pair<std::string_view, Scalar>, 12> Types = {
      {{"MET_CHAR", Scalar::Int8},
       {"MET_UCHAR", Scalar::Uint8},
       {"MET_SHORT", Scalar::Int16},
       {"MET_USHORT", Scalar::Uint16},
       {"MET_INT", Scalar::Int32},
       {"MET_UINT", Scalar::Uint32},
       {"MET_LONG", Scalar::Int32},  // 32 bits in every file, whatever a machine's long
       {"MET_ULONG", Scalar::Uint32},
       {"MET_LONG_LONG", Scalar::Int64},
       {"MET_ULONG_LONG", Scalar::Uint64},
       {"MET_FLOAT", Scalar::Float32},
       {"MET_DOUBLE", Scalar::Float64}}};
  const std::string_view type = fields["elementtype"];
  const auto* row = std::ranges::find(Types, type, &std::pair<std::string_view, Scalar>::first);
  if (row != Types.end()) return row->second;
  if (type.ends_with("_ARRAY")) {
    throw Unsupported(name + " holds vectors (" + excerpt(type) + "); export one volume of them");
  }
  throw InvalidInput(name + " has ElementType = " + excerpt(type) +
                     ", which MetaImage does not know; get it anew");
}

std::array<int, 3> sizeOf(const HeaderFields& fields, std::size_t dimensions,
                          const std::string& name) {
  std::vector<std::int64_t> sizes;
  std::string_view rest = fields["dimsize"];
  for (std::string_view word = takeWord(rest); !word.empty(); word = takeWord(rest)) {
    sizes.push_back(wholeNumberOf(word, "DimSize", name));
  }
  if (sizes.size() != dimensions) {
    throw InvalidInput(name + " has DimSize = " + excerpt(fields["dimsize"]) + " but NDims = " +
                       std::to_string(dimensions) + "; its header is damaged: get it anew");
  }
  return checkedSize(sizes, name);
}

Vec3 firstThree(const std::vector<double>& numbers) { return {numbers[0], numbers[1], numbers[2]}; }

ImageGeometry geometryOf(const HeaderFields& fields, VolumeHeader& header,
                         const std::string& name) {
  const std::int64_t dimensions = wholeNumberOf(fields["ndims"], "NDims", name);
  if (dimensions < 1 || dimensions > 10) {
    throw InvalidInput(name + " has NDims = " + std::to_string(dimensions) +
                       "; a volume has 3: get it anew");
  }
  const auto n = static_cast<std::size_t>(dimensions);
  const std::array<int, 3> size = sizeOf(fields, n, name);
  const std::string_view spacingText = fields.firstOf({"elementspacing", "elementsize"});
  if (spacingText.empty()) {
    throw InvalidInput(name + " does not say how far its voxels lie apart; add ElementSpacing");
  }
  const Vec3 spacing = firstThree(numbersOf(spacingText, n, "ElementSpacing", name));
  requirePositive(spacing, name);

  Mat3 direction = Mat3::Identity();
  const std::string_view matrix = fields.firstOf({"transformmatrix", "rotation", "orientation"});
  if (matrix.empty()) {
    header.notes.push_back(name +
                           " has no TransformMatrix: its axes were taken to run left, back "
                           "and up.");
  } else {
    const std::vector<double> numbers = numbersOf(matrix, n * n, "TransformMatrix", name);
    for (std::size_t axis = 0; axis < 3; ++axis) {  // one axis after the other, not row by row
      for (std::size_t row = 0; row < 3; ++row) {
        direction(static_cast<Eigen::Index>(row), static_cast<Eigen::Index>(axis)) =
            numbers[n * axis + row];
      }
    }
  }
  Vec3 origin = Vec3::Zero();
  const std::string_view offset = fields.firstOf({"offset", "position", "origin"});
  if (offset.empty()) {
    header.notes.push_back(name + " has no Offset: its first voxel was put at the origin.");
  } else {
    origin = firstThree(numbersOf(offset, n, "Offset", name));
  }
  double mm = 1.0;
  if (fields.has("distanceunits") && fields["distanceunits"] != "?") {
    mm = mmPer(fields["distanceunits"], name);
  }
  return checkedGeometry(size, direction * spacing.asDiagonal() * mm, origin * mm, name);
}

void readScale(const HeaderFields& fields, VolumeHeader& header, const std::string& name) {
  constexpr const char* Slope = "elementtointensityfunctionslope";
  constexpr const char* Offset = "elementtointensityfunctionoffset";
  if (fields.has(Slope)) header.slope = numbersOf(fields[Slope], 1, Slope, name).front();
  if (fields.has(Offset)) header.intercept = numbersOf(fields[Offset], 1, Offset, name).front();
  if (!std::isfinite(header.slope) || header.slope == 0.0 || !std::isfinite(header.intercept)) {
    throw InvalidInput(name + " gives its values a slope of " + numberText(header.slope) +
                       " and an offset of " + numberText(header.intercept) +
                       ", which leave no values; correct the header");
  }
}

void placeMetaData(const MetaHeader& header, VolumeLayout& layout, const ReadableFile& file,
                   const std::string& name) {
  const HeaderFields& fields = header.fields;
  const std::string_view dataFile = fields["elementdatafile"];
  if (lowerCase(dataFile) == "local") {
    layout.dataFile = file.path();
    layout.offset = header.bytes;
  } else {
    layout.dataFile = detachedFile(file.path(), dataFile);
    layout.offset = 0;
  }
  if (fields.has("headersize")) {
    const std::int64_t skip = wholeNumberOf(fields["headersize"], "HeaderSize", name);
    if (skip < -1) {
      throw InvalidInput(name + " has HeaderSize = " + std::to_string(skip) +
                         "; it must be -1, 0 or the bytes before the voxels");
    }
    if (skip == -1) layout.offset.reset();
    if (skip > 0) layout.offset = static_cast<std::uint64_t>(skip);
  }
  layout.compressed = isTrue(fields, {"compresseddata"});
  if (!layout.compressed) return;
  if (!layout.offset.has_value()) {
    throw Unsupported(name + " has compressed voxels with HeaderSize = -1; save it uncompressed");
  }
  if (fields.has("compresseddatasize")) {
    const std::int64_t bytes =
        wholeNumberOf(fields["compresseddatasize"], "CompressedDataSize", name);
    if (bytes > 0) layout.packedBytes = static_cast<std::uint64_t>(bytes);
  }
}

}  // namespace

VolumeLayout metaImageLayout(const ReadableFile& file) {
  const std::string name = quoted(file.path());
  const MetaHeader header = metaHeader(file, name);
  const HeaderFields& fields = header.fields;
  VolumeLayout layout;
  layout.header.format = "MetaImage";
  if (fields.has("objecttype") && lowerCase(fields["objecttype"]) != "image") {
    throw Unsupported(name + " holds a MetaIO object of type " + excerpt(fields["objecttype"]) +
                      ", not an image; give a volume");
  }
  if (fields.has("binarydata") && !isTrue(fields, {"binarydata"})) {
    throw Unsupported(name + " has its voxels as text; save it with BinaryData = True");
  }
  if (fields.has("elementnumberofchannels") &&
      wholeNumberOf(fields["elementnumberofchannels"], "ElementNumberOfChannels", name) != 1) {
    throw Unsupported(name + " has " + std::string(fields["elementnumberofchannels"]) +
                      " values to a voxel (colours or vectors); export one volume of them");
  }
  layout.scalar = metaScalar(fields, name);
  layout.bigEndian = isTrue(fields, {"binarydatabyteordermsb", "elementbyteordermsb"});
  layout.header.geometry = geometryOf(fields, layout.header, name);
  const std::string_view orientation = fields["anatomicalorientation"];
  if (!orientation.starts_with('?')) layout.header.space = orientation;
  readScale(fields, layout.header, name);
  placeMetaData(header, layout, file, name);
  return layout;
}

}  // namespace pneuma
