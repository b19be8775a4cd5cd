#pragma once

#include <algorithm>
#include <cmath>
#include <memory>
#include <numbers>

#include "core/domain.h"

/// Regions whose every answer is known in closed form.
namespace pneuma::testing {

class BallDomain : public Domain {
 public:
  explicit BallDomain(double radiusMm, const Vec3& centre = Vec3::Zero())
      : radius_(radiusMm), centre_(centre) {}

  bool contains(const Vec3& p) const override { return (p - centre_).norm() <= radius_; }

  double distanceToWall(const Vec3& p) const override {
    return std::abs((p - centre_).norm() - radius_);
  }

  Box3 bounds() const override {
    return {centre_ - Vec3::Constant(radius_), centre_ + Vec3::Constant(radius_)};
  }

  double volumeMm3() const override {
    return 4.0 / 3.0 * std::numbers::pi * radius_ * radius_ * radius_;
  }

 private:
  double radius_;
  Vec3 centre_;
};

class BoxDomain : public Domain {
 public:
  explicit BoxDomain(const Box3& box) : box_(box) {}

  bool contains(const Vec3& p) const override { return box_.contains(p); }

  double distanceToWall(const Vec3& p) const override {
    if (!box_.contains(p)) return box_.exteriorDistance(p);
    return std::min((p - box_.min()).minCoeff(), (box_.max() - p).minCoeff());
  }

  Box3 bounds() const override { return box_; }

  double volumeMm3() const override { return box_.volume(); }

 private:
  Box3 box_;
};

inline std::shared_ptr<const Domain> ball(double radiusMm, const Vec3& centre = Vec3::Zero()) {
  return std::make_shared<BallDomain>(radiusMm, centre);
}

inline std::shared_ptr<const Domain> box(const Vec3& low, const Vec3& high) {
  return std::make_shared<BoxDomain>(Box3(low, high));
}

}  // namespace pneuma::testing
