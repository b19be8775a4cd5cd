#include "pipeline/sample_lung.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/units.h"

namespace pneuma {
namespace {

/// Of the points on a fissure, along x and y.
constexpr double PointsMm = 8.0;

/// @param directionDeg of its crests' way, from the left to the back
FissureWave wave(double amplitudeMm, double lengthMm, double directionDeg, double phase) {
  const double perMm = 2.0 * std::numbers::pi / lengthMm;
  const double direction = radians(directionDeg);
  return {amplitudeMm, perMm * std::cos(direction), perMm * std::sin(direction), phase};
}

// As rough as the fissures of lobes_airways_chaste are: 4 to 7 mm on average from their best plane,
// and a spline through 12 or 25 points of them errs as much.
SampleFissure rightOblique() {
  SampleFissure fissure{"right-oblique", -42.0, 1.15, -0.0009};
  fissure.waves = {wave(20.0, 200.0, 25.0, 0.9), wave(11.0, 130.0, 115.0, 1.9),
                   wave(4.0, 70.0, 20.0, 0.7)};
  return fissure;
}

SampleFissure rightHorizontal() {
  SampleFissure fissure{"right-horizontal", -14.0, -0.06, 0.0, -0.0005, -80.0};
  fissure.waves = {wave(11.0, 150.0, 12.0, 2.7), wave(5.0, 95.0, 165.0, 0.5),
                   wave(1.5, 60.0, 20.0, 1.0)};
  return fissure;
}

SampleFissure leftOblique() {
  SampleFissure fissure{"left-oblique", -39.0, 1.15, -0.0009};
  fissure.waves = {wave(21.0, 170.0, 155.0, 0.6), wave(11.0, 130.0, 70.0, 2.2),
                   wave(4.0, 70.0, 160.0, 1.1)};
  return fissure;
}

/// Points on a fissure within the pleura.
std::vector<Vec3> pointsOf(const SampleFissure& fissure, const SampleLung& lung) {
  const Box3 box = lung.bounds();
  std::vector<Vec3> points;
  for (double y = box.min().y() + PointsMm / 2.0; y < box.max().y(); y += PointsMm) {
    for (double x = box.min().x() + PointsMm / 2.0; x < box.max().x(); x += PointsMm) {
      const Vec3 p(x, y, fissure.zAt(x, y));
      if (lung.pleura(lung.modelFromLps(p)) > 0.0) points.push_back(p);
    }
  }
  return points;
}

}  // namespace

double roundedMin(double a, double b, double width) {
  const double h = std::max(width - std::abs(a - b), 0.0) / width;
  return std::min(a, b) - h * h * width / 4.0;
}

double outsideEllipsoid(const Vec3& p, const Vec3& centre, const Vec3& semiAxes) {
  return ((p - centre).cwiseQuotient(semiAxes).norm() - 1.0) * semiAxes.minCoeff();
}

const Vec3 SampleLung::DomeCentre{70.0, 20.0, -158.0};
const Vec3 SampleLung::DomeSemiAxes{62.0, 84.0, 62.0};

double SampleLung::pleura(const Vec3& model) const {
  constexpr double Rounding = 8.0;
  constexpr double SectionMm = 31.0;  // makes the section's level 1-Lipschitz in the lung's box
  constexpr double Endless = 1e9;
  const Vec3 p = model / scale;
  const double t = std::max(0.0, (p.z() + 158.0) / 270.0);
  const double waist = 1.0 - std::pow(t, 2.4);
  const double section = std::copysign(std::pow(std::abs(waist), 1.15), waist) -
                         std::pow(std::abs((p.x() - 18.0) / 118.0), 2.3) -
                         std::pow(std::abs((p.y() + 8.0) / 98.0), 2.3);
  double level = roundedMin(SectionMm * section, p.x() - 18.0, Rounding);
  // The base rises to the front, so that the oblique fissure leaves no pocket of lower lobe
  // there.
  const double aboveBase = (p.z() + 152.0 - 0.4 * std::max(p.y(), 0.0)) / 1.08;
  level = roundedMin(level, aboveBase, Rounding);
  const auto outside = [&](const Vec3& centre, const Vec3& semiAxes) {
    level = roundedMin(level, outsideEllipsoid(p, centre, semiAxes), Rounding);
  };
  outside(DomeCentre, DomeSemiAxes);
  outside(heartCentre, heartSemiAxes);
  outside({0.0, -78.0, 0.0}, {34.0, 45.0, Endless});  // spine
  return scale * level;
}

std::vector<SampleFissure> SampleLung::fissures() const {
  if (!horizontal) return {oblique};
  return {oblique, *horizontal};
}

Box3 SampleLung::bounds() const {
  Box3 box;
  box.extend(lpsFromModel(scale * Vec3(18.0, -106.0, -158.0)));
  box.extend(lpsFromModel(scale * Vec3(136.0, 90.0, 112.0)));
  return box;
}

SampleLung sampleLung(Side side) {
  SampleLung shape;
  shape.side = side;
  if (side == Side::Right) {
    shape.scale = 1.0855;
    shape.heartCentre = {0.0, 38.0, -78.0};
    shape.heartSemiAxes = {56.0, 52.0, 72.0};
    shape.oblique = rightOblique();
    shape.horizontal = rightHorizontal();
  } else {
    shape.scale = 1.065;
    shape.heartCentre = {12.0, 42.0, -80.0};
    shape.heartSemiAxes = {66.0, 56.0, 76.0};
    shape.oblique = leftOblique();
  }
  shape.oblique.steepest = shape.oblique.steepestIn(shape.bounds());
  shape.oblique.points = pointsOf(shape.oblique, shape);
  if (shape.horizontal) {
    shape.horizontal->steepest = shape.horizontal->steepestIn(shape.bounds());
    shape.horizontal->points = pointsOf(*shape.horizontal, shape);
    std::erase_if(shape.horizontal->points,
                  [&](const Vec3& p) { return shape.oblique.above(p) <= 0.0; });
  }
  return shape;
}

}  // namespace pneuma
