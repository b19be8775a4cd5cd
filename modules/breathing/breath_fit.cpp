#include "breathing/breath_fit.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <span>

#include <Eigen/Core>
#include <Eigen/LU>
#include <unsupported/Eigen/NonLinearOptimization>
#include <unsupported/Eigen/NumericalDiff>

#include "core/error.h"

namespace pneuma {
namespace {

constexpr int Controls = 5;
constexpr int Unknowns = Controls + 2;  // and ln C, P0
constexpr double FitStepSeconds = 1e-3;
constexpr double LeastSteps = 500.0;
constexpr double MostSteps = 20000.0;
constexpr std::size_t LeastRows = 30;
constexpr double LongestGap = 0.1;                    // of the period
constexpr double MostUnclosed = 0.1;                  // of the tidal volume
constexpr double LeastTidal = 1e-3;                   // l
constexpr double MostTidal = 20.0;                    // l; more is ml taken for l
constexpr std::array<double, 2> Starts = {2.0, 8.0};  // of every c, cmH2O s / l
constexpr int MostSimulations = 400;

/// Weights of the three B-splines that are not 0 at a phase, from the one of this number on.
struct BasisPart {
  int first = 0;
  std::array<double, 3> weight{};
};

BasisPart basisAt(double phase) {
  const double x = Controls * (phase - std::floor(phase));
  const int first = std::min(static_cast<int>(x), Controls - 1);
  const double t = x - first;
  return {first, {0.5 * (1.0 - t) * (1.0 - t), 0.5 + t * (1.0 - t), 0.5 * t * t}};
}

double resistanceOf(const BasisPart& basis, const std::array<double, Controls>& c) {
  double sum = 0.0;
  for (int n = 0; n < 3; ++n) {
    sum += basis.weight[static_cast<std::size_t>(n)] *
           c[static_cast<std::size_t>((basis.first + n) % Controls)];
  }
  return std::max(LeastResistance, sum);
}

/// `ys` at `x` between rising `xs`.
double interpolated(std::span<const double> xs, std::span<const double> ys, double x) {
  const auto after = std::ranges::upper_bound(xs, x);
  const auto n =
      std::clamp<std::ptrdiff_t>(after - xs.begin(), 1, static_cast<std::ptrdiff_t>(xs.size()) - 1);
  const auto right = static_cast<std::size_t>(n);
  const double t = std::clamp((x - xs[right - 1]) / (xs[right] - xs[right - 1]), 0.0, 1.0);
  return (1.0 - t) * ys[right - 1] + t * ys[right];
}

/// What is found, as numbers of any sign: C is above 0 whatever its logarithm.
using Values = Eigen::VectorXd;

std::array<double, Controls> controlsOf(const Values& x) {
  std::array<double, Controls> c{};
  for (int n = 0; n < Controls; ++n) c[static_cast<std::size_t>(n)] = x[n];
  return c;
}

/// The equation with a measured drive.
class Simulation {
 public:
  explicit Simulation(const MeasuredBreath& measured)
      : period_(measured.seconds.back() - measured.seconds.front()),
        steps_(static_cast<std::size_t>(
            std::clamp(std::ceil(period_ / FitStepSeconds), LeastSteps, MostSteps))),
        dt_(period_ / static_cast<double>(steps_)) {
    for (std::size_t n = 0; n <= steps_; ++n) {
      const double share = static_cast<double>(n) / static_cast<double>(steps_);
      pressure_.push_back(interpolated(measured.seconds, measured.pressure,
                                       measured.seconds.front() + share * period_));
      basis_.push_back(basisAt(share));
    }
  }

  double period() const { return period_; }

  /// The breath that ends as it began.
  std::vector<BreathSample> breath(const Values& x, double inertance) const {
    const std::array<double, Controls> c = controlsOf(x);
    const double elastance = std::exp(-x[Controls]);
    const double offset = x[Controls + 1];
    std::vector<double> inverse(steps_ + 1);
    for (std::size_t n = 1; n <= steps_; ++n) {
      inverse[n] = 1.0 / (inertance + dt_ * resistanceOf(basis_[n], c) + dt_ * dt_ * elastance);
    }
    // Linearly implicit, so that it is stable for any resistance. Volume and flow.
    const auto next = [&](const Eigen::Vector2d& state, std::size_t n, double drive) {
      const double flow =
          (inertance * state[1] + dt_ * (drive - elastance * state[0])) * inverse[n];
      return Eigen::Vector2d(state[0] + dt_ * flow, flow);
    };
    Eigen::Vector2d driven = Eigen::Vector2d::Zero();
    Eigen::Vector2d ofVolume = Eigen::Vector2d::UnitX();
    Eigen::Vector2d ofFlow = Eigen::Vector2d::UnitY();
    for (std::size_t n = 1; n <= steps_; ++n) {
      driven = next(driven, n, pressure_[n] - offset);
      ofVolume = next(ofVolume, n, 0.0);
      ofFlow = next(ofFlow, n, 0.0);
    }
    Eigen::Matrix2d kept = Eigen::Matrix2d::Identity();
    kept.col(0) -= ofVolume;
    kept.col(1) -= ofFlow;
    Eigen::Vector2d state = kept.inverse() * driven;
    std::vector<BreathSample> samples;
    samples.reserve(steps_ + 1);
    samples.push_back({0.0, pressure_[0], state[0], state[1]});
    for (std::size_t n = 1; n <= steps_; ++n) {
      state = next(state, n, pressure_[n] - offset);
      samples.push_back({static_cast<double>(n) * dt_, pressure_[n], state[0], state[1]});
    }
    return samples;
  }

