#include "breathing/motion_preset.h"

#include <cmath>

namespace pneuma {
namespace {

constexpr double QuietInnerShare = 0.75;

Vec3 deep(const Vec3& q) {
  return {0.52 * q.x() - 0.34 * q.y() - 0.08 * q.z(), 0.46 * q.x() + 0.64 * q.y() + 0.50 * q.z(),
          0.07 * q.x() - 0.29 * q.y() + 0.82 * q.z()};
}

Vec3 quiet(const Vec3& q) {
  return {0.48 * q.x() - 0.25 * q.x() * q.z(), -0.66 * q.x() + 0.12 * q.y() + 0.44 * q.z(),
          0.42 * q.x() - 0.69 * q.y() + 2.94 * q.z() - 0.27 * q.z() * q.z() - 1.56 * q.y() * q.z()};
}

}  // namespace

PresetField::PresetField(MotionPreset preset, const LungFrame& frame, double gain)
    : preset_(preset),
      frame_(frame),
      strain_((std::cbrt(1.0 + gain) - 1.0) *
              (preset == MotionPreset::Quiet ? QuietInnerShare : 1.0)) {}

Vec3 PresetField::at(const Vec3& p) const {
  const Vec3 q = frame_.shareOf(p);
  const Vec3 share = preset_ == MotionPreset::Deep ? deep(q) : quiet(q);
  return frame_.toLps(strain_ * share.cwiseProduct(frame_.lengths()));
}

}  // namespace pneuma
