#include "core/image.h"

#include <algorithm>
#include <cmath>

#include "core/parallel.h"

namespace pneuma {

double ImageGeometry::voxelMm3() const { return std::abs(steps().determinant()); }

Box3 ImageGeometry::bounds() const {
  Box3 box;
  for (int corner = 0; corner < 8; ++corner) {
    Vec3 voxel;
    for (int axis = 0; axis < 3; ++axis) {
      const bool high = ((corner >> axis) & 1) != 0;
      voxel[axis] = high ? size[static_cast<std::size_t>(axis)] - 0.5 : -0.5;
    }
    box.extend(worldFromVoxel(voxel));
  }
  return box;
}

AxisOrder patientAxes(const ImageGeometry& geometry) {
  // Of the six ways to pair the axes the one with the largest cosines altogether, so that axes at
  // 45 degrees cannot both claim the same one.
  std::array<int, 3> pairing{0, 1, 2};
  AxisOrder best;
  double bestSum = -1.0;
  do {
    double sum = 0.0;
    for (int a = 0; a < 3; ++a) {
      sum += std::abs(geometry.direction(a, pairing[static_cast<std::size_t>(a)]));
    }
    if (sum > bestSum + 1e-9) {
      bestSum = sum;
      best.from = pairing;
    }
  } while (std::next_permutation(pairing.begin(), pairing.end()));
  for (int a = 0; a < 3; ++a) {
    const auto axis = static_cast<std::size_t>(a);
    best.flip[axis] = geometry.direction(a, best.from[axis]) < 0.0;
  }
  return best;
}

AxisOrder inverse(const AxisOrder& order) {
  AxisOrder back;
  for (std::size_t a = 0; a < 3; ++a) {
    const auto source = static_cast<std::size_t>(order.from[a]);
    back.from[source] = static_cast<int>(a);
    back.flip[source] = order.flip[a];
  }
  return back;
}

ImageGeometry turned(const ImageGeometry& geometry, const AxisOrder& order) {
  ImageGeometry result = geometry;
  Vec3 first = Vec3::Zero();  // voxel of the original that becomes (0, 0, 0)
  for (std::size_t a = 0; a < 3; ++a) {
    const int from = order.from[a];
    const auto to = static_cast<Eigen::Index>(a);
    const int size = geometry.size[static_cast<std::size_t>(from)];
    result.size[a] = size;
    result.spacing[to] = geometry.spacing[from];
    result.direction.col(to) = geometry.direction.col(from) * (order.flip[a] ? -1.0 : 1.0);
    if (order.flip[a]) first[from] = size - 1;
  }
  result.origin = geometry.worldFromVoxel(first);
  return result;
}

template <class T>
Image<T> turned(const Image<T>& image, const AxisOrder& order) {
  if (order.isIdentity()) return image;
  Image<T> result{turned(image.geometry, order), std::vector<T>(image.voxels.size())};
  const ImageGeometry& to = result.geometry;
  const ImageGeometry& from = image.geometry;
  const std::array<std::ptrdiff_t, 3> stride = {1, from.size[0],
                                                static_cast<std::ptrdiff_t>(from.sliceCount())};
  std::array<std::ptrdiff_t, 3> step{};
  std::ptrdiff_t first = 0;
  for (std::size_t a = 0; a < 3; ++a) {
    step[a] = stride[static_cast<std::size_t>(order.from[a])];
    if (order.flip[a]) {
      first += step[a] * (to.size[a] - 1);
      step[a] = -step[a];
    }
  }
  parallelFor(static_cast<std::size_t>(to.size[2]), [&](std::size_t k) {
    for (int j = 0; j < to.size[1]; ++j) {
      const T* source = image.voxels.data() + first + step[2] * static_cast<std::ptrdiff_t>(k) +
                        step[1] * static_cast<std::ptrdiff_t>(j);
      T* row = &result.at(0, j, static_cast<int>(k));
      for (int i = 0; i < to.size[0]; ++i) row[i] = source[step[0] * i];
    }
  });
  return result;
}

template CtImage turned(const CtImage&, const AxisOrder&);
template LabelImage turned(const LabelImage&, const AxisOrder&);

}  // namespace pneuma
