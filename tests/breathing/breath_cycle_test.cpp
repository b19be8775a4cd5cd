#include "breathing/breath_cycle.h"

#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include "core/error.h"

namespace pneuma {
namespace {

BreathCycle of(Breathing breathing) {
  const BreathScenario& scenario = scenarioOf(breathing);
  return periodicBreath(scenario.mechanics, scenario.drive);
}

TEST(BreathCycle, SlowlyDrivenFollowsComplianceAlone) {
  // Without resistance and inertia to speak of, V = C P at every moment.
  BreathMechanics mechanics;
  mechanics.resistance = {0.05, 0.0, 0.0, 0.0, 0.0};
  mechanics.inertance = 1e-6;
  const BreathDrive slow{60.0, 25.0, 25.0, 5.0};
  const BreathCycle cycle = periodicBreath(mechanics, slow);
  EXPECT_NEAR(cycle.tidal, 0.2 * 5.0, 1e-3);
  for (const double phase : {0.1, 0.3, 0.42, 0.6, 0.9}) {
    const BreathSample sample = cycle.at(phase);
    EXPECT_NEAR(sample.volume, 0.2 * sample.pressure, 2e-3) << phase;
  }
}

TEST(BreathCycle, ConstantResistanceDecaysExponentiallyOnceTheDriveIsOver) {
  BreathMechanics mechanics;
  mechanics.resistance = {5.0, 0.0, 0.0, 0.0, 0.0};
  const BreathDrive drive{8.0, 1.0, 0.5, 5.0};
  const BreathCycle cycle = periodicBreath(mechanics, drive);
  // I C x^2 + R C x + 1 = 0: the slow root.
  const double ic = mechanics.inertance * mechanics.compliance;
  const double rc = 5.0 * mechanics.compliance;
  const double rate = (-rc + std::sqrt(rc * rc - 4.0 * ic)) / (2.0 * ic);
  const double from = cycle.at(3.0 / 8.0).volume;
  EXPECT_NEAR(cycle.at(5.0 / 8.0).volume / from, std::exp(2.0 * rate), 2e-3);
}

TEST(BreathCycle, EnergyBalances) {
  // Over a period what the muscles put in is what resistance takes out.
  const BreathScenario& scenario = scenarioOf(Breathing::Copd);
  const BreathCycle cycle = of(Breathing::Copd);
  double in = 0.0;
  double lost = 0.0;
  for (std::size_t i = 1; i < cycle.samples.size(); ++i) {
    const BreathSample& s = cycle.samples[i];
    const double dt = s.seconds - cycle.samples[i - 1].seconds;
    in += dt * s.pressure * s.flow;
    const double low = std::max(0.0, 1.0 - s.volume / scenario.mechanics.tidal);
    const auto& c = scenario.mechanics.resistance;
    const double r =
        c[0] + c[1] * std::abs(s.flow) + c[2] * low + (s.flow < 0.0 ? c[3] + c[4] * low : 0.0);
    lost += dt * r * s.flow * s.flow;
  }
  EXPECT_NEAR(lost / in, 1.0, 0.01);
}

struct Expected {
  Breathing breathing;
  double tidal, peakIn, peakOut, trapped;
};

/// The table of an independent prototype.
TEST(BreathCycle, ScenariosAreThoseOfTheTable) {
  for (const Expected& e : {Expected{Breathing::Quiet, 0.501, 0.38, 0.52, 0.003},
                            Expected{Breathing::Copd, 0.501, 0.65, 0.34, 0.268},
                            Expected{Breathing::CopdSevere, 0.449, 0.70, 0.27, 0.632},
                            Expected{Breathing::Dyspnea, 0.752, 1.22, 1.22, 0.092}}) {
    const BreathCycle cycle = of(e.breathing);
    EXPECT_NEAR(cycle.tidal, e.tidal, 0.02 * e.tidal);
    EXPECT_NEAR(cycle.peakInspiratory, e.peakIn, 0.03);
    EXPECT_NEAR(cycle.peakExpiratory, e.peakOut, 0.06);
    EXPECT_NEAR(cycle.trapped, e.trapped, 0.01);
  }
  EXPECT_NEAR(of(Breathing::Stiff).tidal, 0.301, 0.006);
  EXPECT_NEAR(of(Breathing::Tumour).tidal, 0.480, 0.01);
  EXPECT_NEAR(of(Breathing::Pneumothorax).tidal, 0.351, 0.02);
}

TEST(BreathCycle, EveryScenarioRepeatsItself) {
  for (std::size_t n = 0; n < choices(Breathing{}).size(); ++n) {
    const BreathCycle cycle = of(static_cast<Breathing>(n));
    EXPECT_LE(std::abs(cycle.closure), 1e-9) << n;
    EXPECT_NEAR(cycle.at(1.0).volume, cycle.at(0.0).volume, 1e-12);
    EXPECT_NEAR(cycle.at(2.25).volume, cycle.at(0.25).volume, 1e-12);
  }
}

TEST(BreathCycle, ReachesAWantedVolume) {
  for (std::size_t n = 0; n < choices(Breathing{}).size(); ++n) {
    const BreathScenario& scenario = scenarioOf(static_cast<Breathing>(n));
    BreathDrive drive = scenario.drive;
    EXPECT_NEAR(breathOfVolume(scenario.mechanics, drive, 0.6).tidal, 0.6, 1e-9) << n;
  }
}

TEST(BreathCycle, RefusesWhatCannotBreathe) {
  const BreathDrive drive;
  BreathMechanics mechanics;
  mechanics.compliance = 0.0;
  EXPECT_THROW(periodicBreath(mechanics, drive), InvalidInput);
  mechanics.compliance = -0.2;
  EXPECT_THROW(periodicBreath(mechanics, drive), InvalidInput);
  mechanics.compliance = std::nan("");
  EXPECT_THROW(periodicBreath(mechanics, drive), InvalidInput);
  mechanics = {};
  EXPECT_THROW(periodicBreath(mechanics, BreathDrive{2.0, 1.8, 0.9, 3.0}), InvalidInput);
  EXPECT_THROW(periodicBreath(mechanics, BreathDrive{0.0, 1.0, 0.5, 3.0}), InvalidInput);
  BreathDrive any;
  EXPECT_THROW(breathOfVolume(mechanics, any, 500.0), InvalidInput);
}

}  // namespace
}  // namespace pneuma
