#include "breathing/posture.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace pneuma {
namespace {

constexpr double FlattestPower = 0.05;
constexpr double LeastLength = 1e-9;  // of a direction

/// Y00 and the factor of all three Y1m.
const double Constant = 0.5 / std::sqrt(std::numbers::pi);
const double Linear = std::sqrt(3.0) * Constant;

double positive(double x) { return std::max(0.0, x); }

/// The side of a lung that looks away from the heart, along the body's X.
double lateral(Side side) { return side == Side::Left ? 1.0 : -1.0; }

}  // namespace

Vec3 gravityOf(Posture posture) {
  switch (posture) {
    case Posture::Supine:
      return -Vec3::UnitY();
    case Posture::Prone:
      return Vec3::UnitY();
    case Posture::Upright:
      return Vec3::UnitZ();
    case Posture::LeftLateral:
      return Vec3::UnitX();
    case Posture::RightLateral:
      return -Vec3::UnitX();
    case Posture::HeadDown:
      return -Vec3::UnitZ();
  }
  return -Vec3::UnitY();
}

Vec3 motionDirection(const Vec3& share, Side side, const Vec3& gravity,
                     const DirectionConstants& constants) {
  // How far each axis begins at its far wall. The apex rests in every posture.
  const Vec3 far(positive(lateral(side) * gravity.x()), positive(gravity.y()), 0.0);
  Vec3 direction;
  for (int k = 0; k < 3; ++k) {
    const auto n = static_cast<std::size_t>(k);
    const double power = std::max(FlattestPower, constants.power[n]);
    const auto grown = [&](double q) {
      return constants.factor[n] * std::pow(std::clamp(q, 0.0, 1.0), power);
    };
    direction[k] = (1.0 - far[k]) * grown(share[k]) - far[k] * grown(1.0 - share[k]);
  }
  const double length = direction.norm();
  return length < LeastLength ? Vec3(Vec3::Zero()) : Vec3(direction / length);
}

std::array<double, 4> forceCoefficients(Side side, const Vec3& gravity,
                                        const ForceConstants& constants) {
  const double outwards = lateral(side) * gravity.x();
  return {constants.base + constants.weight * (positive(gravity.y()) + positive(outwards)),
          -constants.weight * outwards, -constants.weight * gravity.y(),
          constants.weight * positive(gravity.z()) + constants.diaphragm};
}

double forceAt(const std::array<double, 4>& coefficients, const Vec3& share) {
  const Vec3 q = share.cwiseMax(0.0).cwiseMin(1.0);
  return coefficients[0] + coefficients[1] * q.x() + coefficients[2] * q.y() +
         coefficients[3] * q.z();
}

std::array<double, 4> harmonicsOf(double alpha, const Vec3& beta) {
  return {alpha / Constant, beta.y() / Linear, beta.z() / Linear, beta.x() / Linear};
}

double harmonicSum(const std::array<double, 4>& harmonics, const Vec3& gravity) {
  return Constant * harmonics[0] +
         Linear *
             (harmonics[1] * gravity.y() + harmonics[2] * gravity.z() + harmonics[3] * gravity.x());
}

}  // namespace pneuma
