#pragma once

#include <array>
#include <map>
#include <optional>
#include <vector>

#include "pipeline/split_lobes.h"

namespace pneuma {

/// By what a fissure is given in the window.
enum class FissureMethod { Points, Plane };

/// One fissure as it was edited. What was done by the other method is kept.
struct FissureEdit {
  FissureMethod method = FissureMethod::Points;
  std::vector<Vec3> points;                    ///< LPS, mm
  std::optional<std::array<Vec3, 3>> handles;  ///< the plane goes through them

  bool operator==(const FissureEdit&) const = default;
};

/// What the lobes are to be made with, as it was edited.
struct LobeEdits {
  std::map<Fissure, FissureEdit> fissures;
  LobeOptions options;
  std::map<Side, LobeShares> shares;

  bool operator==(const LobeEdits&) const = default;
};

/// With fewer points a fissure is not given, and the proposal stays.
inline constexpr std::size_t LeastFissurePoints = 3;

/// Points of the method that is chosen: the handles of a plane, or those that were set.
std::vector<Vec3> marksOf(const FissureEdit& edit);

/// The plane through three points. @throws InvalidInput if they lie on one line
FissurePlane planeThrough(const std::array<Vec3, 3>& handles);

/// What splits the lungs. @throws as planeThrough()
LobeInputs inputsOf(const LobeEdits& edits);

}  // namespace pneuma