 private:
  double period_;
  std::size_t steps_;
  double dt_;
  std::vector<double> pressure_;
  std::vector<BasisPart> basis_;
};

/// The breath's volume at a time since its beginning.
double volumeAt(const std::vector<BreathSample>& samples, double seconds) {
  const double dt = samples[1].seconds;
  const double at = std::clamp(seconds / dt, 0.0, static_cast<double>(samples.size() - 1));
  const std::size_t n = std::min(static_cast<std::size_t>(at), samples.size() - 2);
  const double t = at - static_cast<double>(n);
  return (1.0 - t) * samples[n].volume + t * samples[n + 1].volume;
}

/// Fitted less measured volumes in shares of the tidal volume, as the solver asks for them.
struct Residuals {
  using Scalar = double;
  using InputType = Values;
  using ValueType = Eigen::VectorXd;
  using JacobianType = Eigen::MatrixXd;

  enum { InputsAtCompileTime = Eigen::Dynamic, ValuesAtCompileTime = Eigen::Dynamic };

  const MeasuredBreath& measured;
  const Simulation& simulation;
  double inertance;
  double rest;
  double tidal;
  int& simulations;

  int inputs() const { return Unknowns; }

  int values() const { return static_cast<int>(measured.seconds.size()); }

  int operator()(const Values& x, ValueType& residuals) const {
    ++simulations;
    const std::vector<BreathSample> samples = simulation.breath(x, inertance);
    for (int n = 0; n < values(); ++n) {
      const auto row = static_cast<std::size_t>(n);
      const double volume = volumeAt(samples, measured.seconds[row] - measured.seconds.front());
      const double off = (volume - (measured.volume[row] - rest)) / tidal;
      residuals[n] = std::isfinite(off) ? off : 1e6;
    }
    return 0;
  }
};

class Checks {
 public:
  explicit Checks(const MeasuredBreath& measured) : measured_(measured) {}

  std::string where(std::size_t row) const {
    const std::string before = measured_.name.empty() ? "" : measured_.name + ", ";
    return measured_.lines.empty() ? before + "row " + std::to_string(row + 1)
                                   : before + "line " + std::to_string(measured_.lines[row]);
  }

  void requireRows() const {
    const std::size_t rows = measured_.seconds.size();
    if (measured_.pressure.size() != rows || measured_.volume.size() != rows) {
      throw InvalidInput("a measured breath has unequal numbers of times, pressures and volumes");
    }
    if (rows < LeastRows) {
      throw InvalidInput((measured_.name.empty() ? "a measured breath" : measured_.name) + " has " +
                         std::to_string(rows) + " rows; a breath takes " +
                         std::to_string(LeastRows) + " or more");
    }
    for (std::size_t n = 0; n < rows; ++n) {
      if (!std::isfinite(measured_.seconds[n] + measured_.pressure[n] + measured_.volume[n])) {
        throw InvalidInput(where(n) + " holds something that is no number; leave the row out");
      }
    }
  }

  void requireTimes() const {
    const std::vector<double>& t = measured_.seconds;
    for (std::size_t n = 1; n < t.size(); ++n) {
      if (t[n] > t[n - 1]) continue;
      throw InvalidInput(where(n) +
                         (t[n] == t[n - 1] ? ": the time is that of the row before"
                                           : ": the time is before that of the row "
                                             "before") +
                         " (" + std::to_string(t[n]) + " s); times must rise");
    }
    const double period = t.back() - t.front();
    for (std::size_t n = 1; n < t.size(); ++n) {
      if (t[n] - t[n - 1] <= LongestGap * period) continue;
      throw InvalidInput(where(n) + ": " + std::to_string(t[n] - t[n - 1]) +
                         " s are missing since the row before, more than a tenth of the breath; "
                         "measure it without gaps");
    }
  }

