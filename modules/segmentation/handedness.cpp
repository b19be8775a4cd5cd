#include "segmentation/handedness.h"

#include <algorithm>
#include <array>
#include <optional>
#include <vector>

#include "segmentation/closing.h"
#include "segmentation/lung_labels.h"

namespace pneuma {
namespace {

// Heights in which the heart lies, as shares of the lungs' from their base.
constexpr double HeartLow = 0.2;
constexpr double HeartHigh = 0.55;
// Differences that count.
constexpr double HeartShare = 0.06;
constexpr double LargerRight = 1.04;
constexpr double LargerLeft = 0.92;
constexpr double HigherDomeMm = 4.0;
constexpr double DomeShare = 0.8;  ///< of the columns of a lung that its dome's top lies above

int vote(double value, double low, double high) { return value > high ? 1 : value < low ? -1 : 0; }

/// Height of the top of the dome below a lung: its lowest voxel in the columns where that lies
/// highest, mm. None if no column is long enough.
std::optional<double> domeMm(const LabelImage& labels, std::uint8_t lung, const VoxelBox& box) {
  std::vector<int> lowest;
  for (int j = 0; j < box.size[1]; ++j) {
    for (int i = 0; i < box.size[0]; ++i) {
      // Of columns that pass through half of the lung's height at least: not its lateral rim.
      int first = -1;
      int count = 0;
      for (int k = 0; k < box.size[2]; ++k) {
        if (labels.at(box.low.x() + i, box.low.y() + j, box.low.z() + k) != lung) continue;
        if (first < 0) first = k;
        ++count;
      }
      if (2 * count > box.size[2]) lowest.push_back(box.low.z() + first);
    }
  }
  if (lowest.empty()) return std::nullopt;
  const auto at = lowest.begin() +
                  static_cast<std::ptrdiff_t>(DomeShare * static_cast<double>(lowest.size() - 1));
  std::nth_element(lowest.begin(), at, lowest.end());
  return *at * labels.geometry.spacing.z();
}

/// How much farther what lies between the lungs reaches to the left than to the right, as a share.
double heartShare(const LabelImage& labels, const VoxelBox& both, double middle) {
  const int from = both.low.z() + static_cast<int>(HeartLow * both.size[2]);
  const int to = both.low.z() + static_cast<int>(HeartHigh * both.size[2]);
  double left = 0.0;
  double right = 0.0;
  for (int k = from; k < to; ++k) {
    for (int j = both.low.y(); j < both.low.y() + both.size[1]; ++j) {
      int inner = -1;  // last voxel of the right lung before the first of the left one
      int outer = -1;
      for (int i = both.low.x(); i < both.low.x() + both.size[0] && outer < 0; ++i) {
        const std::uint8_t there = labels.at(i, j, k);
        if (there == RightLabel) inner = i;
        if (there == LeftLabel && inner >= 0) outer = i;
      }
      if (inner < 0 || outer < 0) continue;
      left += std::max(0.0, outer - middle);
      right += std::max(0.0, middle - inner);
    }
  }
  return left + right > 0.0 ? (left - right) / (left + right) : 0.0;
}

}  // namespace

Handedness handednessOf(const LabelImage& labels, double middle) {
  const VoxelBox right = within(boxOf(labels, RightLabel, 0.0), labels.geometry);
  const VoxelBox left = within(boxOf(labels, LeftLabel, 0.0), labels.geometry);
  if (right.voxelCount() == 0 || left.voxelCount() == 0) return {};
  VoxelBox both;
  both.low = right.low.cwiseMin(left.low);
  for (int axis = 0; axis < 3; ++axis) {
    const auto a = static_cast<std::size_t>(axis);
    both.size[a] =
        std::max(right.low[axis] + right.size[a], left.low[axis] + left.size[a]) - both.low[axis];
  }
  const auto count = [&](std::uint8_t lung) {
    return static_cast<double>(std::count(labels.voxels.begin(), labels.voxels.end(), lung));
  };
  Handedness hands;
  hands.heart = vote(heartShare(labels, both, middle), -HeartShare, HeartShare);
  hands.volume = vote(count(RightLabel) / count(LeftLabel), LargerLeft, LargerRight);
  const std::optional<double> rightDome = domeMm(labels, RightLabel, right);
  const std::optional<double> leftDome = domeMm(labels, LeftLabel, left);
  if (rightDome && leftDome) hands.dome = vote(*rightDome - *leftDome, -HigherDomeMm, HigherDomeMm);
  return hands;
}

}  // namespace pneuma
