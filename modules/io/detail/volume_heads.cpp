#include <bit>
#include <cmath>
#include <cstring>

#include <Eigen/LU>

#include "core/error.h"
#include "io/detail/nifti_struct.h"
#include "io/detail/text_fields.h"
#include "io/detail/volume_fields.h"
#include "io/detail/volume_formats.h"

namespace pneuma {
namespace {

std::string joined(const Vec3& v, std::string_view between) {
  std::string text;
  for (Eigen::Index i = 0; i < 3; ++i) {
    if (i > 0) text += between;
    appendNumber(text, v[i]);
  }
  return text;
}

std::string sizeText(const ImageGeometry& geometry) {
  return std::to_string(geometry.size[0]) + " " + std::to_string(geometry.size[1]) + " " +
         std::to_string(geometry.size[2]);
}

/// Where the axes come from, as MetaIO has it: "RAI" if they run left, back and up.
std::string anatomicalOrientation(const ImageGeometry& geometry) {
  constexpr std::array<std::string_view, 3> Letters = {"RL", "AP", "IS"};
  const AxisOrder order = patientAxes(geometry);
  std::string text = "???";
  for (std::size_t a = 0; a < 3; ++a) {
    text[static_cast<std::size_t>(order.from[a])] = Letters[a][order.flip[a] ? 1 : 0];
  }
  return text;
}

std::array<float, 3> floats(const Vec3& v) {
  return {static_cast<float>(v.x()), static_cast<float>(v.y()), static_cast<float>(v.z())};
}

void putSform(NiftiStruct& h, const ImageGeometry& geometry) {
  const Mat3 steps = turnedRound(geometry.steps());
  const Vec3 origin = turnedRound(geometry.origin);
  for (std::size_t row = 0; row < 3; ++row) {
    const auto r = static_cast<Eigen::Index>(row);
    const std::array<float, 3> xyz = floats(steps.row(r));
    h.srow[row] = {xyz[0], xyz[1], xyz[2], static_cast<float>(origin[r])};
  }
  h.sformCode = NiftiScannerFrame;
}

/// A quaternion has no skew: a volume with some is left with its sform alone.
void putQform(NiftiStruct& h, const ImageGeometry& geometry) {
  constexpr double Skewless = 1e-5;
  Mat3 rotation = turnedRound(geometry.direction);
  if (!(rotation.transpose() * rotation).isApprox(Mat3::Identity(), Skewless)) return;
  h.pixdim[0] = 1.0F;
  if (rotation.determinant() < 0.0) {
    rotation.col(2) = -rotation.col(2);
    h.pixdim[0] = -1.0F;
  }
  Eigen::Quaterniond q(rotation);
  q.normalize();
  if (q.w() < 0.0) q.coeffs() = -q.coeffs();
  h.quatern = floats(q.vec());
  h.qoffset = floats(turnedRound(geometry.origin));
  h.qformCode = NiftiScannerFrame;
}

}  // namespace

std::string niftiHead(const ImageGeometry& geometry, const StoredVoxels& voxels,
                      const std::string& name) {
  constexpr int LongestAxis = 32767;
  NiftiStruct h{};
  h.sizeofHdr = sizeof(h);
  h.dim = {3, 1, 1, 1, 1, 1, 1, 1};
  h.pixdim = {1.0F, 1.0F, 1.0F, 1.0F, 1.0F, 1.0F, 1.0F, 1.0F};
  for (std::size_t axis = 0; axis < 3; ++axis) {
    if (geometry.size[axis] > LongestAxis) {
      throw Unsupported("cannot write " + name +
                        ": NIfTI takes at most 32767 voxels along an axis, "
                        "not " +
                        std::to_string(geometry.size[axis]) + "; end its name in .nrrd");
    }
    h.dim[axis + 1] = static_cast<std::int16_t>(geometry.size[axis]);
    h.pixdim[axis + 1] = static_cast<float>(geometry.spacing[static_cast<Eigen::Index>(axis)]);
  }
  h.intentCode = voxels.labels ? NiftiLabels : std::int16_t{0};
  h.datatype = voxels.scalar == Scalar::Uint8 ? NiftiUint8 : NiftiInt16;
  h.bitpix = static_cast<std::int16_t>(8 * bytesOf(voxels.scalar));
  h.voxOffset = NiftiFirstVoxel;
  h.sclSlope = 1.0F;
  h.xyztUnits = NiftiMillimetres;
  std::memcpy(h.descrip.data(), "Pneuma", 6);
  putQform(h, geometry);
  putSform(h, geometry);
  std::memcpy(h.magic.data(), "n+1", 4);
  std::string head(NiftiFirstVoxel, '\0');
  std::memcpy(head.data(), &h, sizeof(h));
  return head;
}

std::string nrrdHead(const ImageGeometry& geometry, const StoredVoxels& voxels,
                     const std::string& encoding) {
  const Mat3 steps = geometry.steps();
  std::string directions;
  for (Eigen::Index axis = 0; axis < 3; ++axis) {
    directions += " (";
    directions += joined(steps.col(axis), ",") + ")";
  }
  return "NRRD0004\n"
         "# Complete NRRD file format specification at:\n"
         "# http://teem.sourceforge.net/nrrd/format.html\n"
         "content: Pneuma\n"
         "type: " +
         std::string(voxels.scalar == Scalar::Uint8 ? "uint8" : "int16") +
         "\ndimension: 3\nspace: left-posterior-superior\nsizes: " + sizeText(geometry) +
         "\nspace directions:" + directions +
         "\nkinds: domain domain domain\nendian: little\nencoding: " + encoding +
         "\nspace origin: (" + joined(geometry.origin, ",") + ")\n\n";
}

std::string metaImageHead(const ImageGeometry& geometry, const StoredVoxels& voxels,
                          std::uint64_t packedBytes) {
  constexpr std::size_t Digits = 15;
  const std::string bytes = std::to_string(packedBytes);
  std::string axes;
  for (Eigen::Index axis = 0; axis < 3; ++axis) {
    axes += ' ';
    axes += joined(geometry.direction.col(axis), " ");
  }
  return "ObjectType = Image\nComment = Pneuma\nNDims = 3\nBinaryData = True\n"
         "BinaryDataByteOrderMSB = False\nCompressedData = True\nCompressedDataSize = " +
         std::string(Digits - std::min(Digits, bytes.size()), ' ') + bytes +
         "\nTransformMatrix =" + axes + "\nOffset = " + joined(geometry.origin, " ") +
         "\nCenterOfRotation = 0 0 0\nAnatomicalOrientation = " + anatomicalOrientation(geometry) +
         "\nElementSpacing = " + joined(geometry.spacing, " ") +
         "\nDimSize = " + sizeText(geometry) +
         "\nElementType = " + (voxels.scalar == Scalar::Uint8 ? "MET_UCHAR" : "MET_SHORT") +
         "\nElementDataFile = LOCAL\n";
}

}  // namespace pneuma
