#pragma once

#include <cstddef>
#include <span>

namespace pneuma {

/// Number, mean, standard deviation (of the sample, n - 1) and extremes of a set of values; all 0
/// for an empty set.
struct Summary {
  std::size_t count = 0;
  double mean = 0.0;
  double sd = 0.0;
  double min = 0.0;
  double max = 0.0;
};

Summary summary(std::span<const double> values);

}  // namespace pneuma