  void requireBreath() const {
    const std::vector<double>& v = measured_.volume;
    const auto least = static_cast<std::size_t>(std::ranges::min_element(v) - v.begin());
    const auto most = static_cast<std::size_t>(std::ranges::max_element(v) - v.begin());
    const double tidal = v[most] - v[least];
    if (!(tidal >= LeastTidal && tidal <= MostTidal)) {
      constexpr double LongestShown = 1e9;  // a damaged file may hold any number
      std::array<char, 32> ml{};
      std::snprintf(ml.data(), ml.size(), 1000.0 * tidal < LongestShown ? "%.6f" : "%.6g",
                    1000.0 * tidal);
      throw InvalidInput(where(most) + ": the measured volume moves by " + ml.data() +
                         " ml; a breath is 1 to 20,000 ml: is its column's unit right?");
    }
    if (std::abs(v.back() - v.front()) > MostUnclosed * tidal) {
      throw InvalidInput(where(v.size() - 1) + ": the volume ends " +
                         std::to_string(1000.0 * (v.back() - v.front())) +
                         " ml from where it began; give one whole breath whose last row is the "
                         "first of the next");
    }
    // No air flows at the turning points, so that the pressure there is that of elasticity.
    if (measured_.pressure[most] > measured_.pressure[least]) return;
    throw InvalidInput(where(most) + ": the lungs are fullest at " +
                       std::to_string(measured_.pressure[most]) + " cmH2O and emptiest at " +
                       std::to_string(measured_.pressure[least]) + " (" + where(least) +
                       "), so that their compliance would be negative; if it is the oesophagus' "
                       "pressure, change its sign");
  }

 private:
  const MeasuredBreath& measured_;
};

/// From what the turning points say, with one resistance for all phases.
Values startOf(const MeasuredBreath& measured, double resistance) {
  const auto [least, most] = std::ranges::minmax_element(measured.volume);
  const auto pressureAt = [&](auto at) {
    return measured.pressure[static_cast<std::size_t>(at - measured.volume.begin())];
  };
  Values x = Values::Constant(Unknowns, resistance);
  x[Controls] = std::log((*most - *least) / (pressureAt(most) - pressureAt(least)));
  x[Controls + 1] = pressureAt(least);
  return x;
}

BreathCycle cycleOf(std::vector<BreathSample> samples) {
  BreathCycle cycle;
  cycle.closure = samples.back().volume - samples.front().volume;
  const auto [low, high] = std::ranges::minmax_element(samples, {}, &BreathSample::volume);
  cycle.tidal = high->volume - low->volume;
  const double least = low->volume;
  for (BreathSample& sample : samples) {
    sample.volume -= least;
    cycle.peakInspiratory = std::max(cycle.peakInspiratory, sample.flow);
    cycle.peakExpiratory = std::max(cycle.peakExpiratory, -sample.flow);
  }
  cycle.samples = std::move(samples);
  return cycle;
}

}  // namespace

double BreathFit::resistanceAt(double phase) const {
  return resistanceOf(basisAt(phase), resistance);
}

BreathFit fitBreath(const MeasuredBreath& measured) {
  const Checks checks(measured);
  checks.requireRows();
  checks.requireTimes();
  checks.requireBreath();
  BreathFit fit;
  const auto [least, most] = std::ranges::minmax_element(measured.volume);
  fit.tidal = *most - *least;
  const Simulation simulation(measured);
  fit.period = simulation.period();
  const Residuals residuals{measured, simulation, fit.inertance,
                            *least,   fit.tidal,  fit.simulations};
  Values best;
  double bestNorm = 0.0;
  for (const double resistance : Starts) {
    Eigen::NumericalDiff<Residuals> differences(residuals);
    Eigen::LevenbergMarquardt<Eigen::NumericalDiff<Residuals>> solver(differences);
    solver.parameters.maxfev = MostSimulations;
    solver.parameters.ftol = solver.parameters.xtol = 1e-7;
    Values x = startOf(measured, resistance);
    solver.minimize(x);
    if (best.size() > 0 && !(solver.fnorm < bestNorm)) continue;
    best = x;
    bestNorm = solver.fnorm;
  }
  fit.rms = bestNorm / std::sqrt(static_cast<double>(measured.seconds.size()));
  fit.resistance = controlsOf(best);
  fit.compliance = std::exp(best[Controls]);
  fit.offset = best[Controls + 1];
  fit.cycle = cycleOf(simulation.breath(best, fit.inertance));
  return fit;
}

}  // namespace pneuma
