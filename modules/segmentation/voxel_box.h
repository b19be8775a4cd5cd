#pragma once

#include <algorithm>
#include <array>
#include <cstddef>

#include "core/image.h"

namespace pneuma {

/// A box of voxels in an image: from `low`, `size` of them. It may reach beyond the image.
struct VoxelBox {
  Eigen::Vector3i low = Eigen::Vector3i::Zero();
  std::array<int, 3> size{};

  std::size_t voxelCount() const {
    return static_cast<std::size_t>(size[0]) * static_cast<std::size_t>(size[1]) *
           static_cast<std::size_t>(size[2]);
  }

  std::size_t index(int i, int j, int k) const {
    return static_cast<std::size_t>(i) +
           static_cast<std::size_t>(size[0]) *
               (static_cast<std::size_t>(j) +
                static_cast<std::size_t>(size[1]) * static_cast<std::size_t>(k));
  }
};

/// The box from voxel `low` to voxel `high`, both included, `margin` voxels larger on every side.
inline VoxelBox boxAround(const Eigen::Vector3i& low, const Eigen::Vector3i& high,
                          const Eigen::Vector3i& margin = Eigen::Vector3i::Ones()) {
  const Eigen::Vector3i size = high - low + 2 * margin + Eigen::Vector3i::Ones();
  return {low - margin, {size.x(), size.y(), size.z()}};
}

/// The part of a box that lies in the image.
inline VoxelBox within(const VoxelBox& box, const ImageGeometry& geometry) {
  VoxelBox part;
  for (int axis = 0; axis < 3; ++axis) {
    const auto a = static_cast<std::size_t>(axis);
    part.low[axis] = std::max(box.low[axis], 0);
    part.size[a] =
        std::max(std::min(box.low[axis] + box.size[a], geometry.size[a]) - part.low[axis], 0);
  }
  return part;
}

/// Calls `f(inBox, inImage, count)` for every row of a slice of the box, k counted in the box: the
/// indices of its first voxel that lies in the image, and the number of those that do.
template <class F>
void forEachRow(const VoxelBox& box, const ImageGeometry& geometry, int k, F&& f) {
  const int slice = box.low.z() + k;
  if (slice < 0 || slice >= geometry.size[2]) return;
  const int first = std::max(-box.low.x(), 0);
  const int end = std::min(box.size[0], geometry.size[0] - box.low.x());
  if (first >= end) return;
  for (int j = 0; j < box.size[1]; ++j) {
    const int row = box.low.y() + j;
    if (row < 0 || row >= geometry.size[1]) continue;
    f(box.index(first, j, k), geometry.index(box.low.x() + first, row, slice),
      static_cast<std::size_t>(end - first));
  }
}

template <class F>
void forEachRow(const VoxelBox& box, const ImageGeometry& geometry, F&& f) {
  for (int k = 0; k < box.size[2]; ++k) forEachRow(box, geometry, k, f);
}

}  // namespace pneuma
