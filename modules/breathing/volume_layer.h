#pragma once

#include <memory>
#include <span>
#include <vector>

#include "core/triangle_mesh.h"

namespace pneuma {

/// A field of displacements at one place.
struct FieldAt {
  Vec3 value = Vec3::Zero();                           ///< mm
  Eigen::Matrix3d gradient = Eigen::Matrix3d::Zero();  ///< row: part of the value
};

/// A thin layer below a lung's surface that takes up what a displacement field lacks in volume:
/// u + a N exp(-d / 15 mm), N the smoothed normal of the nearest surface, d the distance to it. To
/// scale the whole field instead would move the inside too far, which expands less than the lung.
class VolumeLayer {
 public:
  /// @param surface closed, oriented outwards
  explicit VolumeLayer(const TriangleMesh& surface);
  ~VolumeLayer();
  VolumeLayer(VolumeLayer&&) noexcept;
  VolumeLayer& operator=(VolumeLayer&&) noexcept;

  /// Smoothed unit normals of the surface's points.
  const std::vector<Vec3>& normals() const;

  /// How thick the layer has to become for the surface, moved by `displacement`, to enclose a
  /// volume: a, mm.
  /// @throws InvalidInput if it would turn the lung's outer 15 mm inside out, |a| > 10 mm
  double thicknessFor(std::span<const Vec3> displacement, double wantedMm3) const;

  /// N exp(-d / 15 mm) at any point; N at the surface's own points. Queries may run on several
  /// threads.
  Vec3 at(const Vec3& p) const;

  /// The same and how it changes from place to place, as though the wall were as smooth as its
  /// normals are: with S what they change by along the wall, S (I - d S)^-1 at the depth d.
  /// Outside, where the layer fades as well, it is told to rise towards the wall as it does inside.
  FieldAt withGradientAt(const Vec3& p) const;

 private:
  struct Surface;
  std::unique_ptr<Surface> surface_;
};

}  // namespace pneuma
