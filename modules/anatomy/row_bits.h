#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>

namespace pneuma {

/// Half the width of a section whose square is `squared`; -1 where there is no section.
inline double halfWidthOf(double squared) { return squared >= 0.0 ? std::sqrt(squared) : -1.0; }

/// A row of 32 points along x, the first one at `first`, a step > 0 apart.
class RowOfPoints {
 public:
  RowOfPoints(double first, double step) : first_(first), perStep_(1.0 / step) {}

  /// Bit i is set where point i lies from `middle - half` to `middle + half`; none if `half` < 0.
  std::uint32_t bitsWithin(double middle, double half) const {
    if (!(half >= 0.0)) return 0;
    const double centre = (middle - first_) * perStep_;
    const double reach = half * perStep_;
    const double low = std::clamp(centre - reach, 0.0, 32.0);
    const double high = std::clamp(centre + reach, -1.0, 31.0) + 1.0;  // its floor is one too many
    int from = static_cast<int>(low);
    if (static_cast<double>(from) < low) ++from;
    const int end = static_cast<int>(high);
    if (from >= end) return 0;
    constexpr std::uint32_t All = ~std::uint32_t{0};
    return (All << from) & (All >> (32 - end));
  }

 private:
  double first_;
  double perStep_;
};

}  // namespace pneuma
