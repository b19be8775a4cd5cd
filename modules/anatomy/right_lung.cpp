#include "anatomy/right_lung.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <string>

#include "anatomy/diameter_law.h"
#include "core/error.h"
#include "core/grid_domain.h"
#include "core/units.h"

namespace pneuma {
namespace {

// The formulas are written in the frame of docs/algorithms/centroid-splitting.md: x to the
// patient's right, y to the front, z up, carina at the origin. LPS turns it by 180 degrees about z.
Vec3 lpsFromModel(const Vec3& p) { return {-p.x(), -p.y(), p.z()}; }

Vec3 modelFromLps(const Vec3& p) { return {-p.x(), -p.y(), p.z()}; }

constexpr double UnitVolumeMl = 2496.9;  // of the lung at scale 1; checked by a test
constexpr double GridCellMm = 2.0;

double square(double v) { return v * v; }

/// |v|^2.5 and |v|^2.25 for |v| in [0, 1]: bounds of the powers below, without std::pow.
double powerAbove(double v) { return v * v * std::sqrt(v); }

double powerBelow(double v) { return v * v * std::sqrt(std::sqrt(v)); }

/// Inside the superellipse |x|^2.3 + |y|^2.3 <= 1 shrunk by sqrt(1 - t^2.4)? x, y, t >= 0.
/// Bounds decide almost always; the powers themselves cost ten times as much.
bool insideSection(double x, double y, double t) {
  const double low = std::sqrt(1.0 - powerBelow(t));  // of the shrinking factor
  if (x * x + y * y <= low * low) return true;
  const double high = std::sqrt(1.0 - powerAbove(t));
  if (x > high || y > high) return false;
  if (powerAbove(x / high) + powerAbove(y / high) > 1.0) return false;
  const double rho = std::sqrt(1.0 - std::pow(t, 2.4));
  return std::pow(x / rho, 2.3) + std::pow(y / rho, 2.3) <= 1.0;
}

/// Inside the lung at scale 1?
bool insideLung(const Vec3& p) {
  if (p.z() <= -158.0 || p.z() >= 112.0 || p.x() < 18.0) return false;
  const double dome =
      1.0 - square((p.x() - 70.0) * (1.0 / 75.0)) - square((p.y() - 5.0) * (1.0 / 95.0));
  if (dome > 0.0 && p.z() < -158.0 + 62.0 * std::sqrt(dome)) return false;
  const double heart = square(p.x() * (1.0 / 56.0)) + square((p.y() - 38.0) * (1.0 / 52.0)) +
                       square((p.z() + 78.0) * (1.0 / 72.0));
  const double spine = square(p.x() * (1.0 / 34.0)) + square((p.y() + 78.0) * (1.0 / 45.0));
  return heart >= 1.0 && spine >= 1.0 &&
         insideSection((p.x() - 18.0) * (1.0 / 118.0), std::abs(p.y() + 8.0) * (1.0 / 98.0),
                       (p.z() + 158.0) * (1.0 / 270.0));
}

/// Height above the oblique fissure but for its constant; lower lobe below.
double aboveOblique(const Vec3& p) { return p.z() + 1.15 * p.y() + 0.0009 * square(p.y()); }

/// Height above the horizontal fissure but for its constant; middle lobe below.
double aboveHorizontal(const Vec3& p) {
  return p.z() - 0.06 * p.y() + 0.0005 * square(p.x() - 80.0);
}

struct Shape {
  double scale = 1.0;
  double oblique = 0.0;     // constant of the oblique fissure
  double horizontal = 0.0;  // constant of the horizontal fissure

  /// The lobe on whose side of the fissures a point lies, in the lung or not.
  Lobe lobeBySide(const Vec3& model) const {
    if (aboveOblique(model) < oblique) return Lobe::RightLower;
    return aboveHorizontal(model) < horizontal ? Lobe::RightMiddle : Lobe::RightUpper;
  }

  Box3 bounds() const {
    const Vec3 low = lpsFromModel(scale * Vec3(136.0, 90.0, -158.0));
    const Vec3 high = lpsFromModel(scale * Vec3(18.0, -106.0, 112.0));
    return {low, high};
  }
};

class LobeOfRightLung : public Domain {
 public:
  LobeOfRightLung(const Shape& shape, Lobe lobe, double volumeMm3)
      : shape_(shape), inverseScale_(1.0 / shape.scale), lobe_(lobe), volumeMm3_(volumeMm3) {}

  bool contains(const Vec3& p) const override {
    const Vec3 model = modelFromLps(p);
    return shape_.lobeBySide(model) == lobe_ && insideLung(model * inverseScale_);
  }

  // The formulas give no distance; the grid around this domain gives a lower bound.
  double distanceToWall(const Vec3&) const override { return 0.0; }

  Box3 bounds() const override { return shape_.bounds(); }

  double volumeMm3() const override { return volumeMm3_; }

