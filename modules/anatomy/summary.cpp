#include "anatomy/summary.h"

#include <algorithm>
#include <cmath>

namespace pneuma {

Summary summary(std::span<const double> values) {
  Summary result;
  result.count = values.size();
  if (values.empty()) return result;
  const auto [low, high] = std::ranges::minmax(values);
  result.min = low;
  result.max = high;
  const double n = static_cast<double>(values.size());
  double sum = 0.0;
  for (const double value : values) sum += value;
  result.mean = sum / n;
  double squares = 0.0;
  for (const double value : values) squares += (value - result.mean) * (value - result.mean);
  if (values.size() > 1) result.sd = std::sqrt(squares / (n - 1.0));
  return result;
}

}  // namespace pneuma
