#include <algorithm>

#include "core/error.h"
#include "io/detail/text_fields.h"
#include "io/detail/volume_formats.h"
#include "io/detail/voxel_data.h"
#include "io/volume_file.h"

namespace pneuma {
namespace {

constexpr std::string_view VolumeFormats =
    "NIfTI (.nii, .nii.gz), NRRD (.nrrd, .nhdr) or MetaImage (.mha, .mhd)";

/// The format that the name promises, "" if none.
std::string formatOfName(const std::filesystem::path& path) {
  const std::string name = lowerCase(path.filename().string());
  if (name.ends_with(".nii") || name.ends_with(".nii.gz")) return "NIfTI";
  if (name.ends_with(".nrrd") || name.ends_with(".nhdr")) return "NRRD";
  if (name.ends_with(".mha") || name.ends_with(".mhd")) return "MetaImage";
  return "";
}

VolumeLayout layoutOf(const ReadableFile& file) {
  switch (formatOf(file)) {
    case VolumeFormat::Nifti:
      return niftiLayout(file);
    case VolumeFormat::Nrrd:
      return nrrdLayout(file);
    case VolumeFormat::MetaImage:
      return metaImageLayout(file);
    case VolumeFormat::None:
      break;
  }
  const std::string name = quoted(file.path());
  if (file.size() == 0) {
    throw InvalidInput(name + " is empty; give a volume as " + std::string(VolumeFormats));
  }
  const std::string promised = formatOfName(file.path());
  if (promised.empty()) {
    throw Unsupported(name + " is not a volume that can be read; give " +
                      std::string(VolumeFormats));
  }
  throw InvalidInput(name + " is damaged or no " + promised +
                     " file, although its name says so; get it anew");
}

/// Everything but the voxels, checked.
VolumeLayout checkedLayout(const std::filesystem::path& path) {
  const ReadableFile file(path);
  VolumeLayout layout = layoutOf(file);
  VolumeHeader& header = layout.header;
  header.scalarType = nameOf(layout.scalar);
  header.dataFile = layout.dataFile;
  header.memoryBytes = header.geometry.voxelCount() * sizeof(CtImage::value_type);
  const std::string promised = formatOfName(path);
  if (!promised.empty() && promised != header.format) {
    header.notes.push_back(quoted(path) + " was read as " + header.format +
                           ", which it holds whatever its name.");
  }
  requireRoomForVoxels(layout);
  return layout;
}

}  // namespace

bool isVolumeFileName(const std::filesystem::path& path) { return !formatOfName(path).empty(); }

bool isVolumeFile(const std::filesystem::path& path) {
  try {
    return formatOf(ReadableFile(path)) != VolumeFormat::None || isVolumeFileName(path);
  } catch (const InputMissing&) {
    std::error_code ignored;
    return isVolumeFileName(path) && !std::filesystem::is_directory(path, ignored);
  }
}

VolumeHeader readVolumeHeader(const std::filesystem::path& path) {
  return checkedLayout(path).header;
}

CtImage readHuVolume(const std::filesystem::path& path, const Progress& progress) {
  const VolumeLayout layout = checkedLayout(path);
  return {layout.header.geometry, huVoxels(layout, progress)};
}

LabelImage readLabelVolume(const std::filesystem::path& path, const Progress& progress) {
  const VolumeLayout layout = checkedLayout(path);
  return {layout.header.geometry, labelVoxels(layout, progress)};
}

}  // namespace pneuma
