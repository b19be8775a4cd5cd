#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "io/detail/input_file.h"
#include "io/volume_file.h"

/// The single formats behind readHuVolume() and writeVolume().
namespace pneuma {

/// How one value stands in a file.
enum class Scalar { Int8, Uint8, Int16, Uint16, Int32, Uint32, Int64, Uint64, Float32, Float64 };

std::size_t bytesOf(Scalar scalar);

/// "int16" and so on.
std::string nameOf(Scalar scalar);

/// Where the voxels of a file stand, and how.
struct VolumeLayout {
  VolumeHeader header;
  Scalar scalar = Scalar::Int16;
  bool bigEndian = false;
  bool compressed = false;                   ///< zlib or gzip; which one its first bytes tell
  std::filesystem::path dataFile;            ///< the file itself unless the header is detached
  std::optional<std::uint64_t> offset;       ///< of the data in that file; none: they are its end
  std::uint64_t skip = 0;                    ///< unpacked bytes before the first voxel
  std::optional<std::uint64_t> packedBytes;  ///< size of compressed data, where the header tells

  /// Of all voxels, unpacked.
  std::uint64_t voxelBytes() const { return header.geometry.voxelCount() * bytesOf(scalar); }
};

enum class VolumeFormat { None, Nifti, Nrrd, MetaImage };

/// By the first bytes, unpacked if they are gzip.
VolumeFormat formatOf(const ReadableFile& file);

// Read a header, whole and consistent or not at all.
// @throws InvalidInput, Unsupported
VolumeLayout niftiLayout(const ReadableFile& file);
VolumeLayout nrrdLayout(const ReadableFile& file);
VolumeLayout metaImageLayout(const ReadableFile& file);

inline constexpr std::size_t NiftiHeaderBytes = 348;

/// Where the voxels of a single NIfTI file may begin: after the header and the mark of extensions.
inline constexpr std::size_t NiftiFirstVoxel = 352;

/// What a written file says about its voxels.
struct StoredVoxels {
  Scalar scalar = Scalar::Int16;  ///< little endian
  bool labels = false;
};

// The bytes before the voxels. @throws Unsupported
std::string niftiHead(const ImageGeometry& geometry, const StoredVoxels& voxels,
                      const std::string& name);
std::string nrrdHead(const ImageGeometry& geometry, const StoredVoxels& voxels,
                     const std::string& encoding);
/// `packedBytes` takes the same room whatever it is, so that it can be filled in afterwards.
std::string metaImageHead(const ImageGeometry& geometry, const StoredVoxels& voxels,
                          std::uint64_t packedBytes);

}  // namespace pneuma
