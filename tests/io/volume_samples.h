#pragma once

#include <cstring>
#include <string>
#include <vector>

#include <zlib.h>

#include "core/image.h"
#include "core/units.h"
#include "io/detail/nifti_struct.h"

namespace pneuma::testing {

/// Axes of size 12, 7 and 10 at uneven spacing, with values of which none comes twice in a row.
inline CtImage sampleCt() {
  CtImage image;
  image.geometry.size = {12, 7, 10};
  image.geometry.spacing = {0.7, 1.3, 2.5};
  image.geometry.origin = {-161.3, 42.5, -1203.75};
  image.voxels.resize(image.geometry.voxelCount());
  for (std::size_t i = 0; i < image.voxels.size(); ++i) {
    image.voxels[i] = static_cast<std::int16_t>(static_cast<int>(i * 37 % 4096) - 1024);
  }
  return image;
}

inline LabelImage sampleLabels() {
  const CtImage ct = sampleCt();
  LabelImage labels{ct.geometry, {}};
  for (const std::int16_t hu : ct.voxels) labels.voxels.push_back(hu % 7 == 0 ? 10 : 0);
  return labels;
}

/// Values as bytes, the most significant first if asked.
template <class T>
std::string bytesOfValues(const std::vector<T>& values, bool bigEndian = false) {
  std::string bytes;
  for (const T value : values) {
    std::string own(sizeof(T), '\0');
    std::memcpy(own.data(), &value, sizeof(T));
    bytes += bigEndian ? std::string(own.rbegin(), own.rend()) : own;
  }
  return bytes;
}

/// Packed as zlib does it, with gzip's head and tail if asked.
inline std::string packed(const std::string& bytes, bool gzip = true) {
  z_stream stream{};
  deflateInit2(&stream, 6, Z_DEFLATED, gzip ? 31 : 15, 8, Z_DEFAULT_STRATEGY);
  std::string out(deflateBound(&stream, bytes.size()) + 64, '\0');
  stream.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(bytes.data()));
  stream.avail_in = static_cast<uInt>(bytes.size());
  stream.next_out = reinterpret_cast<Bytef*>(out.data());
  stream.avail_out = static_cast<uInt>(out.size());
  deflate(&stream, Z_FINISH);
  out.resize(stream.total_out);
  deflateEnd(&stream);
  return out;
}

/// 4 x 3 x 2 voxels of int16, 0 to 23, 1 x 2 x 3 mm, at RAS (10, 20, 30).
inline NiftiStruct smallNifti() {
  NiftiStruct h{};
  h.sizeofHdr = 348;
  h.dim = {3, 4, 3, 2, 1, 1, 1, 1};
  h.pixdim = {1, 1, 2, 3, 1, 1, 1, 1};
  h.datatype = NiftiInt16;
  h.bitpix = 16;
  h.voxOffset = 352;
  h.xyztUnits = NiftiMillimetres;
  h.srow = {{{1, 0, 0, 10}, {0, 2, 0, 20}, {0, 0, 3, 30}}};
  h.sformCode = 1;
  std::memcpy(h.magic.data(), "n+1", 4);
  return h;
}

inline std::vector<std::int16_t> smallValues() {
  std::vector<std::int16_t> values;
  for (std::int16_t i = 0; i < 24; ++i) values.push_back(i);
  return values;
}

inline std::string smallBytes() { return bytesOfValues(smallValues()); }

inline std::string niftiBytes(const NiftiStruct& h, const std::string& voxels = smallBytes()) {
  std::string bytes(352, '\0');
  std::memcpy(bytes.data(), &h, sizeof(h));
  return bytes + voxels;
}

/// A text header of lines of which some are replaced ("key: value" by its key) or, where the new
/// one is the key alone, taken out.
inline std::string withLines(const std::vector<std::string>& lines,
                             const std::vector<std::string>& changes) {
  const auto keyOf = [](const std::string& line) {
    const std::string key = line.substr(0, line.find_first_of("=:"));
    return key.substr(0, key.find_last_not_of(' ') + 1);
  };
  std::string text;
  std::vector<std::string> added = changes;
  for (const std::string& line : lines) {
    std::string chosen = line;
    for (const std::string& change : changes) {
      if (keyOf(change) == keyOf(line)) chosen = change;
    }
    std::erase(added, chosen);
    if (chosen != keyOf(chosen) || chosen == line) text += chosen + "\n";
  }
  // What is new goes before the last line, which ends a MetaImage's header.
  std::string extra;
  for (const std::string& change : added) extra += change + "\n";
  const std::size_t last = text.find_last_of('\n', text.size() - 2) + 1;
  return text.insert(last, extra);
}

inline std::string nrrdHeader(const std::vector<std::string>& changes = {}) {
  return withLines(
      {"NRRD0004", "type: short", "dimension: 3", "space: left-posterior-superior", "sizes: 4 3 2",
       "space directions: (1,0,0) (0,2,0) (0,0,3)", "kinds: domain domain domain", "endian: little",
       "encoding: raw", "space origin: (10,20,30)"},
      changes);
}

/// The small volume as NRRD.
inline std::string nrrdBytes(const std::vector<std::string>& changes = {},
                             const std::string& voxels = smallBytes()) {
  return nrrdHeader(changes) + "\n" + voxels;
}

/// The small volume as MetaImage.
inline std::string metaBytes(const std::vector<std::string>& changes = {},
                             const std::string& voxels = smallBytes()) {
  return withLines(
             {"ObjectType = Image", "NDims = 3", "BinaryData = True",
              "BinaryDataByteOrderMSB = False", "CompressedData = False",
              "TransformMatrix = 1 0 0 0 1 0 0 0 1", "Offset = 10 20 30",
              "CenterOfRotation = 0 0 0", "AnatomicalOrientation = RAI", "ElementSpacing = 1 2 3",
              "DimSize = 4 3 2", "ElementType = MET_SHORT", "ElementDataFile = LOCAL"},
             changes) +
         voxels;
}

}  // namespace pneuma::testing
