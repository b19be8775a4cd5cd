#include "breathing/breath_cycle.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>

#include "core/error.h"

namespace pneuma {
namespace {

constexpr double StepSeconds = 1e-3;
constexpr double Closed = 1e-9;  // l
constexpr int MostBreaths = 200;
constexpr double MostPressure = 200.0;  // cmH2O

void requirePositive(double value, const char* what) {
  if (std::isfinite(value) && value > 0.0) return;
  throw InvalidInput(std::string("the ") + what + " of a breath is " + std::to_string(value) +
                     "; it must be above zero");
}

void requireSound(const BreathMechanics& mechanics, const BreathDrive& drive) {
  requirePositive(mechanics.inertance, "inertance");
  requirePositive(mechanics.compliance, "compliance");
  requirePositive(mechanics.tidal, "tidal volume");
  requirePositive(drive.period, "period");
  requirePositive(drive.inspiration, "inspiration");
  requirePositive(drive.relaxation, "relaxation");
  if (drive.inspiration + drive.relaxation > drive.period) {
    throw InvalidInput(
        "inspiration and relaxation take longer than the breath's period; make the "
        "period longer or inspiration shorter");
  }
  for (const double part : mechanics.resistance) {
    if (!std::isfinite(part)) throw InvalidInput("a resistance of the breath is no number");
  }
}

double resistanceOf(const BreathMechanics& m, double volume, double flow) {
  const double low = std::max(0.0, 1.0 - volume / m.tidal);
  const auto& c = m.resistance;
  const double out = flow < 0.0 ? c[3] + c[4] * low : 0.0;
  return std::max(LeastResistance, c[0] + c[1] * std::abs(flow) + c[2] * low + out);
}

/// One breath, from a volume and a flow; the last sample is one period after the first.
std::vector<BreathSample> breath(const BreathMechanics& m, const BreathDrive& drive,
                                 const BreathSample& start) {
  const auto steps = static_cast<std::size_t>(std::ceil(drive.period / StepSeconds));
  const double dt = drive.period / static_cast<double>(steps);
  std::vector<BreathSample> samples(steps + 1);
  samples[0] = {0.0, drivePressure(drive, 0.0), start.volume, start.flow};
  for (std::size_t i = 1; i <= steps; ++i) {
    const BreathSample& last = samples[i - 1];
    BreathSample& next = samples[i];
    next.seconds = static_cast<double>(i) * dt;
    next.pressure = drivePressure(drive, next.seconds);
    const double r = resistanceOf(m, last.volume, last.flow);
    next.flow = (m.inertance * last.flow + dt * (next.pressure - last.volume / m.compliance)) /
                (m.inertance + dt * r + dt * dt / m.compliance);
    next.volume = last.volume + dt * next.flow;
  }
  return samples;
}

constexpr BreathMechanics mechanics(double compliance, std::array<double, 5> resistance,
                                    double tidal) {
  return {0.01, compliance, resistance, tidal};
}

constexpr std::array<double, 5> Healthy = {1.6, 0.3, 0.2, 0.4, 0.4};

constexpr BreathDrive drive(double period, double inspiration, double peak) {
  return {period, inspiration, 0.45 * inspiration, peak};
}

/// Of the pneumothorax: one lung has half of the compliance, and keeps 30 % of that.
constexpr double CollapsedKeeps = 0.3;
constexpr double CollapsedCompliance = 0.20 * 0.5 * (1.0 + CollapsedKeeps);

/// In the order of Breathing.
constexpr std::array<BreathScenario, 8> Scenarios = {{
    {"Quiet breathing", mechanics(0.20, Healthy, 0.5), drive(5.0, 2.0, 2.73)},
    {"Deep breath", mechanics(0.20, Healthy, 3.0), drive(8.0, 3.0, 16.0), true},
    {"Moderate COPD", mechanics(0.25, {4.0, 1.0, 2.0, 4.0, 8.0}, 0.5), drive(4.0, 1.3, 5.5)},
    {"Severe COPD", mechanics(0.28, {5.0, 2.0, 3.0, 8.0, 15.0}, 0.45), drive(3.2, 1.1, 7.8)},
    {"Dyspnoea, fast and deep", mechanics(0.20, Healthy, 0.75), drive(2.2, 0.95, 5.6)},
    {"Stiff lungs, shallow", mechanics(0.08, Healthy, 0.3), drive(2.0, 0.85, 4.1)},
    {"Pneumothorax of one lung",
     mechanics(CollapsedCompliance, {2.08, 0.39, 0.26, 0.52, 0.52}, 0.35), drive(2.8, 1.1, 3.4),
     false, CollapsedKeeps, 0.45},
    {"Tumour", mechanics(0.19, Healthy, 0.48), drive(5.0, 2.0, 2.73)},
}};

}  // namespace

double drivePressure(const BreathDrive& drive, double seconds) {
  const double up = drive.inspiration;
  const double down = drive.relaxation;
  if (seconds < up) {
    return 0.5 * drive.peak * (1.0 - std::cos(std::numbers::pi * seconds / up));
  }
  if (seconds >= up + down) return 0.0;
  return 0.5 * drive.peak * (1.0 + std::cos(std::numbers::pi * (seconds - up) / down));
}

BreathSample BreathCycle::at(double phase) const {
  const double within = phase - std::floor(phase);
  const double place = within * static_cast<double>(samples.size() - 1);
  const auto i = std::min(static_cast<std::size_t>(place), samples.size() - 2);
  const double t = place - static_cast<double>(i);
  const BreathSample& a = samples[i];
  const BreathSample& b = samples[i + 1];
  const auto between = [t](double from, double to) { return from + t * (to - from); };
  return {between(a.seconds, b.seconds), between(a.pressure, b.pressure),
          between(a.volume, b.volume), between(a.flow, b.flow)};
}

BreathCycle periodicBreath(const BreathMechanics& mechanics, const BreathDrive& drive) {
  requireSound(mechanics, drive);
  BreathCycle cycle;
  BreathSample state;
  for (int n = 0; n < MostBreaths; ++n) {
    cycle.samples = breath(mechanics, drive, state);
    state = cycle.samples.back();
    cycle.closure = state.volume - cycle.samples.front().volume;
    if (std::abs(cycle.closure) <= Closed) break;
  }
  if (!(std::abs(cycle.closure) <= Closed)) {
    throw InvalidInput(
        "the breaths do not settle into a rhythm; lower the resistance or make the "
        "period longer");
  }
  const auto [least, most] = std::ranges::minmax_element(cycle.samples, {}, &BreathSample::volume);
  cycle.tidal = most->volume - least->volume;
  cycle.trapped = least->volume;
  for (const BreathSample& sample : cycle.samples) {
    cycle.peakInspiratory = std::max(cycle.peakInspiratory, sample.flow);
    cycle.peakExpiratory = std::max(cycle.peakExpiratory, -sample.flow);
  }
  return cycle;
}

BreathCycle breathOfVolume(const BreathMechanics& mechanics, BreathDrive& drive, double tidal) {
  requirePositive(tidal, "tidal volume");
  double low = 0.0;
  double high = 1.0;
  const auto moved = [&](double peak) {
    drive.peak = peak;
    return periodicBreath(mechanics, drive).tidal;
  };
  while (moved(high) < tidal) {
    low = high;
    high *= 2.0;
    if (high > MostPressure) {
      throw InvalidInput("no pressure up to 200 cmH2O moves " + std::to_string(tidal) +
                         " l in such lungs; ask for less, or for a longer breath");
    }
  }
  for (int n = 0; n < 60 && high - low > 1e-12 * high; ++n) {
    const double middle = 0.5 * (low + high);
    (moved(middle) < tidal ? low : high) = middle;
  }
  drive.peak = high;
  return periodicBreath(mechanics, drive);
}

const BreathScenario& scenarioOf(Breathing breathing) {
  return Scenarios[static_cast<std::size_t>(breathing)];
}

}  // namespace pneuma
