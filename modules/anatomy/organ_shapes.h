#pragma once

#include <cstdint>

#include "core/domain.h"

/// Organs of simple shape to grow in. LPS, mm; the top is the origin, everything else lies below.
namespace pneuma {

/// The organ of Kitaoka 1999 on which the paper's tables are measured: below its apex the section
/// is an ellipse, 3 wide (x) to 2 deep (y), that widens with the fourth root of the depth to
/// 300 x 200 mm at 300 mm, where a plane closes it: depth = 2/15^3 (x^2 + (1.5 y)^2)^2 in cm.
class SimpleOrgan : public Domain {
 public:
  /// 3000 pi ml
  static constexpr double VolumeMl = 9424.777960769379;
  static constexpr double HeightMm = 300.0;

  /// @param scale of all lengths; 1 is the paper's size
  explicit SimpleOrgan(double scale = 1.0);

  bool contains(const Vec3& p) const override;
  bool containsSegment(const Vec3& a, const Vec3& b) const override;
  bool containsBox(const Box3& box) const override;

  /// A lower bound: inside at least two thirds of the distance, but for a few per cent; outside 0.
  double distanceToWall(const Vec3& p) const override;

  std::uint32_t insideAlongX(const Vec3& first, double stepMm, std::uint32_t wanted) const override;
  double exitDistance(const Vec3& p, const Vec3& direction, double farthestMm) const override;
  Box3 bounds() const override;
  double volumeMm3() const override;

  /// The organ takes |x| up to this at (y, z); negative where it takes nothing.
  double halfWidthMm(double y, double z) const;

 private:
  double scale_;
  double inverse_;
};

class SphereOrgan : public Domain {
 public:
  explicit SphereOrgan(double radiusMm) : radius_(radiusMm) {}

  bool contains(const Vec3& p) const override;
  bool containsSegment(const Vec3& a, const Vec3& b) const override;
  bool containsBox(const Box3& box) const override;
  double distanceToWall(const Vec3& p) const override;
  std::uint32_t insideAlongX(const Vec3& first, double stepMm, std::uint32_t wanted) const override;
  double exitDistance(const Vec3& p, const Vec3& direction, double farthestMm) const override;
  Box3 bounds() const override;
  double volumeMm3() const override;

 private:
  Vec3 fromCentre(const Vec3& p) const { return {p.x(), p.y(), p.z() + radius_}; }

  double radius_;
};

/// An upright cylinder.
class CylinderOrgan : public Domain {
 public:
  CylinderOrgan(double radiusMm, double heightMm) : radius_(radiusMm), height_(heightMm) {}

  bool contains(const Vec3& p) const override;
  bool containsSegment(const Vec3& a, const Vec3& b) const override;
  bool containsBox(const Box3& box) const override;
  double distanceToWall(const Vec3& p) const override;
  std::uint32_t insideAlongX(const Vec3& first, double stepMm, std::uint32_t wanted) const override;
  double exitDistance(const Vec3& p, const Vec3& direction, double farthestMm) const override;
  Box3 bounds() const override;
  double volumeMm3() const override;

 private:
  double radius_;
  double height_;
};

/// A cube with sides along the axes.
class CubeOrgan : public Domain {
 public:
  explicit CubeOrgan(double edgeMm) : edge_(edgeMm), box_(cornersOf(edgeMm)) {}

  bool contains(const Vec3& p) const override { return box_.contains(p); }

  bool containsSegment(const Vec3& a, const Vec3& b) const override;
  bool containsBox(const Box3& box) const override;
  double distanceToWall(const Vec3& p) const override;
  std::uint32_t insideAlongX(const Vec3& first, double stepMm, std::uint32_t wanted) const override;
  double exitDistance(const Vec3& p, const Vec3& direction, double farthestMm) const override;

  Box3 bounds() const override { return box_; }

  double volumeMm3() const override { return edge_ * edge_ * edge_; }

 private:
  static Box3 cornersOf(double edgeMm) {
    return {Vec3(-edgeMm / 2.0, -edgeMm / 2.0, -edgeMm), Vec3(edgeMm / 2.0, edgeMm / 2.0, 0.0)};
  }

  double edge_;
  Box3 box_;
};

}  // namespace pneuma
