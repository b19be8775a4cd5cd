#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "core/math.h"

namespace pneuma {

/// A linear map of vectors.
using Mat3 = Eigen::Matrix3d;

/// Where the voxels of an image lie. The centre of voxel (i, j, k) is
/// origin + direction * (i, j, k) * spacing, LPS, mm.
struct ImageGeometry {
  std::array<int, 3> size{};          ///< voxels along i, j, k
  Vec3 spacing = Vec3::Ones();        ///< mm from voxel to voxel along i, j, k; positive
  Vec3 origin = Vec3::Zero();         ///< centre of voxel (0, 0, 0)
  Mat3 direction = Mat3::Identity();  ///< columns: unit vectors of i, j, k. May be oblique and
                                      ///< left-handed; skew where a gantry was tilted

  bool operator==(const ImageGeometry&) const = default;

  std::size_t voxelCount() const {
    return static_cast<std::size_t>(size[0]) * static_cast<std::size_t>(size[1]) *
           static_cast<std::size_t>(size[2]);
  }

  /// Voxels of one slice, of one k.
  std::size_t sliceCount() const {
    return static_cast<std::size_t>(size[0]) * static_cast<std::size_t>(size[1]);
  }

  /// Where voxel (i, j, k) stands in Image::voxels.
  std::size_t index(int i, int j, int k) const {
    return static_cast<std::size_t>(i) +
           static_cast<std::size_t>(size[0]) *
               (static_cast<std::size_t>(j) +
                static_cast<std::size_t>(size[1]) * static_cast<std::size_t>(k));
  }

  /// The columns are the steps from voxel to voxel, mm.
  Mat3 steps() const { return direction * spacing.asDiagonal(); }

  Vec3 worldFromVoxel(const Vec3& voxel) const { return origin + steps() * voxel; }

  /// Fractional voxel coordinates of a point.
  Vec3 voxelFromWorld(const Vec3& p) const { return steps().inverse() * (p - origin); }

  double voxelMm3() const;

  /// Of the voxels' outer faces.
  Box3 bounds() const;
};

/// A value for every voxel, i fastest, then j, then k.
template <class T>
struct Image {
  using value_type = T;

  ImageGeometry geometry;
  std::vector<T> voxels;

  T& at(int i, int j, int k) { return voxels[geometry.index(i, j, k)]; }

  const T& at(int i, int j, int k) const { return voxels[geometry.index(i, j, k)]; }
};

/// Radiodensity in Hounsfield units.
using CtImage = Image<std::int16_t>;

/// Values of Lobe (anatomy/lobe.h), 0 outside the lungs and airways.
using LabelImage = Image<std::uint8_t>;

/// What stands in a CT where nothing was measured: outside the circle that a scanner sees.
inline constexpr std::int16_t PaddingHu = -2048;

/// Which axis of an image runs along which axis of the patient, for reading it as if it were not
/// turned: axis `a` of the turned image is axis `from[a]` of the original, backwards where
/// `flip[a]`.
struct AxisOrder {
  std::array<int, 3> from{0, 1, 2};
  std::array<bool, 3> flip{};

  bool operator==(const AxisOrder&) const = default;

  bool isIdentity() const { return *this == AxisOrder{}; }
};

/// The order under which i runs to the left, j to the back and k up, as nearly as the axes allow.
AxisOrder patientAxes(const ImageGeometry& geometry);

/// The order that undoes `order`.
AxisOrder inverse(const AxisOrder& order);

/// The same voxels at the same places, stored in another order.
ImageGeometry turned(const ImageGeometry& geometry, const AxisOrder& order);
template <class T>
Image<T> turned(const Image<T>& image, const AxisOrder& order);

extern template CtImage turned(const CtImage&, const AxisOrder&);
extern template LabelImage turned(const LabelImage&, const AxisOrder&);

}  // namespace pneuma
