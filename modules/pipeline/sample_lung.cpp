#include "pipeline/sample_lung.h"

#include <algorithm>
#include <cmath>

namespace pneuma {
namespace {

double square(double v) { return v * v; }

// The fissures in the frame of the model, below: oblique z = h - slope y - bend y^2, horizontal
// z = h + slope y - sideBend (x - side)^2.
constexpr double ObliqueSlope = 1.15;
constexpr double ObliqueBend = 0.0009;
constexpr double HorizontalSlope = 0.06;
constexpr double HorizontalSideBend = 0.0005;
constexpr double HorizontalSide = 80.0;

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

double SampleLung::aboveOblique(const Vec3& p) const {
  constexpr double Steepest = 1.7;  // of the gradient, in the lung's box
  return (p.z() - oblique + ObliqueSlope * p.y() + ObliqueBend * square(p.y())) / Steepest;
}

double SampleLung::aboveHorizontal(const Vec3& p) const {
  constexpr double Steepest = 1.01;
  return (p.z() - horizontal - HorizontalSlope * p.y() +
          HorizontalSideBend * square(p.x() - HorizontalSide)) /
         Steepest;
}

std::vector<SampleFissure> SampleLung::fissures() const {
  if (side == Side::Left) return {{"left-oblique", oblique, ObliqueSlope, -ObliqueBend}};
  return {{"right-oblique", oblique, ObliqueSlope, -ObliqueBend},
          {"right-horizontal", horizontal, -HorizontalSlope, 0.0, -HorizontalSideBend,
           -HorizontalSide}};
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
    shape.oblique = -50.0;
    shape.horizontal = -16.0;
  } else {
    shape.scale = 1.065;
    shape.heartCentre = {12.0, 42.0, -80.0};
    shape.heartSemiAxes = {66.0, 56.0, 76.0};
    shape.oblique = -45.0;
  }
  return shape;
}

}  // namespace pneuma
