#pragma once

#include <array>
#include <string>
#include <vector>

#include "breathing/breath_cycle.h"

namespace pneuma {

/// One measured breath, its last row being the first of the next breath.
struct MeasuredBreath {
  std::string name;                ///< of the file, for messages; may be empty
  std::vector<std::size_t> lines;  ///< of the rows in it; may be empty
  std::vector<double> seconds;
  std::vector<double>
      pressure;                ///< that drives air in, cmH2O: of the muscles, or minus oesophageal
  std::vector<double> volume;  ///< l, from anywhere
};

/// The second-order equation of a breath with its constants found from measured pressure and volume
/// (Santhanam 2008, section III-B):
///   I V'' + R V' + (V - V0) / C = P - P0,  R = sum of c_k B_k(t / T),
/// five control parameters c_k times a basis, here five periodic quadratic B-splines over the
/// breath (the paper prints none). As R depends on the phase alone, the equation is linear, and its
/// periodic solution is found without breathing towards it. C and P0 are found as well: with them
/// frozen at what the turning points say, the error is 2 to 4 % and not the paper's 1 %.
struct BreathFit {
  std::array<double, 5> resistance{};  ///< c1 .. c5, cmH2O s / l
  double compliance = 0.0;             ///< C, l / cmH2O
  double offset = 0.0;                 ///< P0 with V0 the least measured volume, cmH2O
  double inertance = 0.01;             ///< I, not found but set, cmH2O s^2 / l
  double period = 0.0;                 ///< T, s
  double tidal = 0.0;                  ///< measured, l
  double rms = 0.0;     ///< of fitted less measured volume, share of the tidal volume
  int simulations = 0;  ///< of a breath, until the constants were found
  BreathCycle cycle;    ///< the fitted breath; volumes above its least, pressures as measured

  /// R, cmH2O s / l.
  double resistanceAt(double phase) const;
};

/// Finds the constants by Levenberg and Marquardt's method.
/// @throws InvalidInput naming the line: fewer than 30 rows, no numbers, times that do not rise or
/// leave a gap, volumes that do not move or do not come back, pressure that falls as the lungs fill
BreathFit fitBreath(const MeasuredBreath& measured);

}  // namespace pneuma
