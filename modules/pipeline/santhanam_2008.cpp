#include "pipeline/santhanam_2008.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "breathing/lung_motion.h"
#include "core/random.h"
#include "pipeline/detail/sample_walls.h"

namespace pneuma {
namespace {

constexpr double MostLitres = 3.0;
constexpr int InhaledSteps = 30;
constexpr double CubicMmPerLitre = 1e6;

}  // namespace

MeasuredBreath measuredScenario(Breathing breathing, double noise) {
  constexpr int Rows = 200;
  const BreathScenario& scenario = scenarioOf(breathing);
  const BreathCycle cycle = periodicBreath(scenario.mechanics, scenario.drive);
  Random random(1);
  MeasuredBreath measured;
  for (int n = 0; n <= Rows; ++n) {
    const double phase = static_cast<double>(n) / Rows;
    const BreathSample sample = n < Rows ? cycle.at(phase) : cycle.samples.back();
    measured.seconds.push_back(phase * cycle.samples.back().seconds);
    measured.pressure.push_back(sample.pressure);
    measured.volume.push_back(sample.volume + noise * cycle.tidal * random.normal());
  }
  return measured;
}

InhaledVolumes inhaledVolumes(const Progress& progress) {
  const std::map<Side, TriangleMesh> walls = sampleWalls();
  double restMm3 = 0.0;
  for (const auto& [side, wall] : walls) restMm3 += signedVolumeMm3(wall);
  std::map<Side, LungMotion> motions;
  for (const auto& [side, wall] : walls) {
    const double most = signedVolumeMm3(wall) * (1.0 + MostLitres * CubicMmPerLitre / restMm3);
    motions.emplace(side, LungMotion(side, wall, MotionPreset::Deep, most));
  }
  progress.report(0.5);
  InhaledVolumes found;
  for (int n = 0; n <= InhaledSteps; ++n) {
    const double litres = MostLitres * n / InhaledSteps;
    Box3 box;
    for (const auto& [side, motion] : motions) {
      const double share = motion.restMm3() / restMm3;
      const double scale = motion.scaleFor(motion.restMm3() + share * litres * CubicMmPerLitre);
      for (std::size_t k = 0; k < motion.ofWall().size(); ++k) {
        box.extend(motion.wall().points[k] + scale * motion.ofWall()[k]);
      }
      if (side == Side::Right) found.scale.push_back(scale);
    }
    found.litres.push_back(litres);
    for (std::size_t axis = 0; axis < 3; ++axis) {
      found.boxMm[axis].push_back(box.sizes()[static_cast<Eigen::Index>(axis)]);
    }
    found.boxShare.push_back((restMm3 + litres * CubicMmPerLitre) / box.volume());
  }
  return found;
}

double linearity(const std::vector<double>& x, const std::vector<double>& y, std::size_t count) {
  const auto end = static_cast<std::ptrdiff_t>(count);
  const double meanX =
      std::accumulate(x.begin(), x.begin() + end, 0.0) / static_cast<double>(count);
  const double meanY =
      std::accumulate(y.begin(), y.begin() + end, 0.0) / static_cast<double>(count);
  double both = 0.0;
  double ofX = 0.0;
  double ofY = 0.0;
  for (std::size_t n = 0; n < count; ++n) {
    both += (x[n] - meanX) * (y[n] - meanY);
    ofX += (x[n] - meanX) * (x[n] - meanX);
    ofY += (y[n] - meanY) * (y[n] - meanY);
  }
  return both * both / (ofX * ofY);
}

NeedledTumour needledTumour() {
  constexpr int Moments = 500;
  constexpr double Height = 0.3;  // of the lung's box, from its base
  const std::map<Side, TriangleMesh> walls = sampleWalls();
  double bothMm3 = 0.0;
  for (const auto& [side, wall] : walls) bothMm3 += signedVolumeMm3(wall);
  const TriangleMesh& wall = walls.at(Side::Right);
  const double share = signedVolumeMm3(wall) / bothMm3;
  const BreathScenario& scenario = scenarioOf(Breathing::Quiet);
  const BreathCycle cycle = periodicBreath(scenario.mechanics, scenario.drive);
  const auto volumeAt = [&](double litres) {
    return signedVolumeMm3(wall) + share * litres * CubicMmPerLitre;
  };
  const LungMotion motion(Side::Right, wall, MotionPreset::Quiet,
                          volumeAt(cycle.trapped + cycle.tidal));
  const Box3 box = bounds(wall);
  Vec3 centre = box.center();
  centre.z() = box.min().z() + Height * box.sizes().z();
  const Vec3 u = motion.at(centre);
  const double across = std::hypot(u.y(), u.z());  // the needle lies along x
  NeedledTumour tumour{7.5, 0.0, 0.0};
  for (int n = 0; n < Moments; ++n) {
    const double litres = cycle.at(static_cast<double>(n) / Moments).volume;
    const double distance = motion.scaleFor(volumeAt(litres)) * across;
    tumour.farthestMm = std::max(tumour.farthestMm, distance);
    if (distance <= tumour.radiusMm) tumour.hitShare += 1.0 / Moments;
  }
  return tumour;
}

}  // namespace pneuma
