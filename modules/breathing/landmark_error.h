#pragma once

#include <span>

#include "anatomy/landmark_pair.h"

namespace pneuma {

/// Distance from where landmarks were predicted to where they are.
struct LandmarkError {
  double meanMm = 0.0;
  double sdMm = 0.0;  ///< over the landmarks; no error of the mean
};

/// The same three ways. Two scans have no common frame for certain; what a shift or a turn of the
/// person takes out is partly breathing, so that no one of the three says all.
struct LandmarkErrors {
  LandmarkError raw;      ///< nothing taken out
  LandmarkError shifted;  ///< best shift taken out, one for both lungs
  LandmarkError rigid;    ///< best turn and shift taken out, one for both lungs
};

/// @param displacement of each landmark, mm
/// @throws InvalidInput if there are fewer than three landmarks, or another number of displacements
LandmarkErrors landmarkErrors(std::span<const LandmarkPair> landmarks,
                              std::span<const Vec3> displacement);

}  // namespace pneuma
