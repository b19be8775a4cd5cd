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

struct PolynomialFit {
  PolynomialForm form;
  Vec3 shift = Vec3::Zero();  ///< of the person between the scans, LPS, mm; no motion of the lung
};

/// Pull of evenForm() where nothing else is said; a share's variance is about 0.05.
inline constexpr double WeakRidge = 2e-3;

/// The constants of a person by ridge least squares, drawn to evenForm(), and a shift of both
/// lungs.
/// @param terms that the polynomial has: nine, linear, by default
/// @param ridge pull of evenForm() for each landmark, in shares squared; 0: none
/// @throws InvalidInput if there are fewer than 12 landmarks, a number in them is not finite, or a
/// landmark lies in no lung of `lungs`
PolynomialFit fitPolynomialForm(std::span<const LandmarkPair> landmarks, const StrainedLungs& lungs,
                                const TermChoice& terms = termsOf(MotionPreset::Deep),
                                double ridge = WeakRidge);

struct PublishedFit {
  PublishedForm form;
  Vec3 shift = Vec3::Zero();
};

/// The published form's nine constants: weights and powers by Levenberg and Marquardt's method from
/// two starts, for each of their values the force's constants and the shift by linear least
/// squares. Powers lie in 0.05 to 5, weights in exp(-4) to exp(4). Single constants are hardly
/// determined; only the field counts.
/// @param surfaces of the same lungs, a hint of a tenth of the landmarks' weight; may be empty
/// @throws as fitPolynomialForm()
PublishedFit fitPublishedForm(std::span<const LandmarkPair> landmarks, const StrainedLungs& lungs,
                              std::span<const SurfaceReading> surfaces = {});

}  // namespace pneuma
