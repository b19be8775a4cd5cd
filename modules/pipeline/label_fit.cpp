#include "pipeline/label_fit.h"

#include <algorithm>
#include <cmath>

#include "anatomy/lobe.h"

namespace pneuma {

namespace {

/// Every so many voxels along i and j, slice by slice shifted: a share needs no more.
constexpr int Stride = 3;

bool isLung(std::uint8_t label) {
  const auto lobe = static_cast<Lobe>(label);
  return lobe == Lobe::RightLung || lobe == Lobe::LeftLung ||
         std::ranges::find(FiveLobes, lobe) != FiveLobes.end();
}

}  // namespace

std::optional<double> shareOfAir(const CtImage& ct, const LabelImage& labels) {
  const ImageGeometry& at = labels.geometry;
  const Mat3 stepsInCt = ct.geometry.steps().inverse() * at.steps();
  const Vec3 origin = ct.geometry.voxelFromWorld(at.origin);
  std::size_t lung = 0;
  std::size_t air = 0;
  for (int k = 0; k < at.size[2]; ++k) {
    for (int j = k % Stride; j < at.size[1]; j += Stride) {
      for (int i = (j + k) % Stride; i < at.size[0]; i += Stride) {
        if (!isLung(labels.at(i, j, k))) continue;
        ++lung;
        const Vec3 voxel = origin + stepsInCt * Vec3(i, j, k);
        const auto n = [&](int axis) { return static_cast<int>(std::lround(voxel[axis])); };
        bool inside = true;
        for (int axis = 0; axis < 3; ++axis) {
          inside =
              inside && n(axis) >= 0 && n(axis) < ct.geometry.size[static_cast<std::size_t>(axis)];
        }
        if (inside && ct.at(n(0), n(1), n(2)) < AirInLungsHu) ++air;
      }
    }
  }
  if (lung == 0) return std::nullopt;
  return static_cast<double>(air) / static_cast<double>(lung);
}

std::optional<std::string> misfitOf(const CtImage& ct, const LabelImage& labels) {
  const auto share = shareOfAir(ct, labels);
  if (!share || *share >= LeastAirShare) return std::nullopt;
  return "only " + std::to_string(std::lround(100.0 * *share)) +
         " % of what the labels call lungs holds air in this CT (less than " +
         std::to_string(AirInLungsHu) +
         " HU): they may be those of another person or series; look at them in the slices";
}

}  // namespace pneuma