 private:
  Shape shape_;
  double inverseScale_;
  Lobe lobe_;
  double volumeMm3_;
};

/// Calls `f(p)` for the nodes of a lattice of `stepMm` in the lung; model frame.
template <class F>
void forEachNode(double scale, double stepMm, F&& f) {
  for (double x = 0.37 * stepMm; x < 137.0 * scale; x += stepMm)
    for (double y = -107.0 * scale + 0.29 * stepMm; y < 91.0 * scale; y += stepMm)
      for (double z = -158.0 * scale + 0.43 * stepMm; z < 112.0 * scale; z += stepMm) {
        const Vec3 p(x, y, z);
        if (insideLung(p / scale)) f(p);
      }
}

/// The value below which `fraction` of `values` lie.
double quantile(std::vector<double>& values, double fraction) {
  const auto nth = values.begin() + static_cast<std::ptrdiff_t>(
                                        std::min(fraction * static_cast<double>(values.size()),
                                                 static_cast<double>(values.size()) - 1.0));
  std::nth_element(values.begin(), nth, values.end());
  return *nth;
}

/// `v` brought to within `limitRad` of the unit vector `reference`, unit length.
Vec3 turnedTowards(const Vec3& reference, const Vec3& v, double limitRad) {
  const double angle = angleBetween(reference, v);
  if (angle <= limitRad) return v.normalized();
  return rotated(reference, reference.cross(v).normalized(), limitRad);
}

/// Lengths are Huang's, directions ours (the paper gives none); frame of the model.
AirwayTree initialAirways(const std::array<Vec3, 3>& centroids, const Vec3& belowUpper) {
  AirwayTree tree;
  const auto add = [&](int parent, const Vec3& from, const Vec3& to, int generation, Lobe lobe) {
    Branch branch;
    branch.parent = parent;
    branch.proximal = lpsFromModel(from);
    branch.distal = lpsFromModel(to);
    branch.radiusMm = weibelDiameterMm(generation) / 2.0;
    branch.lobe = lobe;
    branch.origin = Origin::Template;
    return tree.add(branch);
  };
  const Vec3 carina = Vec3::Zero();
  const int trachea = add(-1, {0.0, 0.0, 142.0}, carina, 0, Lobe::Central);
  const Vec3 mainDirection =
      Vec3(std::sin(radians(30.0)), -0.15, -std::cos(radians(30.0))).normalized();
  const Vec3 mainEnd = 24.4 * mainDirection;
  const int rightMain = add(trachea, carina, mainEnd, 1, Lobe::Central);
  const Vec3 upper = mainEnd + 16.9 * (centroids[0] - mainEnd).normalized();
  add(rightMain, mainEnd, upper, 2, Lobe::RightUpper);
  const Vec3 intermediateDirection =
      turnedTowards(mainDirection, belowUpper - mainEnd, radians(20.0));
  const Vec3 intermediateEnd = mainEnd + 29.8 * intermediateDirection;
  const int intermediate = add(rightMain, mainEnd, intermediateEnd, 2, Lobe::Central);
  const std::array<double, 2> lengths = {18.0, 26.7};
  const std::array<Lobe, 2> lobes = {Lobe::RightMiddle, Lobe::RightLower};
  for (std::size_t i = 0; i < 2; ++i) {
    const Vec3 direction =
        turnedTowards(intermediateDirection, centroids[i + 1] - intermediateEnd, radians(60.0));
    add(intermediate, intermediateEnd, intermediateEnd + lengths[i] * direction, 3, lobes[i]);
  }
  return tree;
}

}  // namespace

RightLung rightLung(double volumeMl, double upperFraction, double middleFraction) {
  if (!(volumeMl >= 100.0 && volumeMl <= 20000.0)) {
    throw InvalidInput("a right lung of " + std::to_string(volumeMl) +
                       " ml is not possible; choose 100 to 20000 ml");
  }
  if (!(upperFraction > 0.0 && middleFraction > 0.0 && upperFraction + middleFraction < 1.0)) {
    throw InvalidInput(
        "the fractions of the upper and the middle lobe must be positive and leave "
        "something for the lower lobe");
  }
  Shape shape;
  shape.scale = std::cbrt(volumeMl / UnitVolumeMl);
  const double step = std::cbrt(cubicMillimetres(volumeMl) / 1.0e5);

  std::vector<double> heights;
  forEachNode(shape.scale, step, [&](const Vec3& p) { heights.push_back(aboveOblique(p)); });
  shape.oblique = quantile(heights, 1.0 - upperFraction - middleFraction);
  heights.clear();
  forEachNode(shape.scale, step, [&](const Vec3& p) {
    if (aboveOblique(p) >= shape.oblique) heights.push_back(aboveHorizontal(p));
  });
  shape.horizontal = quantile(heights, middleFraction / (upperFraction + middleFraction));

  constexpr std::array<Lobe, 3> lobes = {Lobe::RightUpper, Lobe::RightMiddle, Lobe::RightLower};
  std::array<Vec3, 3> sums = {Vec3::Zero(), Vec3::Zero(), Vec3::Zero()};
  std::array<double, 3> counts = {};
  forEachNode(shape.scale, step, [&](const Vec3& p) {
    const auto i = static_cast<std::size_t>(shape.lobeBySide(p)) - 1;
    sums[i] += p;
    counts[i] += 1.0;
  });
  const double all = counts[0] + counts[1] + counts[2];
  RightLung lung;
  for (std::size_t i = 0; i < lobes.size(); ++i) {
    const double volume = cubicMillimetres(volumeMl) * counts[i] / all;
    lung.lobes.push_back(
        {lobes[i], std::make_shared<GridDomain>(
                       std::make_shared<LobeOfRightLung>(shape, lobes[i], volume), GridCellMm)});
  }
  const Vec3 belowUpper = (sums[1] + sums[2]) / (counts[1] + counts[2]);
  lung.central =
      initialAirways({sums[0] / counts[0], sums[1] / counts[1], sums[2] / counts[2]}, belowUpper);
  return lung;
}

}  // namespace pneuma
