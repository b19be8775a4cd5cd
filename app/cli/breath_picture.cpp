#include "cli/breath_picture.h"

#include <algorithm>

#include "render/chart.h"

namespace pneuma::cli {
namespace {

constexpr int BreathWidth = 640;
constexpr int BreathHeight = 520;
constexpr double BreathMl = 1000.0;
constexpr std::size_t MostDots = 120;
constexpr Rgb CurveColour = rgbOfHex(0x1f6fc8);
constexpr Rgb MeasuredColour = rgbOfHex(0xe0872a);

/// The measured volume that the cycle's 0 stands for, by the mean of both. The least measured one
/// is too low if there is noise.
double restOf(const BreathCycle& cycle, const MeasuredBreath& measured) {
  const double from = measured.seconds.front();
  const double period = measured.seconds.back() - from;
  double sum = 0.0;
  for (std::size_t n = 0; n < measured.seconds.size(); ++n) {
    sum += measured.volume[n] - cycle.at((measured.seconds[n] - from) / period).volume;
  }
  return sum / static_cast<double>(measured.seconds.size());
}

}  // namespace

Picture breathPicture(const BreathCycle& cycle, const MeasuredBreath& measured) {
  Chart loop{"Pressure and volume", "pressure, cmH2O", "volume, ml", {}};
  Chart time{"Volume over time", "time, s", "volume, ml", {}};
  const bool fitted = !measured.seconds.empty();
  if (fitted) {
    ChartCurve pressures{"measured", {}, {}, MeasuredColour, ChartCurve::As::Dots};
    ChartCurve seconds = pressures;
    const double rest = restOf(cycle, measured);
    const std::size_t every = std::max<std::size_t>(1, measured.seconds.size() / MostDots);
    for (std::size_t n = 0; n < measured.seconds.size(); n += every) {
      pressures.x.push_back(measured.pressure[n]);
      seconds.x.push_back(measured.seconds[n] - measured.seconds.front());
      for (ChartCurve* curve : {&pressures, &seconds}) {
        curve->y.push_back(BreathMl * (measured.volume[n] - rest));
      }
    }
    loop.curves.push_back(std::move(pressures));
    time.curves.push_back(std::move(seconds));
  }
  ChartCurve pressures{fitted ? "fitted" : "", {}, {}, CurveColour, ChartCurve::As::Line};
  ChartCurve seconds = pressures;
  for (const BreathSample& sample : cycle.samples) {
    pressures.x.push_back(sample.pressure);
    seconds.x.push_back(sample.seconds);
    for (ChartCurve* curve : {&pressures, &seconds}) curve->y.push_back(BreathMl * sample.volume);
  }
  loop.curves.push_back(std::move(pressures));
  time.curves.push_back(std::move(seconds));
  return chartRow({loop, time}, BreathWidth, BreathHeight);
}

}  // namespace pneuma::cli
