#include "core/error.h"
#include "io/detail/packed_writer.h"
#include "io/detail/text_fields.h"
#include "io/detail/volume_fields.h"
#include "io/detail/volume_formats.h"
#include "io/volume_file.h"

namespace pneuma {
namespace {

void writePlain(AtomicFile& file, std::span<const char> bytes, const Progress& progress) {
  constexpr std::size_t Piece = std::size_t{1} << 22;
  for (std::size_t done = 0; done < bytes.size(); done += Piece) {
    progress.report(static_cast<double>(done) / static_cast<double>(bytes.size()));
    const auto piece = bytes.subspan(done, std::min(Piece, bytes.size() - done));
    file.write({piece.data(), piece.size()});
  }
  progress.report(1.0);
}

template <class T>
void requireWritable(const Image<T>& image) {
  if (image.voxels.empty() || image.voxels.size() != image.geometry.voxelCount()) {
    throw InvalidInput("the volume cannot be written: it has " +
                       std::to_string(image.voxels.size()) + " voxels, but its size asks for " +
                       std::to_string(image.geometry.voxelCount()));
  }
  checkedGeometry(image.geometry.size, image.geometry.steps(), image.geometry.origin,
                  "the volume to be written");
}

template <class T>
void write(const std::filesystem::path& path, const Image<T>& image, Existing existing,
           const Progress& progress) {
  requireWritable(image);
  const std::string extension = lowerCase(path.filename().string());
  const ImageGeometry& geometry = image.geometry;
  const std::span<const char> bytes(reinterpret_cast<const char*>(image.voxels.data()),
                                    image.voxels.size() * sizeof(T));
  const StoredVoxels stored =
      sizeof(T) == 1 ? StoredVoxels{Scalar::Uint8, true} : StoredVoxels{Scalar::Int16, false};
  if (extension.ends_with(".nii") || extension.ends_with(".nii.gz")) {
    const std::string head = niftiHead(geometry, stored, quoted(path));
    AtomicFile file(path, existing);
    if (extension.ends_with(".gz")) {
      writePacked(file, Wrapper::Gzip, head, bytes, progress);
    } else {
      file.write(head);
      writePlain(file, bytes, progress);
    }
    file.commit();
  } else if (extension.ends_with(".nrrd")) {
    AtomicFile file(path, existing);
    file.write(nrrdHead(geometry, stored, "gzip"));
    writePacked(file, Wrapper::Gzip, {}, bytes, progress);
    file.commit();
  } else if (extension.ends_with(".mha")) {
    AtomicFile file(path, existing);
    file.write(metaImageHead(geometry, stored, 0));
    const std::uint64_t packed = writePacked(file, Wrapper::Zlib, {}, bytes, progress);
    file.overwrite(0, metaImageHead(geometry, stored, packed));
    file.commit();
  } else {
    throw Unsupported("cannot write " + quoted(path) +
                      " as a volume; end its name in .nii.gz, .nii, .nrrd or .mha");
  }
}

}  // namespace

void writeVolume(const std::filesystem::path& path, const CtImage& image, Existing existing,
                 const Progress& progress) {
  write(path, image, existing, progress);
}

void writeVolume(const std::filesystem::path& path, const LabelImage& labels, Existing existing,
                 const Progress& progress) {
  write(path, labels, existing, progress);
}

}  // namespace pneuma
