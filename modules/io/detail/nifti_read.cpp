#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>

#include "core/error.h"
#include "io/detail/nifti_struct.h"
#include "io/detail/text_fields.h"
#include "io/detail/unpacked_data.h"
#include "io/detail/volume_fields.h"

namespace pneuma {
namespace {

constexpr std::int32_t Nifti2Bytes = 540;

template <class T>
void swapBytes(T& value) {
  auto bytes = std::bit_cast<std::array<char, sizeof(T)>>(value);
  std::reverse(bytes.begin(), bytes.end());
  value = std::bit_cast<T>(bytes);
}

template <class T, std::size_t N>
void swapBytes(std::array<T, N>& values) {
  for (T& value : values) swapBytes(value);
}

/// The fields that are read here, from the other byte order.
void swapFields(NiftiStruct& h) {
  swapBytes(h.sizeofHdr);
  swapBytes(h.dim);
  swapBytes(h.datatype);
  swapBytes(h.bitpix);
  swapBytes(h.pixdim);
  swapBytes(h.voxOffset);
  swapBytes(h.sclSlope);
  swapBytes(h.sclInter);
  swapBytes(h.qformCode);
  swapBytes(h.sformCode);
  swapBytes(h.quatern);
  swapBytes(h.qoffset);
  swapBytes(h.srow);
}

Scalar scalarOf(const NiftiStruct& h, const std::string& name) {
  switch (h.datatype) {
    case NiftiUint8:
      return Scalar::Uint8;
    case NiftiInt16:
      return Scalar::Int16;
    case 8:
      return Scalar::Int32;
    case 16:
      return Scalar::Float32;
    case 64:
      return Scalar::Float64;
    case 256:
      return Scalar::Int8;
    case 512:
      return Scalar::Uint16;
    case 768:
      return Scalar::Uint32;
    case 1024:
      return Scalar::Int64;
    case 1280:
      return Scalar::Uint64;
    case 128:
    case 2304:
      throw Unsupported(name + " holds colours (RGB), not HU or labels; export it in grey");
    case 1:
    case 32:
    case 1536:
    case 1792:
    case 2048:
      throw Unsupported(name + " holds bits, complex or 128-bit numbers (NIfTI datatype " +
                        std::to_string(h.datatype) + "); save it as int16 or float32");
    default:
      throw InvalidInput(name + " has the datatype " + std::to_string(h.datatype) +
                         ", which NIfTI does not know; get it anew");
  }
}

std::array<int, 3> sizeOf(const NiftiStruct& h, const std::string& name) {
  if (h.dim[0] < 1 || h.dim[0] > 7) {
    throw InvalidInput(name + " says it has " + std::to_string(h.dim[0]) +
                       " dimensions; its header is damaged: get it anew");
  }
  const std::vector<std::int64_t> sizes(h.dim.begin() + 1, h.dim.begin() + 1 + h.dim[0]);
  return checkedSize(sizes, name);
}

double mmPerUnit(const NiftiStruct& h, VolumeHeader& header, const std::string& name) {
  switch (h.xyztUnits & 7) {
    case 0:
      header.notes.push_back(name + " does not name its unit of length; it was taken for mm.");
      return 1.0;
    case 1:
      header.notes.push_back(name + " measures in metres; they were turned into mm.");
      return 1000.0;
    case NiftiMillimetres:
      return 1.0;
    case 3:
      header.notes.push_back(name + " measures in micrometres; they were turned into mm.");
      return 1e-3;
    default:
      throw InvalidInput(name + " has the unit of length " + std::to_string(h.xyztUnits & 7) +
                         ", which NIfTI does not know; get it anew");
  }
}

/// From voxels to RAS, in the unit of the file.
struct Affine {
  Mat3 steps = Mat3::Zero();
  Vec3 origin = Vec3::Zero();
};

Affine sform(const NiftiStruct& h) {
  Affine affine;
  for (int row = 0; row < 3; ++row) {
    const auto& source = h.srow[static_cast<std::size_t>(row)];
    for (int column = 0; column < 3; ++column) {
      affine.steps(row, column) = source[static_cast<std::size_t>(column)];
    }
    affine.origin[row] = source[3];
  }
  return affine;
}

Vec3 spacingOf(const NiftiStruct& h, const std::string& name) {
  const Vec3 spacing(h.pixdim[1], h.pixdim[2], h.pixdim[3]);
  requirePositive(spacing, name);
  return spacing;
}

Affine qform(const NiftiStruct& h, const std::string& name) {
  const Vec3 bcd(h.quatern[0], h.quatern[1], h.quatern[2]);
  const double rest = 1.0 - bcd.squaredNorm();
  if (!(rest > -1e-5)) {
    throw InvalidInput(name +
                       " has a quaternion that is no rotation; its header is damaged: get it anew");
  }
  Eigen::Quaterniond rotation(std::sqrt(std::max(rest, 0.0)), bcd.x(), bcd.y(), bcd.z());
  rotation.normalize();
  Vec3 spacing = spacingOf(h, name);
  if (h.pixdim[0] < 0.0F) spacing.z() = -spacing.z();  // qfac: a left-handed volume
  return {rotation.toRotationMatrix() * spacing.asDiagonal(),
          Vec3(h.qoffset[0], h.qoffset[1], h.qoffset[2])};
}

/// Largest distance between the places that two affines give the corners of a volume.
double disagreement(const Affine& a, const Affine& b, const std::array<int, 3>& size) {
  double largest = 0.0;
  for (unsigned corner = 0; corner < 8; ++corner) {
    Vec3 voxel;
    for (unsigned axis = 0; axis < 3; ++axis)
      voxel[axis] = (corner >> axis & 1U) * (size[axis] - 1);
    const Vec3 difference = (a.steps - b.steps) * voxel + a.origin - b.origin;
    largest = std::max(largest, difference.norm());
  }
  return largest;
}

/// True if the qform gives the same places as the sform.
bool agrees(const Affine& affine, const NiftiStruct& h, const std::array<int, 3>& size,
            const std::string& name) {
  // Of a voxel. A quaternion of floats may be off by half a milliradian.
  constexpr double Tolerance = 0.5;
  try {
    return disagreement(affine, qform(h, name), size) <=
           Tolerance * affine.steps.colwise().norm().minCoeff();
  } catch (const InvalidInput&) {
    return false;
  }
}

Affine affineOf(const NiftiStruct& h, const std::array<int, 3>& size, VolumeHeader& header,
                const std::string& name) {
  if (h.sformCode > 0) {
    header.space = "RAS (sform)";
    const Affine affine = sform(h);
    if (h.qformCode > 0 && !agrees(affine, h, size, name)) {
      header.notes.push_back(name +
                             " has a qform that differs from its sform; the sform was taken.");
    }
    return affine;
  }
  if (h.qformCode > 0) {
    header.space = "RAS (qform)";
    return qform(h, name);
  }
  header.notes.push_back(name +
                         " says nothing about orientation (neither qform nor sform): its axes were "
                         "taken to run right, forward and up, so left and right may be swapped.");
  return {Mat3(spacingOf(h, name).asDiagonal()), Vec3::Zero()};
}

/// value = slope * stored + intercept; a slope of 0 or NaN stands for none.
void readScale(const NiftiStruct& h, VolumeHeader& header, const std::string& name) {
  if (!std::isfinite(h.sclSlope) || h.sclSlope == 0.0F) return;
  if (!std::isfinite(h.sclInter)) {
    throw InvalidInput(name + " has a slope but no number as intercept; get it anew");
  }
  header.slope = h.sclSlope;
  header.intercept = h.sclInter;
}

void requireSingleNifti1(const NiftiStruct& h, const std::string& name) {
  const std::string_view magic(h.magic.data(), 3);
  if (h.sizeofHdr == Nifti2Bytes) {
    throw Unsupported(name + " is NIfTI-2; save it as NIfTI-1 (.nii.gz)");
  }
  if (magic == "ni1") {
    throw Unsupported(name + " is one of a pair of files (.hdr and .img); save it as one .nii.gz");
  }
  if (magic != "n+1") {
    throw Unsupported(name +
                      " lacks the mark of NIfTI-1; if it is Analyze 7.5, which does not tell "
                      "left from right, save it as NIfTI (.nii.gz)");
  }
}

}  // namespace

bool isNiftiHeader(std::string_view head) {
  std::int32_t first = 0;
  std::memcpy(&first, head.data(), sizeof(first));
  std::int32_t swapped = first;
  swapBytes(swapped);
  const auto is = [&](std::int32_t size) { return first == size || swapped == size; };
  return is(sizeof(NiftiStruct)) || (is(Nifti2Bytes) && head.substr(4, 2) == "n+");
}

VolumeLayout niftiLayout(const ReadableFile& file) {
  const std::string name = quoted(file.path());
  VolumeLayout layout;
  layout.header.format = "NIfTI";
  layout.dataFile = file.path();
  std::array<char, 2> start{};
  layout.compressed = file.read(start, 0) == 2 && start[0] == '\x1f' && start[1] == '\x8b';
  std::array<char, sizeof(NiftiStruct)> bytes{};
  UnpackedData data(file, 0, layout.compressed);
  if (data.read(bytes) < bytes.size()) {
    throw InvalidInput(name + " is cut off within its header; get it anew");
  }
  auto h = std::bit_cast<NiftiStruct>(bytes);
  layout.bigEndian = h.sizeofHdr != sizeof(NiftiStruct) && h.sizeofHdr != Nifti2Bytes;
  if (layout.bigEndian) swapFields(h);
  requireSingleNifti1(h, name);
  layout.scalar = scalarOf(h, name);
  if (h.bitpix != 0 && static_cast<std::size_t>(h.bitpix) != 8 * bytesOf(layout.scalar)) {
    throw InvalidInput(name + " says its values are " + nameOf(layout.scalar) + " of " +
                       std::to_string(h.bitpix) + " bits; its header is damaged: get it anew");
  }
  const std::array<int, 3> size = sizeOf(h, name);
  const double mm = mmPerUnit(h, layout.header, name);
  const Affine affine = affineOf(h, size, layout.header, name);
  layout.header.geometry = checkedGeometry(size, turnedRound(Mat3(affine.steps * mm)),
                                           turnedRound(Vec3(affine.origin * mm)), name);
  readScale(h, layout.header, name);
  if (!(h.voxOffset >= NiftiFirstVoxel && h.voxOffset <= 1e9F)) {
    throw InvalidInput(name + " says its voxels begin at byte " + numberText(h.voxOffset) +
                       ", but they cannot begin before byte 352; its header is damaged: get it "
                       "anew");
  }
  const auto first = static_cast<std::uint64_t>(h.voxOffset);
  layout.offset = layout.compressed ? 0 : first;
  layout.skip = layout.compressed ? first : 0;
  return layout;
}

}  // namespace pneuma
