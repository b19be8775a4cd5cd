#include "breathing/motion_preset.h"

#include <cmath>

namespace pneuma {
namespace {

constexpr double QuietInnerShare = 0.75;

/// A row for X, Y and Z; columns: q_X, q_Y, q_Z, q_X q_Z, q_Y q_Z, q_Z^2.
using Constants = Eigen::Matrix<double, 3, 6>;

const Constants& constantsOf(MotionPreset preset) {
  static const Constants deep{{0.52, -0.34, -0.08, 0.0, 0.0, 0.0},
                              {0.46, 0.64, 0.50, 0.0, 0.0, 0.0},
                              {0.07, -0.29, 0.82, 0.0, 0.0, 0.0}};
  static const Constants quiet{{0.48, 0.0, 0.0, -0.25, 0.0, 0.0},
                               {-0.66, 0.12, 0.44, 0.0, 0.0, 0.0},
                               {0.42, -0.69, 2.94, 0.0, -1.56, -0.27}};
  return preset == MotionPreset::Deep ? deep : quiet;
}

}  // namespace

PresetField::PresetField(MotionPreset preset, const LungFrame& frame, double gain)
    : preset_(preset),
      frame_(frame),
      strain_((std::cbrt(1.0 + gain) - 1.0) *
              (preset == MotionPreset::Quiet ? QuietInnerShare : 1.0)) {}

Vec3 PresetField::at(const Vec3& p) const {
  const Vec3 q = frame_.shareOf(p);
  Eigen::Vector<double, 6> terms;
  terms << q, q.x() * q.z(), q.y() * q.z(), q.z() * q.z();
  const Vec3 share = constantsOf(preset_) * terms;
  return frame_.toLps(strain_ * share.cwiseProduct(frame_.lengths()));
}

Eigen::Matrix3d PresetField::gradientAt(const Vec3& p) const {
  const Vec3 q = frame_.shareOf(p);
  Eigen::Matrix<double, 6, 3> slopes = Eigen::Matrix<double, 6, 3>::Zero();
  slopes.topRows<3>().setIdentity();
  slopes.row(3) << q.z(), 0.0, q.x();
  slopes.row(4) << 0.0, q.z(), q.y();
  slopes.row(5) << 0.0, 0.0, 2.0 * q.z();
  const Vec3 lengths = frame_.lengths();
  const Eigen::Matrix3d share =
      lengths.asDiagonal() * (constantsOf(preset_) * slopes) * lengths.cwiseInverse().asDiagonal();
  Eigen::Matrix3d toLps;
  for (int axis = 0; axis < 3; ++axis) toLps.col(axis) = frame_.toLps(Vec3::Unit(axis));
  return strain_ * toLps * share * toLps;
}

}  // namespace pneuma
