#pragma once

#include <array>
#include <string_view>
#include <vector>

namespace pneuma {

/// No resistance gets below this, cmH2O s / l.
inline constexpr double LeastResistance = 0.05;

/// How lungs answer pressure:
///   I V'' + R V' + (V - V0) / C = P - P0,
///   R = c1 + c2 |V'| + c3 (1 - v)+ + [V' < 0] (c4 + c5 (1 - v)+),  v = (V - V0) / VT,
/// a second-order equation whose resistance is a sum of five control parameters times basis
/// functions (Santhanam 2008, section on the pressure-volume relation). The paper does not print
/// its basis; this one tells apart flow, volume and narrowing in expiration. Volumes in l,
/// pressures in cmH2O.
struct BreathMechanics {
  double inertance = 0.01;                                       ///< I, cmH2O s^2 / l
  double compliance = 0.20;                                      ///< C, l / cmH2O
  std::array<double, 5> resistance = {1.6, 0.3, 0.2, 0.4, 0.4};  ///< c1 .. c5, cmH2O s / l
  double tidal = 0.5;                                            ///< VT of v, l
};

/// The muscles' pressure over one breath: a raised cosine up in `inspiration`, one down in
/// `relaxation`, then nothing.
struct BreathDrive {
  double period = 5.0;       ///< s
  double inspiration = 2.0;  ///< s
  double relaxation = 0.9;   ///< s
  double peak = 2.7;         ///< cmH2O
};

/// cmH2O at `seconds` after the beginning of a breath.
double drivePressure(const BreathDrive& drive, double seconds);

struct BreathSample {
  double seconds = 0.0;
  double pressure = 0.0;  ///< of the muscles, cmH2O
  double volume = 0.0;    ///< above V0, l
  double flow = 0.0;      ///< into the lungs, l / s
};

/// One breath of an endless row of equal ones.
struct BreathCycle {
  std::vector<BreathSample> samples;  ///< at equal steps; the last is the first one period later
  double tidal = 0.0;                 ///< largest less smallest volume, l
  double trapped = 0.0;               ///< smallest volume above V0, l
  double peakInspiratory = 0.0;       ///< largest flow in, l / s
  double peakExpiratory = 0.0;        ///< largest flow out, l / s
  double closure = 0.0;               ///< volume after the period less before, l

  /// Everything at a share of the period; whole numbers are the beginning of a breath.
  BreathSample at(double phase) const;
};

/// Breathes until every breath is like the one before (COPD takes eight breaths), to 1e-9 l.
/// Integrated linearly implicitly in steps of 1 ms: stable for any resistance.
/// @throws InvalidInput naming the value that is zero or negative, or if the breaths never settle
BreathCycle periodicBreath(const BreathMechanics& mechanics, const BreathDrive& drive);

/// The same with the drive's peak found for a wanted tidal volume.
/// @param tidal l
/// @throws InvalidInput as above, or if no pressure up to 200 cmH2O moves as much
BreathCycle breathOfVolume(const BreathMechanics& mechanics, BreathDrive& drive, double tidal);

/// Ways of breathing. Their values are plausible physiology, not fitted to patients.
enum class Breathing {
  Quiet,
  VitalCapacity,
  Copd,
  CopdSevere,
  Dyspnea,
  Stiff,
  Pneumothorax,
  Tumour
};

constexpr auto choices(Breathing) {
  return std::array<std::string_view, 8>{"quiet",   "vital-capacity", "copd",         "copd-severe",
                                         "dyspnea", "stiff",          "pneumothorax", "tumour"};
}

/// Everything that belongs to a way of breathing.
struct BreathScenario {
  std::string_view title;  ///< for people
  BreathMechanics mechanics;
  BreathDrive drive;
  bool deep = false;                ///< lungs move as in a deep breath
  double affectedCompliance = 1.0;  ///< share of its compliance that one lung keeps
  double affectedRest = 1.0;        ///< share of its resting volume that one lung keeps
};

const BreathScenario& scenarioOf(Breathing breathing);

}  // namespace pneuma
