#include <algorithm>

#include "core/error.h"
#include "io/detail/header_lines.h"
#include "io/detail/nrrd_geometry.h"
#include "io/detail/text_fields.h"
#include "io/detail/volume_fields.h"
#include "io/detail/volume_formats.h"

/// NRRD as Teem defines it (teem.sourceforge.net/nrrd/format.html).
namespace pneuma {
namespace {

struct NrrdHeader {
  HeaderFields fields;
  std::optional<std::size_t> bytes;  ///< up to the voxels; none if the header fills the file
};

/// Teem's field names have spellings of their own.
std::string_view properField(std::string_view field) {
  if (field == "datafile") return "data file";
  if (field == "byteskip") return "byte skip";
  if (field == "lineskip") return "line skip";
  if (field == "axismins") return "axis mins";
  if (field == "centers" || field == "centering") return "centerings";
  return field;
}

/// "field: value" line by line up to an empty line; "key:=value" and comments say nothing here.
NrrdHeader nrrdHeader(const ReadableFile& file, const std::string& name) {
  const std::string text = headerText(file);
  NrrdHeader header;
  Lines lines(text);
  const std::string_view magic = lines.next().value_or("");
  if (magic.size() != 8 || !magic.starts_with("NRRD000") || magic[7] < '1' || magic[7] > '5') {
    throw Unsupported(name + " begins with " + excerpt(magic) +
                      ", a version of NRRD that is not known; save it as NRRD0004");
  }
  while (const std::optional<std::string_view> line = lines.next()) {
    if (line->empty()) {
      const std::size_t end = static_cast<std::size_t>(line->data() - text.data());
      header.bytes = std::min(text.find('\n', end), text.size() - 1) + 1;
      return header;
    }
    if (line->starts_with('#')) continue;
    const std::size_t mark = line->find(':');
    if (mark == std::string_view::npos) {
      throw InvalidInput(name + ", line " + std::to_string(lines.number()) +
                         ": \"field: value\" was expected, not " + excerpt(*line) +
                         "; is the header damaged?");
    }
    if (line->substr(mark).starts_with(":=")) continue;
    const std::string field = lowerCase(trimmed(line->substr(0, mark)));
    header.fields.set(properField(field), line->substr(mark + 1));
  }
  return header;
}

Scalar nrrdScalar(const HeaderFields& fields, const std::string& name) {
  using Row = std::pair<std::string_view, Scalar>;
  constexpr std::array<Row, 38> Types = {{{"signed char", Scalar::Int8},
                                          {"int8", Scalar::Int8},
                                          {"int8_t", Scalar::Int8},
                                          {"uchar", Scalar::Uint8},
                                          {"unsigned char", Scalar::Uint8},
                                          {"uint8", Scalar::Uint8},
                                          {"uint8_t", Scalar::Uint8},
                                          {"short", Scalar::Int16},
                                          {"short int", Scalar::Int16},
                                          {"signed short", Scalar::Int16},
                                          {"signed short int", Scalar::Int16},
                                          {"int16", Scalar::Int16},
                                          {"int16_t", Scalar::Int16},
                                          {"ushort", Scalar::Uint16},
                                          {"unsigned short", Scalar::Uint16},
                                          {"unsigned short int", Scalar::Uint16},
                                          {"uint16", Scalar::Uint16},
                                          {"uint16_t", Scalar::Uint16},
                                          {"int", Scalar::Int32},
                                          {"signed int", Scalar::Int32},
                                          {"int32", Scalar::Int32},
                                          {"int32_t", Scalar::Int32},
                                          {"uint", Scalar::Uint32},
                                          {"unsigned int", Scalar::Uint32},
                                          {"uint32", Scalar::Uint32},
                                          {"uint32_t", Scalar::Uint32},
                                          {"longlong", Scalar::Int64},
                                          {"long long", Scalar::Int64},
                                          {"long long int", Scalar::Int64},
                                          {"signed long long", Scalar::Int64},
                                          {"int64", Scalar::Int64},
                                          {"int64_t", Scalar::Int64},
                                          {"ulonglong", Scalar::Uint64},
                                          {"unsigned long long", Scalar::Uint64},
                                          {"uint64", Scalar::Uint64},
                                          {"uint64_t", Scalar::Uint64},
                                          {"float", Scalar::Float32},
                                          {"double", Scalar::Float64}}};
  const std::string type = lowerCase(fields["type"]);
  const auto* row = std::ranges::find(Types, type, &Row::first);
  if (row != Types.end()) return row->second;
  if (type == "block") {
    throw Unsupported(name + " holds blocks of bytes, not numbers; save it as short or float");
  }
  throw InvalidInput(name + " has the type " + excerpt(fields["type"]) +
                     ", which NRRD does not know; get it anew");
}

bool isCompressed(const HeaderFields& fields, const std::string& name) {
  const std::string encoding = lowerCase(fields["encoding"]);
  if (encoding == "raw") return false;
  if (encoding == "gzip" || encoding == "gz") return true;
  for (const std::string_view other : {"ascii", "text", "txt", "hex", "bzip2", "bz2", "zrl"}) {
    if (encoding != other) continue;
    throw Unsupported(name + " has its voxels in the encoding " + excerpt(encoding) +
                      "; save it as raw or gzip");
  }
  throw InvalidInput(name + " has the encoding " + excerpt(fields["encoding"]) +
                     ", which NRRD does not know; get it anew");
}

bool isBigEndian(const HeaderFields& fields, Scalar scalar, const std::string& name) {
  const std::string endian = lowerCase(fields["endian"]);
  if (endian == "little" || endian == "big") return endian == "big";
  if (endian.empty() && bytesOf(scalar) == 1) return false;
  throw InvalidInput(name +
                     (endian.empty() ? " does not say the byte order of its voxels"
                                     : " has the byte order " + excerpt(endian)) +
                     "; add \"endian: little\" or \"endian: big\" to its header");
}

void placeNrrdData(const NrrdHeader& header, VolumeLayout& layout, const ReadableFile& file,
                   const std::string& name) {
  const HeaderFields& fields = header.fields;
  if (fields.has("data file")) {
    layout.dataFile = detachedFile(file.path(), fields["data file"]);
    layout.offset = 0;
  } else if (header.bytes.has_value()) {
    layout.dataFile = file.path();
    layout.offset = *header.bytes;
  } else {
    throw InvalidInput(name +
                       " is cut off: no empty line ends its header, and no \"data file\" "
                       "is named; get it anew");
  }
  if (fields.has("line skip") && wholeNumberOf(fields["line skip"], "line skip", name) != 0) {
    throw Unsupported(name + " has lines of text before its voxels (line skip); save it anew");
  }
  if (!fields.has("byte skip")) return;
  const std::int64_t skip = wholeNumberOf(fields["byte skip"], "byte skip", name);
  if (skip < -1 || (skip == -1 && layout.compressed)) {
    throw InvalidInput(name + " has byte skip = " + std::to_string(skip) +
                       "; it must be 0 or the bytes before the voxels, or -1 in raw files");
  }
  if (skip == -1) {
    layout.offset.reset();
  } else if (layout.compressed) {
    layout.skip = static_cast<std::uint64_t>(skip);
  } else {
    *layout.offset += static_cast<std::uint64_t>(skip);
  }
}

}  // namespace

VolumeLayout nrrdLayout(const ReadableFile& file) {
  const std::string name = quoted(file.path());
  const NrrdHeader header = nrrdHeader(file, name);
  VolumeLayout layout;
  layout.header.format = "NRRD";
  layout.scalar = nrrdScalar(header.fields, name);
  layout.compressed = isCompressed(header.fields, name);
  layout.bigEndian = isBigEndian(header.fields, layout.scalar, name);
  readNrrdGeometry(header.fields, layout.header, name);
  placeNrrdData(header, layout, file, name);
  return layout;
}

}  // namespace pneuma
