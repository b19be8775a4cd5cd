#include "io/detail/volume_formats.h"

#include "io/detail/nifti_struct.h"
#include "io/detail/text_fields.h"
#include "io/detail/unpacked_data.h"

namespace pneuma {
namespace {

struct ScalarRow {
  std::string_view name;
  std::size_t bytes;
};

/// In the order of Scalar.
constexpr std::array<ScalarRow, 10> Scalars = {{{"int8", 1},
                                                {"uint8", 1},
                                                {"int16", 2},
                                                {"uint16", 2},
                                                {"int32", 4},
                                                {"uint32", 4},
                                                {"int64", 8},
                                                {"uint64", 8},
                                                {"float32", 4},
                                                {"float64", 8}}};

/// MetaImage has no magic number: its first line is one of a few, and a later one is always there.
bool looksLikeMetaImage(std::string_view head) {
  const std::string_view line = head.substr(0, head.find('\n'));
  const std::string_view key = trimmed(line.substr(0, line.find_first_of("=:")));
  const bool first = key == "ObjectType" || key == "NDims" || key == "Comment" || key == "Name" ||
                     key == "ObjectSubType" || key == "ID";
  return first && key.size() < line.size() && head.find("DimSize") != std::string_view::npos;
}

bool looksLikeNifti(std::string_view head) {
  return head.size() >= NiftiHeaderBytes && isNiftiHeader(head);
}

}  // namespace

std::size_t bytesOf(Scalar scalar) { return Scalars[static_cast<std::size_t>(scalar)].bytes; }

std::string nameOf(Scalar scalar) {
  return std::string(Scalars[static_cast<std::size_t>(scalar)].name);
}

VolumeFormat formatOf(const ReadableFile& file) {
  std::array<char, 4096> bytes{};
  const std::string_view head(bytes.data(), file.read(bytes, 0));
  if (head.starts_with("NRRD")) return VolumeFormat::Nrrd;
  if (looksLikeMetaImage(head)) return VolumeFormat::MetaImage;
  if (looksLikeNifti(head)) return VolumeFormat::Nifti;
  if (!head.starts_with("\x1f\x8b")) return VolumeFormat::None;
  std::array<char, NiftiHeaderBytes> unpacked{};
  try {
    UnpackedData data(file, 0, true);
    const std::size_t count = data.read(unpacked);
    return looksLikeNifti({unpacked.data(), count}) ? VolumeFormat::Nifti : VolumeFormat::None;
  } catch (const InvalidInput&) {
    return VolumeFormat::None;  // a damaged file of which the name has to tell the kind
  }
}

}  // namespace pneuma
