#pragma once

#include <map>
#include <span>

#include "anatomy/landmark_pair.h"
#include "breathing/published_form.h"
#include "breathing/surface_reading.h"
#include "core/image.h"

namespace pneuma {

/// How much a lung widens between the two places of its landmarks.
struct StrainedLung {
  LungFrame frame;      ///< of the lung at rest
  double strain = 0.0;  ///< the cube root of its volumes' ratio less 1
};

using StrainedLungs = std::map<Side, StrainedLung>;

/// A field linear in the shares of the lung's box, u_k = strain L_k sum_j slopes(k, j) q_j, nine
/// constants for both lungs.
struct LinearForm {
  Mat3 slopes = 0.7 * Mat3::Identity();

  /// LPS, mm.
  Vec3 at(const StrainedLung& lung, const Vec3& p) const;
};

struct LinearFit {
  LinearForm form;
  Vec3 shift = Vec3::Zero();  ///< of the person between the scans, LPS, mm; no motion of the lung
};

/// The nine constants of a person by ridge least squares, drawn weakly to 0.7 on the diagonal, and
/// a shift of both lungs.
/// @throws InvalidInput if there are fewer than 12 landmarks, a number in them is not finite, or a
/// landmark lies in no lung of `lungs`
LinearFit fitLinearForm(std::span<const LandmarkPair> landmarks, const StrainedLungs& lungs);

struct PublishedFit {
  PublishedForm form;
  Vec3 shift = Vec3::Zero();
};

/// The published form's nine constants: weights and powers by Levenberg and Marquardt's method from
/// two starts, for each of their values the force's constants and the shift by linear least
/// squares. Powers lie in 0.05 to 5, weights in exp(-4) to exp(4). Single constants are hardly
/// determined; only the field counts.
/// @param surfaces of the same lungs, a hint of a tenth of the landmarks' weight; may be empty
/// @throws as fitLinearForm()
PublishedFit fitPublishedForm(std::span<const LandmarkPair> landmarks, const StrainedLungs& lungs,
                              std::span<const SurfaceReading> surfaces = {});

}  // namespace pneuma
