#include "anatomy/thorax.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "anatomy/row_bits.h"
#include "core/units.h"

namespace pneuma {
namespace {

// The surfaces at scale 1, mm; depth is measured down from the apex.

/// Half the thickness of the mediastinum between its two sagittal planes.
constexpr double MediastinumHalf = 15.0;

constexpr double Nowhere = std::numeric_limits<double>::infinity();

double square(double v) { return v * v; }

/// The diaphragm, a dome over the abdomen: an elliptic paraboloid that meets the thorax at its rim.
struct Diaphragm {
  static constexpr double TopDepth = 252.2;
  static constexpr double Rise = 47.8;
  static constexpr double HalfWidth = 150.0;
  static constexpr double HalfDepth = 100.0;

  /// How far the dome lies below a point; negative in the abdomen. Convex.
  static double below(const Vec3& q) {
    return TopDepth + Rise * (square(q.x() / HalfWidth) + square(q.y() / HalfDepth)) + q.z();
  }

  static double distance(const Vec3& q) {
    const Vec3 gradient(2.0 * Rise * q.x() / square(HalfWidth),
                        2.0 * Rise * q.y() / square(HalfDepth), 1.0);
    return below(q) / gradient.norm();  // no nearer: `below` is convex
  }

  /// The abdomen takes |x| below this at (y, z); negative where it takes nothing.
  static double halfWidth(double y, double z) {
    return HalfWidth * halfWidthOf((-z - TopDepth) / Rise - square(y / HalfDepth));
  }

  static double entry(const Vec3& q, const Vec3& v) {
    const double a = Rise * (square(v.x() / HalfWidth) + square(v.y() / HalfDepth));
    const double b =  // half of the linear term
        Rise * (q.x() * v.x() / square(HalfWidth) + q.y() * v.y() / square(HalfDepth)) +
        v.z() / 2.0;
    const double c = below(q);
    const double discriminant = b * b - a * c;
    if (b >= 0.0 || discriminant < 0.0) return Nowhere;
    return c / (std::sqrt(discriminant) - b);
  }
};

struct Heart {
  static inline const Vec3 Centre = {18.0, -35.0, -205.0};
  static inline const Vec3 HalfAxes = {55.0, 45.0, 55.0};

  static Vec3 inUnits(const Vec3& q) { return (q - Centre).cwiseQuotient(HalfAxes); }

  static double distance(const Vec3& q) {
    const Vec3 u = inUnits(q);
    const double norm = u.norm();
    // The norm is convex, so that it falls to 1 no nearer than its slope says.
    return (norm - 1.0) * norm / u.cwiseQuotient(HalfAxes).norm();
  }

  static double halfWidth(double y, double z) {
    return HalfAxes.x() * halfWidthOf(1.0 - square((y - Centre.y()) / HalfAxes.y()) -
                                      square((z - Centre.z()) / HalfAxes.z()));
  }

  static double entry(const Vec3& q, const Vec3& v) {
    const Vec3 u = inUnits(q);
    const Vec3 w = v.cwiseQuotient(HalfAxes);
    const double b = u.dot(w);
    const double c = u.squaredNorm() - 1.0;
    const double discriminant = b * b - w.squaredNorm() * c;
    if (b >= 0.0 || discriminant < 0.0) return Nowhere;
    return c / (std::sqrt(discriminant) - b);
  }
};

/// The descending aorta, a vertical cylinder from its top downwards.
struct Aorta {
  static constexpr double X = 22.0;
  static constexpr double Y = 32.0;
  static constexpr double Radius = 12.0;
  static constexpr double TopDepth = 90.0;

  static double aside(const Vec3& q) { return std::hypot(q.x() - X, q.y() - Y) - Radius; }

  static bool contains(const Vec3& q) {
    return q.z() < -TopDepth && square(q.x() - X) + square(q.y() - Y) < square(Radius);
  }

  static double distance(const Vec3& q) {
    return std::hypot(std::max(aside(q), 0.0), std::max(q.z() + TopDepth, 0.0));
  }

  static double halfWidth(double y, double z) {
    return z < -TopDepth ? halfWidthOf(square(Radius) - square(y - Y)) : -1.0;
  }

  static double entry(const Vec3& q, const Vec3& v) {
    const double a = square(v.x()) + square(v.y());
    const double b = (q.x() - X) * v.x() + (q.y() - Y) * v.y();
    const double c = square(q.x() - X) + square(q.y() - Y) - square(Radius);
    const double throughTop = q.z() > -TopDepth && v.z() < 0.0 ? -(q.z() + TopDepth) / v.z()
                              : q.z() <= -TopDepth             ? 0.0
                                                               : Nowhere;
    double from = 0.0;  // of the stretch inside the endless cylinder
    double to = Nowhere;
    if (a > 0.0) {
      const double discriminant = b * b - a * c;
      if (discriminant < 0.0) return Nowhere;
      from = (-b - std::sqrt(discriminant)) / a;
      to = (-b + std::sqrt(discriminant)) / a;
    } else if (c > 0.0) {
      return Nowhere;
    }
    const double entry = std::max({from, throughTop, 0.0});
    const bool below = q.z() + entry * v.z() <= -TopDepth + 1e-9;
    return entry < to && below ? entry : Nowhere;
  }
};

/// The thoracic vertebrae and the ribs beside them: a vertical sinusoidal wall whose ridge is the
/// column and whose troughs are the gutters beside it.
struct Vertebrae {
  static constexpr double HalfWidth = 50.0;
  static constexpr double MeanY = 60.0;
  static constexpr double Amplitude = 35.0;
  static constexpr double WaveNumber = std::numbers::pi / HalfWidth;
  static constexpr double FrontY = MeanY - Amplitude;
  static constexpr double BackY = MeanY + Amplitude;

