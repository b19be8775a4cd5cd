#include "pipeline/breath_curve.h"

#include <array>
#include <cstdio>

namespace pneuma {

std::string breathCurveCsv(const BreathCycle& cycle) {
  constexpr int Rows = 500;
  constexpr double MlPerLitre = 1000.0;
  std::string text = "seconds,pressure_cmH2O,flow_ml_per_s,volume_ml\n";
  for (int n = 0; n <= Rows; ++n) {
    const double phase = static_cast<double>(n) / Rows;
    const BreathSample sample = n < Rows ? cycle.at(phase) : cycle.samples.back();
    std::array<char, 128> line{};
    std::snprintf(line.data(), line.size(), "%.9g,%.9g,%.9g,%.9g\n",
                  phase * cycle.samples.back().seconds, sample.pressure, MlPerLitre * sample.flow,
                  MlPerLitre * sample.volume);
    text += line.data();
  }
  return text;
}

}  // namespace pneuma
