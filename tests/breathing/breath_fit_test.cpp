#include "breathing/breath_fit.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/error.h"

namespace pneuma {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;

/// Lungs that are richer than the equation that is fitted: flow-dependent resistance (Rohrer), a
/// viscoelastic part, elastance that rises with volume, airways that narrow in expiration.
struct Truth {
  double rohrer1, rohrer2;       // cmH2O s / l, cmH2O s^2 / l^2
  double elastance, stiffening;  // cmH2O / l, cmH2O / l^2
  double viscous, relaxation;    // cmH2O / l, s
  double narrowing;              // cmH2O s / l at the end of expiration
  double tidal;                  // l, about
  BreathDrive drive;
};

const std::array<Truth, 4> Truths = {
    {{1.6, 0.4, 5.0, 1.0, 1.0, 0.8, 0.5, 0.5, {5.0, 2.0, 0.9, 3.6}},
     {2.5, 0.8, 8.0, 4.0, 2.0, 0.5, 1.0, 0.5, {4.0, 1.5, 0.7, 6.5}},
     {1.6, 0.6, 5.0, 0.5, 1.0, 1.0, 0.5, 0.8, {2.4, 1.0, 0.45, 6.5}},
     {4.0, 1.5, 4.0, 0.5, 1.5, 0.8, 8.0, 0.5, {4.0, 1.3, 0.6, 6.5}}}};

/// The eighth breath, 201 rows.
MeasuredBreath breathOf(const Truth& truth) {
  constexpr int Steps = 10000;
  constexpr int Rows = 200;
  const double dt = truth.drive.period / Steps;
  double volume = 0.0;
  double flow = 0.0;
  double viscous = 0.0;
  MeasuredBreath measured;
  for (int n = 0; n <= 8 * Steps; ++n) {
    const double seconds = std::fmod(n, Steps) * dt;
    if (n >= 7 * Steps && n % (Steps / Rows) == 0) {
      measured.seconds.push_back((n - 7 * Steps) * dt);
      measured.pressure.push_back(drivePressure(truth.drive, seconds));
      measured.volume.push_back(2.0 + volume);
    }
    const double narrow = std::max(0.0, 1.0 - volume / truth.tidal);
    const double resistance = truth.rohrer1 + truth.rohrer2 * std::abs(flow) +
                              (flow < 0.0 ? truth.narrowing * narrow : 0.0);
    const double elastic = truth.elastance * volume + truth.stiffening * volume * volume;
    const double drive = drivePressure(truth.drive, seconds) - elastic - viscous;
    flow = (0.01 * flow + dt * drive) / (0.01 + dt * resistance);
    volume += dt * flow;
    viscous += dt * (truth.viscous * flow - viscous / truth.relaxation);
  }
  return measured;
}

double tidalOf(const MeasuredBreath& measured) {
  const auto [least, most] = std::ranges::minmax_element(measured.volume);
  return *most - *least;
}

TEST(BreathFit, DescribesRicherLungsToOnePercent) {
  for (const Truth& truth : Truths) {
    const MeasuredBreath measured = breathOf(truth);
    const BreathFit fit = fitBreath(measured);
    const double least = *std::ranges::min_element(measured.volume);
    EXPECT_LE(fit.rms, 0.01) << truth.rohrer1;
    EXPECT_NEAR(fit.tidal, tidalOf(measured), 1e-12);
    EXPECT_NEAR(fit.cycle.tidal, fit.tidal, 0.01 * fit.tidal);
    EXPECT_NEAR(fit.period, truth.drive.period, 1e-9);
    EXPECT_LE(std::abs(fit.cycle.closure), 1e-9);
    EXPECT_NEAR(fit.cycle.at(0.25).volume, measured.volume[50] - least, 0.02 * fit.tidal);
  }
}

TEST(BreathFit, SeesThroughNoise) {
  for (const Truth& truth : Truths) {
    const MeasuredBreath clean = breathOf(truth);
    MeasuredBreath noisy = clean;
    std::mt19937 random(11);
    std::normal_distribution<double> one(0.0, 0.01);
    for (std::size_t n = 0; n + 1 < noisy.volume.size(); ++n) {
      noisy.volume[n] += one(random) * tidalOf(clean);
      noisy.pressure[n] += 0.01 * truth.drive.peak *
                           std::sin(2.0 * std::numbers::pi * 1.2 * noisy.seconds[n]);  // the heart
    }
    const BreathFit fit = fitBreath(noisy);
    EXPECT_NEAR(fit.rms, 0.01, 0.002);
    const double least = *std::ranges::min_element(clean.volume);
    double mean = 0.0;  // the fitted breath counts from its own least volume
    std::vector<double> off;
    for (std::size_t n = 0; n < clean.volume.size(); ++n) {
      const double phase = static_cast<double>(n) / 200.0;
      off.push_back((fit.cycle.at(phase).volume - (clean.volume[n] - least)) / tidalOf(clean));
      mean += off.back() / static_cast<double>(clean.volume.size());
    }
    double sum = 0.0;
    for (const double value : off) sum += (value - mean) * (value - mean);
    EXPECT_LE(std::sqrt(sum / static_cast<double>(off.size())), 0.005) << truth.rohrer1;
  }
}

TEST(BreathFit, FindsTheConstantsOfItsOwnEquation) {
  // Constant resistance: every c is that resistance.
  Truth plain{3.0, 0.0, 5.0, 0.0, 0.0, 1.0, 0.0, 0.5, {5.0, 2.0, 0.9, 4.0}};
  MeasuredBreath measured = breathOf(plain);
  for (double& pressure : measured.pressure) pressure += 2.0;
  const BreathFit fit = fitBreath(measured);
  EXPECT_LE(fit.rms, 0.001);
  EXPECT_NEAR(fit.compliance, 0.2, 0.002);
  EXPECT_NEAR(fit.offset, 2.0, 0.05);
  for (int k = 0; k < 10; ++k) EXPECT_NEAR(fit.resistanceAt(0.1 * k), 3.0, 0.3) << k;
}

TEST(BreathFit, FindsAnotherComplianceThanTheTurningPointsSay) {
  // This is why the five parameters alone, as the paper has it, are not enough.
  const BreathFit fit = fitBreath(breathOf(Truths[3]));
  const double turning = fit.tidal / Truths[3].drive.peak;
  EXPECT_GT(std::abs(fit.compliance / turning - 1.0), 0.1);
}

std::string refusal(const MeasuredBreath& measured) {
  try {
    fitBreath(measured);
  } catch (const InvalidInput& error) {
    return error.what();
  }
  return "";
}

TEST(BreathFit, NamesTheLineThatIsWrong) {
  MeasuredBreath sound = breathOf(Truths[0]);
  sound.name = "breath.csv";
  for (std::size_t n = 0; n < sound.seconds.size(); ++n) sound.lines.push_back(n + 3);
  MeasuredBreath wrong = sound;
  wrong.seconds[10] = wrong.seconds[9];
  EXPECT_THAT(refusal(wrong), AllOf(HasSubstr("breath.csv, line 13"), HasSubstr("rise")));
  wrong.seconds[9] = wrong.seconds[8] - 0.01;
  EXPECT_THAT(refusal(wrong), HasSubstr("line 12"));
  wrong = sound;
  wrong.pressure[20] = std::nan("");
  EXPECT_THAT(refusal(wrong), HasSubstr("line 23"));
  wrong = sound;
  for (std::size_t n = 100; n < wrong.seconds.size(); ++n) wrong.seconds[n] += 1.0;
  EXPECT_THAT(refusal(wrong), AllOf(HasSubstr("line 103"), HasSubstr("gaps")));
  wrong = sound;
  wrong.seconds.resize(29);
  wrong.pressure.resize(29);
  wrong.volume.resize(29);
  EXPECT_THAT(refusal(wrong), HasSubstr("29 rows"));
  wrong = sound;
  for (double& pressure : wrong.pressure) pressure = -pressure;
  EXPECT_THAT(refusal(wrong), AllOf(HasSubstr("compliance would be negative"), HasSubstr("line")));
  wrong = sound;
  wrong.volume.back() += 0.2;
  EXPECT_THAT(refusal(wrong), AllOf(HasSubstr("line 203"), HasSubstr("whole breath")));
  wrong = sound;
  for (double& volume : wrong.volume) volume *= 1000.0;
  EXPECT_THAT(refusal(wrong), HasSubstr("unit"));
  for (double& volume : wrong.volume) volume = 1.0;
  EXPECT_THAT(refusal(wrong), HasSubstr("0.000000 ml"));
  wrong.lines.clear();
  wrong.name.clear();
  wrong.seconds[10] = wrong.seconds[9];
  EXPECT_THAT(refusal(wrong), HasSubstr("row 11"));
}

}  // namespace
}  // namespace pneuma
