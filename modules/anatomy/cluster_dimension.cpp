#include "anatomy/cluster_dimension.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "core/error.h"
#include "core/random.h"

namespace pneuma {
namespace {

constexpr std::size_t FewestPoints = 100;

void requireEnough(std::span<const Vec3> points) {
  if (points.size() >= FewestPoints) return;
  throw InvalidInput("a dimension needs " + std::to_string(FewestPoints) +
                     " points or more; there are " + std::to_string(points.size()));
}

/// Slope of y against x by least squares.
class Slope {
 public:
  void add(double x, double y) {
    n_ += 1.0;
    x_ += x;
    y_ += y;
    xx_ += x * x;
    xy_ += x * y;
  }

  double value() const { return (n_ * xy_ - x_ * y_) / (n_ * xx_ - x_ * x_); }

 private:
  double n_ = 0.0;
  double x_ = 0.0;
  double y_ = 0.0;
  double xx_ = 0.0;
  double xy_ = 0.0;
};

}  // namespace

double gyrationDimension(std::span<const Vec3> points) {
  requireEnough(points);
  constexpr double Step = 1.1;
  Vec3 sum = Vec3::Zero();
  double squares = 0.0;
  double next = static_cast<double>(points.size()) / 20.0;
  Slope slope;
  for (std::size_t i = 0; i < points.size(); ++i) {
    sum += points[i];
    squares += points[i].squaredNorm();
    const auto count = static_cast<double>(i + 1);
    if (count < next) continue;
    next *= Step;
    const double gyration = std::sqrt(squares / count - (sum / count).squaredNorm());
    slope.add(std::log(gyration), std::log(count));
  }
  return slope.value();
}

double correlationDimension(std::span<const Vec3> points, double fromMm, double toMm,
                            std::uint64_t seed) {
  requireEnough(points);
  constexpr std::size_t Centres = 1000;
  constexpr std::size_t MostOthers = 100000;
  constexpr double StepsPerOctave = 8.0;
  const auto steps =
      static_cast<std::size_t>(std::lround(StepsPerOctave * std::log2(toMm / fromMm)));
  std::vector<double> pairs(steps + 1, 0.0);  // by the first radius that holds them
  Random random(seed);
  const std::size_t stride = (points.size() + MostOthers - 1) / MostOthers;
  for (std::size_t centre = 0; centre < Centres; ++centre) {
    const Vec3& from = points[random.below(points.size())];
    for (std::size_t i = centre % stride; i < points.size(); i += stride) {
      const double distance = (points[i] - from).norm();
      if (distance == 0.0 || distance > toMm) continue;
      const double step = std::ceil(StepsPerOctave * std::log2(distance / fromMm));
      pairs[static_cast<std::size_t>(std::clamp(step, 0.0, static_cast<double>(steps)))] += 1.0;
    }
  }
  Slope slope;
  double within = 0.0;
  for (std::size_t step = 0; step <= steps; ++step) {
    within += pairs[step];
    if (within == 0.0) continue;
    slope.add(static_cast<double>(step) / StepsPerOctave, std::log2(within));
  }
  const double value = slope.value();
  if (!std::isfinite(value)) {
    throw InvalidInput("no two points are nearer than " + std::to_string(toMm) +
                       " mm; choose larger radii");
  }
  return value;
}

}  // namespace pneuma
