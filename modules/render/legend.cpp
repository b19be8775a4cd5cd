#include "render/legend.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <cstdio>

#include "render/colour_map.h"

namespace pneuma {
namespace {

constexpr int RampSteps = 64;

std::string numberLabel(double value) {
  std::array<char, 32> text{};
  std::snprintf(text.data(), text.size(), "%.6g", value);
  return text.data();
}

std::string capitalised(std::string_view text) {
  std::string result(text);
  if (!result.empty()) {
    result[0] = static_cast<char>(std::toupper(static_cast<unsigned char>(result[0])));
  }
  return result;
}

/// Round numbers of the form {1, 2, 5} x 10^n, or whole decades if there would be too many.
std::vector<double> logarithmicTicks(double low, double high) {
  std::vector<double> ticks;
  const bool decadesOnly = std::log10(high / low) > 2.0;
  const double slack = 1.0 + 1e-9;
  for (int exponent = static_cast<int>(std::floor(std::log10(low))) - 1;
       exponent <= static_cast<int>(std::ceil(std::log10(high))); ++exponent) {
    for (const double digit : {1.0, 2.0, 5.0}) {
      if (decadesOnly && digit != 1.0) continue;
      const double value = digit * std::pow(10.0, exponent);
      if (value * slack >= low && value <= high * slack) ticks.push_back(value);
    }
  }
  return ticks;
}

std::vector<double> wholeTicks(double low, double high) {
  double step = 1.0;
  for (const double candidate : {1.0, 2.0, 5.0, 10.0, 20.0, 50.0, 100.0}) {
    step = candidate;
    if ((high - low) / step <= 8.0) break;
  }
  std::vector<double> ticks;
  for (double value = std::ceil(low / step) * step; value <= high + 1e-9; value += step) {
    ticks.push_back(value);
  }
  return ticks;
}

/// About five round numbers.
std::vector<double> evenTicks(double low, double high) {
  const double range = high - low;
  if (!(range > 0.0)) return {};
  const double decade = std::pow(10.0, std::floor(std::log10(range / 5.0)));
  double step = decade;
  for (const double digit : {1.0, 2.0, 5.0, 10.0}) {
    step = digit * decade;
    if (range / step <= 6.0) break;
  }
  std::vector<double> ticks;
  for (double n = std::ceil(low / step - 1e-9); n * step <= high + 1e-9 * range; n += 1.0) {
    ticks.push_back(n == 0.0 ? 0.0 : n * step);  // never "-0"
  }
  return ticks;
}

}  // namespace

Legend lobeLegend(const std::set<Lobe>& lobes, Palette palette, Background background) {
  Legend legend;
  for (const Lobe lobe : lobes) {
    const bool central = lobe == Lobe::Central;
    legend.chips.push_back({central ? "Central airways" : capitalised(longName(lobe)),
                            central ? "Central" : capitalised(shortName(lobe)),
                            onBackground(airwayColour(lobe, palette), background)});
  }
  return legend;
}

Scale::Scale(Kind kind, double low, double high) : kind_(kind), low_(low), high_(high) {}

double Scale::position(double value) const {
  if (high_ <= low_) return 1.0;
  const double t = kind_ == Kind::Count || kind_ == Kind::Linear
                       ? (value - low_) / (high_ - low_)
                       : std::log(value / low_) / std::log(high_ / low_);
  return std::clamp(t, 0.0, 1.0);
}

Legend Scale::legend(const std::string& title, Background background) const {
  Legend legend;
  legend.title = title;
  for (int i = 0; i < RampSteps; ++i) {
    legend.ramp.push_back(onBackground(scaleColour(i / (RampSteps - 1.0)), background));
  }
  std::vector<double> values = kind_ == Kind::Count    ? wholeTicks(low_, high_)
                               : kind_ == Kind::Linear ? evenTicks(low_, high_)
                                                       : logarithmicTicks(low_, high_);
  if (values.empty()) values = {low_, high_};
  for (const double value : values) {
    legend.ticks.push_back({position(value), kind_ == Kind::LogarithmicShare
                                                 ? numberLabel(value * 100.0) + " %"
                                                 : numberLabel(value)});
  }
  return legend;
}

double scaleBarMm(double pixelsPerMm, double maxPixels) {
  double best = 0.0;
  for (double decade = 0.01; decade < 1000.0; decade *= 10.0) {
    for (const double digit : {1.0, 2.0, 5.0}) {
      const double length = digit * decade;
      if (length <= 1000.0 && length * pixelsPerMm <= maxPixels) best = length;
    }
  }
  return best;
}

}  // namespace pneuma
