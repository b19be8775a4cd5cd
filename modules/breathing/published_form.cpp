#include "breathing/published_form.h"

namespace pneuma {
namespace {

constexpr double LeastBoxShare = 1e-6;  // powers below 1 are infinitely steep at 0
constexpr double LeastLength = 1e-9;    // of d

Vec3 clamped(const Vec3& share) { return share.cwiseMax(LeastBoxShare).cwiseMin(1.0); }

}  // namespace

Vec3 PublishedForm::way(const Vec3& share) const {
  return weights.array() * clamped(share).array().pow(powers.array());
}

Vec3 PublishedForm::direction(const Vec3& share) const {
  const Vec3 d = way(share);
  const double length = d.norm();
  return length < LeastLength ? Vec3::Zero() : Vec3(d / length);
}

const PublishedForm& publishedForm(MotionPreset preset) {
  static const PublishedForm quiet{{0.05, 0.10, 1.0}, {2.2, 3.7, 1.8}, 0.33, {0.24, -0.93, 1.55}};
  static const PublishedForm deep{{0.15, 1.25, 1.0}, {1.29, 0.60, 1.48}, -0.25, {0.51, 0.23, 1.07}};
  return preset == MotionPreset::Deep ? deep : quiet;
}

const PublishedForm& reasonedForm() {
  static const PublishedForm form{{0.20, 0.40, 1.0}, {1.0, 1.0, 1.3}, 0.05, {0.0, 0.90, 0.05}};
  return form;
}

Vec3 PublishedField::at(const Vec3& p) const {
  const Vec3 share = clamped(frame_.shareOf(p));
  return frame_.toLps(AmplitudeMm * strain_ * form_.force(share) * form_.direction(share));
}

Mat3 PublishedField::gradientAt(const Vec3& p) const {
  const Vec3 given = frame_.shareOf(p);
  const Vec3 share = clamped(given);
  const Vec3 d = form_.way(share);
  const double length = d.norm();
  if (length < LeastLength) return Mat3::Zero();
  const Vec3 direction = d / length;
  // The slope of q^c is c q^c / q.
  const Vec3 slopes = form_.powers.cwiseProduct(d).cwiseQuotient(share) / length;
  const Mat3 turning =
      slopes.asDiagonal().toDenseMatrix() - direction * direction.cwiseProduct(slopes).transpose();
  Mat3 byShare = form_.force(share) * turning + direction * form_.slopes.transpose();
  for (int axis = 0; axis < 3; ++axis) {
    if (share[axis] != given[axis]) byShare.col(axis).setZero();
  }
  return AmplitudeMm * strain_ * frame_.axes() * byShare *
         frame_.lengths().cwiseInverse().asDiagonal() * frame_.axes();
}

}  // namespace pneuma
