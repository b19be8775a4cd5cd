#include "core/scaled_domain.h"

#include <cmath>
#include <string>
#include <utility>

#include "core/error.h"

namespace pneuma {

ScaledDomain::ScaledDomain(std::shared_ptr<const Domain> domain, const Vec3& centre, double factor)
    : domain_(std::move(domain)), centre_(centre), factor_(factor) {
  if (!(factor > 0.0 && std::isfinite(factor))) {
    throw InvalidInput("a region cannot be scaled by " + std::to_string(factor) +
                       "; the factor must be above 0");
  }
}

Box3 ScaledDomain::bounds() const {
  const Box3 box = domain_->bounds();
  return {centre_ + factor_ * (box.min() - centre_), centre_ + factor_ * (box.max() - centre_)};
}

}  // namespace pneuma
