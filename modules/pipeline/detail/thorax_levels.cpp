#include "pipeline/detail/thorax_levels.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "pipeline/sample_lung.h"

namespace pneuma {
namespace {

/// The lungs' own formula (SampleLung::pleura) for both at once, without a midline, diaphragm,
/// heart and spine, and a little larger than either.
double cageLevel(const Vec3& p) {
  constexpr double Scale = 1.09;
  constexpr double Power = 2.3;
  const Vec3 q = p / Scale;
  const double t = std::clamp((q.z() + 158.0) / 270.0, 0.0, 0.985);
  const double waist = 1.0 - std::pow(t, 2.4);
  const double across = std::max(std::abs(q.x()) - 18.0, 0.0) / 118.0;
  const double along = std::abs(q.y() - 8.0) / 98.0;
  const double gauge = std::pow(std::pow(across, Power) + std::pow(along, Power), 1.0 / Power);
  const double steep = 98.0 * 1.2 * std::pow(t, 1.4) / (270.0 * std::sqrt(waist));
  return Scale * 98.0 * (std::sqrt(waist) - gauge) / std::sqrt(1.0 + steep * steep);
}

using BothLungs = std::array<SampleLung, 2>;

/// Fills the hollows that it makes in the lungs.
double heartLevel(const BothLungs& lungs, const Vec3& p) {
  constexpr double BelowCageMm = 3.0;
  constexpr double LowestMm = -155.0;
  double level = -1e9;
  for (const SampleLung& lung : lungs) {
    level = std::max(level, -outsideEllipsoid(lung.modelFromLps(p), lung.scale * lung.heartCentre,
                                              lung.scale * lung.heartSemiAxes));
  }
  return std::min({level, cageLevel(p) - BelowCageMm, p.z() - LowestMm});
}

double abdomenLevel(const BothLungs& lungs, const Vec3& p) {
  constexpr double RoundedMm = 8.0;  // the lungs' edges leave gaps above the domes that it fills
  double level = -1e9;
  for (const SampleLung& lung : lungs) {
    const Vec3 q = lung.modelFromLps(p);
    const Vec3 semiAxes = lung.scale * SampleLung::DomeSemiAxes + Vec3::Constant(RoundedMm);
    level = std::max(level, -outsideEllipsoid(q, lung.scale * SampleLung::DomeCentre, semiAxes));
    const double base = lung.scale * -152.0 + 0.4 * std::max(q.y(), 0.0);
    level = std::max(level, (base + RoundedMm / 2.0 - q.z()) / 1.08);
  }
  return std::min(level, cageLevel(p) + 1.0);
}

double bodyLevel(const Vec3& p) {
  const double up = std::max(p.z() - 40.0, 0.0);
  const double wide = 181.0 + 0.06 * up;
  const double deep = 139.0 - 0.12 * up;
  const double across = std::abs(p.x()) / wide;
  const double along = std::abs(p.y() - 13.0) / deep;
  return deep * (1.0 - std::pow(std::pow(across, 2.4) + std::pow(along, 2.4), 1.0 / 2.4));
}

}  // namespace

std::shared_ptr<const ThoraxLevels> thoraxLevels() {
  constexpr double CellMm = 3.0;
  const BothLungs lungs = {sampleLung(Side::Right), sampleLung(Side::Left)};
  // Tilted slices reach far up and down.
  const Box3 all(Vec3(-210.0, -140.0, -290.0), Vec3(210.0, 170.0, 240.0));
  const Box3 aroundHeart(Vec3(-80.0, -115.0, -180.0), Vec3(100.0, 40.0, 10.0));
  return std::make_shared<const ThoraxLevels>(ThoraxLevels{
      LevelTable(cageLevel, all, CellMm),
      LevelTable([&](const Vec3& p) { return heartLevel(lungs, p); }, aroundHeart, CellMm),
      LevelTable([&](const Vec3& p) { return abdomenLevel(lungs, p); },
                 Box3(all.min(), Vec3(210.0, 170.0, -60.0)), CellMm),
      LevelTable(bodyLevel, all, CellMm)});
}

}  // namespace pneuma
