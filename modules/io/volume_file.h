#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "core/image.h"
#include "core/progress.h"
#include "io/atomic_file.h"

namespace pneuma {

/// What a volume file says before its voxels are read.
struct VolumeHeader {
  ImageGeometry geometry;  ///< LPS, mm, whatever the file's frame and unit; axes not turned
  std::string format;      ///< "NIfTI", "NRRD", "MetaImage"
  std::string scalarType;  ///< of the stored values: "int16", "uint8", "float32", ...
  double slope = 1.0;      ///< value = slope * stored + intercept
  double intercept = 0.0;
  std::string space;               ///< the frame in the file's own words, "" if it names none
  std::vector<std::string> notes;  ///< whole sentences: what was assumed or converted
  std::uint64_t memoryBytes = 0;   ///< of the CtImage that it will become
  std::filesystem::path dataFile;  ///< where its voxels are: the file itself, or one beside it
};

/// True if the content is NIfTI, NRRD or MetaImage; where the content cannot be read, if the name
/// is such a file's.
bool isVolumeFile(const std::filesystem::path& path);

/// True for .nii, .nii.gz, .nrrd, .nhdr, .mha and .mhd.
bool isVolumeFileName(const std::filesystem::path& path);

/// Reads everything but the voxels of NIfTI-1 (.nii, .nii.gz), NRRD (attached or detached; raw or
/// gzip) and MetaImage (attached or detached; raw or zlib). The content decides on the format,
/// then the extension. A data file beside the header must be a plain name in the same folder.
/// @throws InputMissing (also for the data file), InvalidInput (damaged, cut off, too long, absurd
/// sizes, no sound geometry), Unsupported (one slice, 4-D, colours, other encodings)
VolumeHeader readVolumeHeader(const std::filesystem::path& path);

/// A volume in HU: slope and intercept applied, rounded to whole numbers.
/// @throws as readVolumeHeader; InvalidInput for a value that is no number or that int16 does not
/// hold, for damaged compressed data; Error (OutOfMemory) before anything is allocated; Cancelled
CtImage readHuVolume(const std::filesystem::path& path, const Progress& progress = {});

/// A volume of labels.
/// @throws as readHuVolume; InvalidInput for a value that is no whole number from 0 to 255
LabelImage readLabelVolume(const std::filesystem::path& path, const Progress& progress = {});

/// Writes NIfTI-1 (.nii, .nii.gz), NRRD (.nrrd, gzip) or MetaImage (.mha, zlib) by the extension,
/// aside and renamed. The same image gives the same bytes.
/// @throws OutputFailed; Unsupported for another extension, and for axes of more than 32767 voxels
/// in NIfTI; Cancelled: nothing is left behind
void writeVolume(const std::filesystem::path& path, const CtImage& image,
                 Existing existing = Existing::Replace, const Progress& progress = {});
void writeVolume(const std::filesystem::path& path, const LabelImage& labels,
                 Existing existing = Existing::Replace, const Progress& progress = {});

}  // namespace pneuma
