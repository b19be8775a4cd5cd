#pragma once

#include "breathing/lung_frame.h"
#include "breathing/motion_preset.h"

namespace pneuma {

/// Displacement as Santhanam 2008 writes it, u = amplitude f(q) d(q) / |d(q)| with the shares q of
/// the lung's box:
///   d_k = weights_k q_k ^ powers_k            (15) to (17), c1 .. c6
///   f = constant + slopes . q                 (18), c7 .. c9, and a constant besides
/// Only the weights' ratios matter; that of Z is 1. Nine constants are left. The paper's own table
/// of constants is not in reach.
struct PublishedForm {
  Vec3 weights = Vec3::Ones();
  Vec3 powers = Vec3::Ones();
  double constant = 0.0;
  Vec3 slopes = Vec3::Zero();

  bool operator==(const PublishedForm&) const = default;

  /// d along X, Y, Z of the lung's frame.
  Vec3 way(const Vec3& share) const;

  /// d / |d| along X, Y, Z of the lung's frame; 0 where d is.
  Vec3 direction(const Vec3& share) const;

  /// f. It may be below 0 near apex and heart: people's lungs ask for it.
  double force(const Vec3& share) const { return constant + slopes.dot(share); }
};

/// Fitted to the same people as PresetField.
const PublishedForm& publishedForm(MotionPreset preset);

/// What one would choose from the paper's words for a person on the back: motion mostly towards the
/// base, force growing away from the table. Worse than no motion on people's lungs; kept to show
/// that.
const PublishedForm& reasonedForm();

/// The published form in a lung. Its volume comes out about right only, or not at all.
class PublishedField {
 public:
  static constexpr double AmplitudeMm = 200.0;  ///< at a strain of 1

  /// @param strain of the lung: the cube root of its volumes' ratio less 1
  PublishedField(const PublishedForm& form, const LungFrame& frame, double strain)
      : form_(form), frame_(frame), strain_(strain) {}

  /// LPS, mm. Shares outside of the box are those of its wall.
  Vec3 at(const Vec3& p) const;

  /// How the field changes from place to place; a row for each part of the displacement. A share
  /// that is held at the box's wall does not change.
  Mat3 gradientAt(const Vec3& p) const;

 private:
  PublishedForm form_;
  LungFrame frame_;
  double strain_;
};

}  // namespace pneuma
