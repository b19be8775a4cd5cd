#include "breathing/published_form.h"

namespace pneuma {
namespace {

constexpr double LeastShare = 1e-6;  // powers below 1 are infinitely steep at 0

Vec3 clamped(const Vec3& share) { return share.cwiseMax(LeastShare).cwiseMin(1.0); }

}  // namespace

Vec3 PublishedForm::direction(const Vec3& share) const {
  constexpr double Least = 1e-9;
  const Vec3 d = weights.array() * clamped(share).array().pow(powers.array());
  const double length = d.norm();
  return length < Least ? Vec3::Zero() : Vec3(d / length);
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

}  // namespace pneuma
