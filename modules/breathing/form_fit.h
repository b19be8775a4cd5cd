#pragma once

#include <span>
#include <vector>

#include "breathing/motion_fit.h"
#include "breathing/motion_form.h"
#include "breathing/wall_reading.h"

namespace pneuma {

struct FormFitOptions {
  FormKind kind = FormKind::Deep;
  double ridge = WeakRidge;    ///< pull of evenForm() on polynomials; see fitPolynomialForm()
  double surfaceWeight = 0.1;  ///< of all surfaces together, by that of all landmarks
};

/// Constants of a person.
struct FormFit {
  FormKind kind = FormKind::Deep;
  MotionForm form;
  Vec3 shift = Vec3::Zero();  ///< of the person between the scans, LPS, mm; no motion of the lung
  /// Of constantsOf(form, kind), by the landmarks alone and as if these were independent of each
  /// other, which neighbours are not: rather too small. Infinite where landmarks say nothing.
  std::vector<double> standardErrors;
};

/// The constants of a form from landmarks, and from walls at later volumes as a weak hint. Without
/// walls: fitPolynomialForm() or fitPublishedForm(). With them: from there on ten times points of
/// the walls are paired with the later surfaces, and all constants and the shift found by Levenberg
/// and Marquardt's method with these pairs.
/// @param walls of lungs of `lungs` at one or more volumes, each with a strain of its own; the
/// shift is taken for that of all of them
/// @throws as fitPolynomialForm()
FormFit fitForm(std::span<const LandmarkPair> landmarks, const StrainedLungs& lungs,
                std::span<const WallReading> walls, const FormFitOptions& options);

/// Where a landmark goes by a form, without the shift, LPS, mm.
Vec3 displacementBy(const MotionForm& form, const StrainedLungs& lungs, const LandmarkPair& pair);

}  // namespace pneuma
