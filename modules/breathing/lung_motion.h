#pragma once

#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "breathing/motion_form.h"
#include "breathing/radial_field.h"
#include "breathing/surface_motion.h"
#include "breathing/volume_layer.h"
#include "breathing/volume_polynomial.h"

namespace pneuma {

/// What a lung's field of displacements is made of.
struct LungMotionOptions {
  MotionPreset preset = MotionPreset::Quiet;  ///< of the model Preset
  MotionModel model = MotionModel::Preset;
  Posture posture = Posture::Supine;  ///< the presets are those of people lying on their back
  double postureShare = 1.0;          ///< of the difference that the preset takes up
  /// Of the wall's points, by that of healthy lung, above 0; empty: healthy.
  std::vector<double> stiffness{};
  /// Of the model Preset: somebody's constants in place of the preset's; null: none.
  std::shared_ptr<const MotionForm> form = nullptr;
};

/// One field of displacements for a whole lung, from the end of expiration on: everything in it,
/// its lobes, fissures and airways, moves to x + s u(x). s = 0 is the lung at rest, s = 1 the
/// largest volume that the field was made for. As all take the same field, lobes that share a point
/// keep it shared and no gap opens. The direction of a point stays the same through a breath; how
/// far it goes is s, and s comes from the enclosed volume exactly.
/// With the model Preset u is the preset's, or that of somebody's own form; in another posture than
/// supine, or with parts that are stiffer or softer than healthy lung, it is
///   u_preset + share (u_elastic(posture, stiffness) - u_elastic(supine, healthy)),
/// the difference found at the wall (SurfaceMotion) and carried on into the lung, so that what was
/// measured stays as it is where it was measured. What lacks in volume is in a layer at the wall.
/// With the other models u is the wall's alone, carried on into the lung and brought to the volume
/// as a whole.
class LungMotion {
 public:
  /// @param wall the closed surface of the whole lung at rest, LPS, mm
  /// @param mostMm3 the largest volume it takes
  /// @throws InvalidInput if the wall is inside out, its box is no lung's (50 to 500 mm), or the
  /// volume cannot be reached
  LungMotion(Side side, const TriangleMesh& wall, const LungMotionOptions& options, double mostMm3);

  /// Supine, by a preset.
  LungMotion(Side side, const TriangleMesh& wall, MotionPreset preset, double mostMm3)
      : LungMotion(side, wall, LungMotionOptions{preset}, mostMm3) {}

  Side side() const { return side_; }

  double restMm3() const { return volume_.a[0]; }

  const TriangleMesh& wall() const { return wall_; }

  /// u of the wall's points, mm.
  std::span<const Vec3> ofWall() const { return ofWall_; }

  /// u of any point in the lung, mm. May be called from several threads.
  Vec3 at(const Vec3& p) const;

  /// u and grad u of any point, by one look for the nearest wall. May be called from several
  /// threads.
  FieldAt withGradientAt(const Vec3& p) const;

  /// The s at which the lung has this volume. @throws InvalidInput outside of minScale() and
  /// maxScale(), naming the volumes that do not fold the lung
  double scaleFor(double volumeMm3) const { return scaleFor(volume_, volumeMm3); }

  /// The same where lobes tell how much the lung encloses: they do so differently from a wall that
  /// was drawn anew around them.
  double scaleFor(const VolumePolynomial& volume, double volumeMm3) const;

  /// So many times as far as it may go, nothing turns over or inside out.
  static constexpr double SafeTimes = 1.5;

  /// The s above and below 0 at which a triangle of the wall would turn over, by SafeTimes.
  double maxScale() const { return maxScale_; }

  double minScale() const { return minScale_; }

  const VolumePolynomial& volume() const { return volume_; }

  double layerMm() const { return thicknessMm_; }

 private:
  /// u without the layer.
  Vec3 fieldAt(const Vec3& p) const;

  Side side_;
  TriangleMesh wall_;
  std::optional<FormField> preset_;      // of the model Preset
  std::optional<VolumeLayer> layer_;     // likewise
  std::optional<RadialField> byForces_;  // in other postures and of other models
  double forceShare_ = 1.0;
  double thicknessMm_ = 0.0;
  std::vector<Vec3> ofWall_;
  VolumePolynomial volume_;
  double maxScale_ = 0.0;
  double minScale_ = 0.0;
};

/// The smallest determinant of I + s grad u at points in a lung, grad u by differences over 1 mm.
/// Above 0 nothing is turned inside out.
double leastDeterminant(const LungMotion& motion, std::span<const Vec3> points, double s);

}  // namespace pneuma
