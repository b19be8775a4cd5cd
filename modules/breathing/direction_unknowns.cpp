#include "breathing/direction_unknowns.h"

#include <algorithm>
#include <cmath>

namespace pneuma {
namespace {

constexpr double LeastPower = 0.05;
constexpr double MostPower = 5.0;
constexpr double MostLogWeight = 4.0;

double bounded(double x, double low, double high) {
  return low + (high - low) * 0.5 * (1.0 + std::tanh(x));
}

double unbounded(double value, double low, double high) {
  constexpr double Margin = 1e-9;
  const double share = std::clamp((value - low) / (high - low), Margin, 1.0 - Margin);
  return std::atanh(2.0 * share - 1.0);
}

}  // namespace

DirectionUnknowns directionUnknowns(const PublishedForm& form) {
  DirectionUnknowns unknowns;
  for (int k = 0; k < 2; ++k) {
    unknowns[k] = unbounded(std::log(form.weights[k]), -MostLogWeight, MostLogWeight);
  }
  for (int k = 0; k < 3; ++k) {
    unknowns[2 + k] = unbounded(form.powers[k], LeastPower, MostPower);
  }
  return unknowns;
}

PublishedForm directionsOf(const DirectionUnknowns& unknowns) {
  PublishedForm form;
  for (int k = 0; k < 2; ++k) {
    form.weights[k] = std::exp(bounded(unknowns[k], -MostLogWeight, MostLogWeight));
  }
  for (int k = 0; k < 3; ++k) {
    form.powers[k] = bounded(unknowns[2 + k], LeastPower, MostPower);
  }
  return form;
}

}  // namespace pneuma
