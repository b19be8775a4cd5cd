#include "pipeline/orientation_check.h"

#include <algorithm>
#include <cmath>

#include "core/parallel.h"
#include "segmentation/lung_segmentation.h"

namespace pneuma {
namespace {

constexpr double CoarseMm = 1.5;  ///< enough for lungs; airways still show

/// Every n-th voxel along each axis, about CoarseMm apart.
CtImage coarse(const CtImage& ct) {
  CtImage some;
  some.geometry = ct.geometry;
  std::array<int, 3> step{};
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const auto a = static_cast<Eigen::Index>(axis);
    step[axis] = std::max(1, static_cast<int>(std::lround(CoarseMm / ct.geometry.spacing[a])));
    some.geometry.size[axis] = (ct.geometry.size[axis] + step[axis] - 1) / step[axis];
    some.geometry.spacing[a] *= step[axis];
  }
  some.voxels.resize(some.geometry.voxelCount());
  const auto [width, height, depth] = some.geometry.size;
  parallelFor(static_cast<std::size_t>(depth), [&, width = width, height = height](std::size_t n) {
    const int k = static_cast<int>(n);
    for (int j = 0; j < height; ++j) {
      for (int i = 0; i < width; ++i) {
        some.at(i, j, k) = ct.at(i * step[0], j * step[1], k * step[2]);
      }
    }
  });
  return some;
}

}  // namespace

OrientationCheck checkOrientation(const CtImage& ct, const Progress& progress) {
  OrientationCheck check;
  try {
    check.hands = segmentLungs(coarse(ct), {}, progress).hands;
  } catch (const InvalidInput& noLungs) {
    check.sentence = std::string("left and right were not checked: ") + noLungs.what();
    return check;
  }
  const int votes = check.hands->votes();
  check.sentence = check.maybeSwapped()
                       ? "left and right may be swapped: of heart, size of the lungs and height of "
                         "the diaphragm's domes, what can be told lies the other way round; check "
                         "the header's orientation, nothing was changed"
                   : votes >= 2 ? "left and right are as in most people"
                                : "nothing tells whether left and right are right";
  return check;
}

}  // namespace pneuma