  /// How far the wall lies behind a point; beside the vertebrae it goes on at the gutters' depth,
  /// where the thorax has ended.
  static double behind(double x, double y) {
    return std::abs(x) < HalfWidth ? MeanY - Amplitude * std::cos(WaveNumber * x) - y : BackY - y;
  }

  static bool contains(const Vec3& q) {
    return std::abs(q.x()) < HalfWidth && q.y() > FrontY && behind(q.x(), q.y()) < 0.0;
  }

  static double distance(const Vec3& q) {
    const double gap = behind(q.x(), q.y());
    // The wall is no steeper than its steepest place within `gap`, and no farther than `gap`.
    const double x = std::abs(q.x());
    const double middle = HalfWidth / 2.0;
    const double steepest = std::clamp(middle, x - gap, std::max(x + gap, x - gap));
    const double slope =
        steepest < HalfWidth ? Amplitude * WaveNumber * std::sin(WaveNumber * steepest) : 0.0;
    const double byWall = gap / std::sqrt(1.0 + slope * slope);
    const double byBox = std::hypot(std::max(x - HalfWidth, 0.0), std::max(FrontY - q.y(), 0.0));
    return std::max(byWall, byBox);
  }

  static double halfWidth(double y) {
    if (y <= FrontY) return 0.0;
    return y >= BackY ? HalfWidth : std::acos((MeanY - y) / Amplitude) / WaveNumber;
  }

  /// How far a way that starts outside goes before it enters, to a micrometre; at most `farthest`.
  static double entry(const Vec3& q, const Vec3& v, double farthest) {
    constexpr double LeastStep = 1e-3;
    const double pace = v.head<2>().norm();  // the wall is vertical
    if (pace * farthest < LeastStep) return farthest;
    double outside = 0.0;
    for (double t = 0.0; t < farthest;) {
      const Vec3 here = q + t * v;
      if (contains(here)) return outside;
      outside = t;
      if (here.y() < FrontY) {  // in front of all of it
        if (v.y() <= 0.0) return farthest;
        t += (FrontY - here.y()) / v.y() + LeastStep;
      } else {
        t += std::max(distance(here), LeastStep) / pace;
      }
    }
    return farthest;
  }
};

double mediastinumEntry(double x, double v) {
  if (x * v >= 0.0) return Nowhere;
  return std::max(0.0, (std::abs(x) - MediastinumHalf) / std::abs(v));
}

}  // namespace

Thorax::Thorax(double scale) : scale_(scale), inverse_(1.0 / scale), contour_(scale) {}

bool Thorax::contains(const Vec3& p) const {
  const Vec3 q = p * inverse_;
  return std::abs(q.x()) >= MediastinumHalf && contour_.contains(p) && Diaphragm::below(q) >= 0.0 &&
         Heart::inUnits(q).squaredNorm() >= 1.0 && !Aorta::contains(q) && !Vertebrae::contains(q);
}

double Thorax::distanceToWall(const Vec3& p) const {
  if (!contains(p)) return 0.0;
  const Vec3 q = p * inverse_;
  const double organs = std::min({std::abs(q.x()) - MediastinumHalf, Diaphragm::distance(q),
                                  Heart::distance(q), Aorta::distance(q), Vertebrae::distance(q)});
  return std::min(scale_ * organs, contour_.distanceToWall(p));
}

std::uint32_t Thorax::insideAlongX(const Vec3& first, double stepMm, std::uint32_t wanted) const {
  const double y = first.y() * inverse_;
  const double z = first.z() * inverse_;
  const RowOfPoints row(first.x() * inverse_, stepMm * inverse_);
  std::uint32_t inside =
      wanted & row.bitsWithin(0.0, contour_.halfWidthMm(first.y(), first.z()) * inverse_);
  if (inside == 0) return 0;
  double middle = MediastinumHalf;
  if (const double wall = Vertebrae::halfWidth(y); wall > middle) middle = wall;
  if (const double dome = Diaphragm::halfWidth(y, z); dome > middle) middle = dome;
  inside &= ~row.bitsWithin(0.0, middle);
  inside &= ~row.bitsWithin(Heart::Centre.x(), Heart::halfWidth(y, z));
  return inside & ~row.bitsWithin(Aorta::X, Aorta::halfWidth(y, z));
}

double Thorax::exitDistance(const Vec3& p, const Vec3& direction, double farthestMm) const {
  const Vec3 q = p * inverse_;
  const double plain =
      std::min({contour_.exitDistance(p, direction, farthestMm) * inverse_,
                mediastinumEntry(q.x(), direction.x()), Diaphragm::entry(q, direction),
                Heart::entry(q, direction), Aorta::entry(q, direction)});
  return std::max(0.0, scale_ * Vertebrae::entry(q, direction, plain));
}

double Thorax::volumeMm3() const { return cubicMillimetres(VolumeMl) * scale_ * scale_ * scale_; }

}  // namespace pneuma
