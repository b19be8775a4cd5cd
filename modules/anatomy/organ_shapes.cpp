#include "anatomy/organ_shapes.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "anatomy/row_bits.h"
#include "core/units.h"

namespace pneuma {
namespace {

// Half axes of the simple organ's base and its height at scale 1, mm.
constexpr double HalfWidth = 150.0;
constexpr double HalfDepth = 100.0;
constexpr double Height = SimpleOrgan::HeightMm;

double square(double v) { return v * v; }

/// Depth below the apex of the simple organ's surface, a distance `u` from the axis along y.
double depthOfSurface(double u) { return Height * square(square(u / HalfDepth)); }

double distanceToSegment(double x, double y, double ax, double ay, double bx, double by) {
  const double along =
      (x - ax) * (bx - ax) + (y - ay) * (by - ay);  // of the segment, times its squared length
  const double squaredLength = square(bx - ax) + square(by - ay);
  const double t = squaredLength > 0.0 ? std::clamp(along / squaredLength, 0.0, 1.0) : 0.0;
  return std::hypot(x - ax - t * (bx - ax), y - ay - t * (by - ay));
}

/// How far a ray starting at `from` goes until it leaves |v| <= half; 0 if it starts outside.
double exitOfSlab(double from, double direction, double low, double high) {
  if (direction > 0.0) return std::max(0.0, (high - from) / direction);
  if (direction < 0.0) return std::max(0.0, (low - from) / direction);
  return std::numeric_limits<double>::infinity();
}

/// The larger root of a t^2 + 2 b t + c for c <= 0, without cancellation; 0 where there is none.
double exitOfQuadric(double a, double b, double c) {
  if (a <= 0.0) return std::numeric_limits<double>::infinity();
  const double root = std::sqrt(std::max(0.0, b * b - a * c));
  return std::max(0.0, b > 0.0 ? -c / (b + root) : (root - b) / a);
}

/// A convex organ holds a box if it holds its corners.
bool containsCorners(const Domain& organ, const Box3& box) {
  for (int corner = 0; corner < 8; ++corner) {
    if (!organ.contains(box.corner(static_cast<Box3::CornerType>(corner)))) return false;
  }
  return true;
}

}  // namespace

SimpleOrgan::SimpleOrgan(double scale) : scale_(scale), inverse_(1.0 / scale) {}

bool SimpleOrgan::contains(const Vec3& p) const {
  const Vec3 q = p * inverse_;
  const double depth = -q.z();
  return depth >= 0.0 && depth <= Height &&
         depth >= Height * square(square(q.x() / HalfWidth) + square(q.y() / HalfDepth));
}

bool SimpleOrgan::containsSegment(const Vec3& a, const Vec3& b) const {
  return contains(a) && contains(b);  // it is convex
}

bool SimpleOrgan::containsBox(const Box3& box) const {
  // Symmetric about its axis planes: the corner farthest from both decides, above and below.
  const Vec3 far = box.min().cwiseAbs().cwiseMax(box.max().cwiseAbs());
  return contains({far.x(), far.y(), box.max().z()}) && contains({far.x(), far.y(), box.min().z()});
}

double SimpleOrgan::distanceToWall(const Vec3& p) const {
  if (!contains(p)) return 0.0;
  const Vec3 q = p * inverse_;
  const double depth = -q.z();
  // (x, y) -> u shortens no distance to more than itself, so that the distance in the half-plane
  // (u, depth) to the curve depth = depthOfSurface(u) is a lower bound. That curve is convex, so
  // that a chain of chords between its points above and beside (u, depth) is one too.
  const double u = HalfDepth * std::hypot(q.x() / HalfWidth, q.y() / HalfDepth);
  const double beside = HalfDepth * std::sqrt(std::sqrt(depth / Height));
  constexpr int Chords = 4;
  double nearest = Height - depth;
  double lastU = u;
  double lastDepth = depthOfSurface(u);
  for (int i = 1; i <= Chords; ++i) {
    const double nextU = u + (beside - u) * i / Chords;
    const double nextDepth = depthOfSurface(nextU);
    nearest = std::min(nearest, distanceToSegment(u, depth, lastU, lastDepth, nextU, nextDepth));
    lastU = nextU;
    lastDepth = nextDepth;
  }
  return nearest * scale_;
}

double SimpleOrgan::halfWidthMm(double y, double z) const {
  const double depth = -z * inverse_;
  if (!(depth >= 0.0 && depth <= Height)) return -1.0;
  return HalfWidth * scale_ *
         halfWidthOf(std::sqrt(depth / Height) - square(y * inverse_ / HalfDepth));
}

std::uint32_t SimpleOrgan::insideAlongX(const Vec3& first, double stepMm,
                                        std::uint32_t wanted) const {
  const double half = halfWidthMm(first.y(), first.z());
  return wanted & RowOfPoints(first.x(), stepMm).bitsWithin(0.0, half);
}

double SimpleOrgan::exitDistance(const Vec3& p, const Vec3& direction, double farthestMm) const {
  constexpr double Across = 500.0;  // no way through the organ at scale 1 is longer
  const Vec3 q = p * inverse_;
  const double x = q.x() / HalfWidth;
  const double y = q.y() / HalfDepth;
  const double dx = direction.x() / HalfWidth;
  const double dy = direction.y() / HalfDepth;
  const double depth = -q.z();
  const double sinking = -direction.z();
  double t = std::min({farthestMm * inverse_, exitOfSlab(depth, sinking, 0.0, Height), Across});
  // depth - Height s^2 with s = (x + t dx)^2 + (y + t dy)^2 is concave in t: from outside, Newton's
  // steps come down on its only crossing and never pass it.
  constexpr int MostSteps = 100;
  constexpr double Precision = 1e-9;
  for (int i = 0; i < MostSteps; ++i) {
    const double s = square(x + t * dx) + square(y + t * dy);
    const double above = depth + t * sinking - Height * s * s;
    if (above >= 0.0) break;
    const double slope = sinking - 4.0 * Height * s * ((x + t * dx) * dx + (y + t * dy) * dy);
    if (!(slope < 0.0)) break;
    const double step = above / slope;
    t = std::max(0.0, t - step);
    if (step < Precision) break;
  }
  return t * scale_;
}

Box3 SimpleOrgan::bounds() const {
  return {scale_ * Vec3(-HalfWidth, -HalfDepth, -Height), scale_ * Vec3(HalfWidth, HalfDepth, 0.0)};
}

double SimpleOrgan::volumeMm3() const {
  return cubicMillimetres(VolumeMl) * scale_ * scale_ * scale_;
}

bool SphereOrgan::contains(const Vec3& p) const {
  return fromCentre(p).squaredNorm() <= square(radius_);
}

bool SphereOrgan::containsSegment(const Vec3& a, const Vec3& b) const {
  return contains(a) && contains(b);
}

bool SphereOrgan::containsBox(const Box3& box) const { return containsCorners(*this, box); }

double SphereOrgan::distanceToWall(const Vec3& p) const {
  return std::abs(fromCentre(p).norm() - radius_);
}

std::uint32_t SphereOrgan::insideAlongX(const Vec3& first, double stepMm,
                                        std::uint32_t wanted) const {
  const Vec3 q = fromCentre(first);
  const double half = halfWidthOf(square(radius_) - square(q.y()) - square(q.z()));
  return wanted & RowOfPoints(first.x(), stepMm).bitsWithin(0.0, half);
}

double SphereOrgan::exitDistance(const Vec3& p, const Vec3& direction, double farthestMm) const {
  const Vec3 q = fromCentre(p);
  return std::min(farthestMm,
                  exitOfQuadric(1.0, q.dot(direction), q.squaredNorm() - square(radius_)));
}

Box3 SphereOrgan::bounds() const {
  return {Vec3(-radius_, -radius_, -2.0 * radius_), Vec3(radius_, radius_, 0.0)};
}

double SphereOrgan::volumeMm3() const {
  return 4.0 / 3.0 * std::numbers::pi * radius_ * radius_ * radius_;
}

bool CylinderOrgan::contains(const Vec3& p) const {
  return p.z() <= 0.0 && p.z() >= -height_ && p.head<2>().squaredNorm() <= square(radius_);
}

bool CylinderOrgan::containsSegment(const Vec3& a, const Vec3& b) const {
  return contains(a) && contains(b);
}

bool CylinderOrgan::containsBox(const Box3& box) const { return containsCorners(*this, box); }

double CylinderOrgan::distanceToWall(const Vec3& p) const {
  const double fromSide = radius_ - p.head<2>().norm();
  const double fromEnds = std::min(-p.z(), p.z() + height_);
  if (fromSide >= 0.0 && fromEnds >= 0.0) return std::min(fromSide, fromEnds);
  return std::hypot(std::min(fromSide, 0.0), std::min(fromEnds, 0.0));
}

std::uint32_t CylinderOrgan::insideAlongX(const Vec3& first, double stepMm,
                                          std::uint32_t wanted) const {
  if (!(first.z() <= 0.0 && first.z() >= -height_)) return 0;
  const double half = halfWidthOf(square(radius_) - square(first.y()));
  return wanted & RowOfPoints(first.x(), stepMm).bitsWithin(0.0, half);
}

double CylinderOrgan::exitDistance(const Vec3& p, const Vec3& direction, double farthestMm) const {
  const auto across = direction.head<2>();
  const double throughSide = exitOfQuadric(across.squaredNorm(), p.head<2>().dot(across),
                                           p.head<2>().squaredNorm() - square(radius_));
  return std::min({farthestMm, throughSide, exitOfSlab(p.z(), direction.z(), -height_, 0.0)});
}

Box3 CylinderOrgan::bounds() const {
  return {Vec3(-radius_, -radius_, -height_), Vec3(radius_, radius_, 0.0)};
}

double CylinderOrgan::volumeMm3() const { return std::numbers::pi * square(radius_) * height_; }

bool CubeOrgan::containsSegment(const Vec3& a, const Vec3& b) const {
  return contains(a) && contains(b);
}

bool CubeOrgan::containsBox(const Box3& box) const { return containsCorners(*this, box); }

double CubeOrgan::distanceToWall(const Vec3& p) const {
  if (!contains(p)) return box_.exteriorDistance(p);
  return std::min((p - box_.min()).minCoeff(), (box_.max() - p).minCoeff());
}

std::uint32_t CubeOrgan::insideAlongX(const Vec3& first, double stepMm,
                                      std::uint32_t wanted) const {
  if (!contains({0.0, first.y(), first.z()})) return 0;
  return wanted & RowOfPoints(first.x(), stepMm).bitsWithin(0.0, edge_ / 2.0);
}

double CubeOrgan::exitDistance(const Vec3& p, const Vec3& direction, double farthestMm) const {
  double t = farthestMm;
  for (int axis = 0; axis < 3; ++axis) {
    t = std::min(t, exitOfSlab(p[axis], direction[axis], box_.min()[axis], box_.max()[axis]));
  }
  return t;
}

}  // namespace pneuma
