#include "pipeline/sample_fissure.h"

#include <algorithm>
#include <cmath>

namespace pneuma {

double SampleFissure::zAt(double x, double y) const {
  double z = heightMm + slope * y + bend * y * y + sideBend * (x - sideMm) * (x - sideMm);
  for (const FissureWave& wave : waves) {
    z += wave.amplitudeMm * std::sin(wave.xPerMm * x + wave.yPerMm * y + wave.phase);
  }
  return z;
}

double SampleFissure::steepness(double x, double y) const {
  double alongX = 2.0 * sideBend * (x - sideMm);
  double alongY = slope + 2.0 * bend * y;
  for (const FissureWave& wave : waves) {
    const double rise = wave.amplitudeMm * std::cos(wave.xPerMm * x + wave.yPerMm * y + wave.phase);
    alongX += rise * wave.xPerMm;
    alongY += rise * wave.yPerMm;
  }
  return std::sqrt(1.0 + alongX * alongX + alongY * alongY);
}

double SampleFissure::steepestIn(const Box3& box) const {
  const auto most = [](double a, double b) { return std::max(std::abs(a), std::abs(b)); };
  double alongX =
      2.0 * most(sideBend * (box.min().x() - sideMm), sideBend * (box.max().x() - sideMm));
  double alongY = most(slope + 2.0 * bend * box.min().y(), slope + 2.0 * bend * box.max().y());
  for (const FissureWave& wave : waves) {
    alongX += std::abs(wave.amplitudeMm * wave.xPerMm);
    alongY += std::abs(wave.amplitudeMm * wave.yPerMm);
  }
  return std::sqrt(1.0 + alongX * alongX + alongY * alongY);
}

SampleFissure SampleFissure::mirrored() const {
  SampleFissure turned = *this;
  turned.sideMm = -sideMm;
  for (FissureWave& wave : turned.waves) wave.xPerMm = -wave.xPerMm;
  for (Vec3& p : turned.points) p.x() = -p.x();
  return turned;
}

}  // namespace pneuma
