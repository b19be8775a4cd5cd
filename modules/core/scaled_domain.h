#pragma once

#include <memory>

#include "core/domain.h"

namespace pneuma {

/// A region made larger or smaller about a point.
class ScaledDomain : public Domain {
 public:
  /// @throws InvalidInput unless `factor` is a finite number above 0
  ScaledDomain(std::shared_ptr<const Domain> domain, const Vec3& centre, double factor);

  bool contains(const Vec3& p) const override { return domain_->contains(original(p)); }

  bool containsSegment(const Vec3& a, const Vec3& b) const override {
    return domain_->containsSegment(original(a), original(b));
  }

  bool containsBox(const Box3& box) const override {
    return domain_->containsBox({original(box.min()), original(box.max())});
  }

  double distanceToWall(const Vec3& p) const override {
    return factor_ * domain_->distanceToWall(original(p));
  }

  std::uint32_t insideAlongX(const Vec3& first, double stepMm,
                             std::uint32_t wanted) const override {
    return domain_->insideAlongX(original(first), stepMm / factor_, wanted);
  }

  double exitDistance(const Vec3& p, const Vec3& direction, double farthestMm) const override {
    return factor_ * domain_->exitDistance(original(p), direction, farthestMm / factor_);
  }

  Box3 bounds() const override;

  double volumeMm3() const override { return factor_ * factor_ * factor_ * domain_->volumeMm3(); }

 private:
  /// Where `p` lies in the region as it was.
  Vec3 original(const Vec3& p) const { return centre_ + (p - centre_) / factor_; }

  std::shared_ptr<const Domain> domain_;
  Vec3 centre_;
  double factor_;
};

}  // namespace pneuma
