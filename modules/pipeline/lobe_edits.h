#pragma once

#include <array>
#include <map>
#include <memory>
#include <optional>
#include <string_view>
#include <vector>

#include "pipeline/lung_shape.h"
#include "pipeline/split_lobes.h"

namespace pneuma {

/// By what a fissure is given in the window.
enum class FissureMethod { Points, Plane, Surface };

constexpr auto choices(FissureMethod) {
  return std::array<std::string_view, 3>{"points", "plane", "surface"};
}

/// One fissure as it was edited. What was done by the other method is kept.
struct FissureEdit {
  FissureMethod method = FissureMethod::Points;
  std::vector<Vec3> points;                    ///< LPS, mm
  std::vector<double> weights;                 ///< of the points
  std::optional<std::array<Vec3, 3>> handles;  ///< the plane goes through them
  std::shared_ptr<const GivenFissure> read;    ///< a surface or an equation from a file

  bool operator==(const FissureEdit&) const = default;
};

/// What the lobes are to be made with, as it was edited.
struct LobeEdits {
  std::map<Fissure, FissureEdit> fissures;
  LobeOptions options;
  std::map<Side, LobeShares> shares;
  bool snap = false;  ///< to what shows in the CT

  bool operator==(const LobeEdits&) const = default;
};

/// That somebody looked at a fissure as it was then.
struct FissureReview {
  LobeEdits edits;       ///< what was looked at
  bool skipped = false;  ///< accepted without looking at its stations

  bool operator==(const FissureReview&) const = default;
};

/// With fewer points a fissure is not given, and the proposal stays.
inline constexpr std::size_t LeastFissurePoints = 3;

/// Points of the method that is chosen: the handles of a plane, or those that were set.
std::vector<Vec3> marksOf(const FissureEdit& edit);

/// What the edits say of one fissure alone.
LobeEdits concerning(const LobeEdits& edits, Fissure fissure);

/// A point is as important as others.
inline constexpr double UsualWeight = 1.0;

/// The plane through three points. @throws InvalidInput if they lie on one line
FissurePlane planeThrough(const std::array<Vec3, 3>& handles);

/// Three points of a plane, a third of a circle from one another.
/// @param u, v across its normal, of length 1
std::array<Vec3, 3> handlesAround(const Vec3& centre, const Vec3& u, const Vec3& v,
                                  double radiusMm);

/// How a plane lies, see planeNormal().
struct PlaneAngles {
  double tiltDeg = 0.0;
  double turnDeg = 0.0;
};

/// @throws as planeThrough()
PlaneAngles anglesOf(const std::array<Vec3, 3>& handles);

/// The handles turned about their middle so that the plane lies so. @throws as planeThrough()
std::array<Vec3, 3> turnedTo(const PlaneAngles& angles, const std::array<Vec3, 3>& handles);

/// What is given of the fissures, as files have it: points that are too few to be used, too.
/// @throws as planeThrough()
GivenFissures givenOf(const LobeEdits& edits);

/// The fissures of a file as edits; the others are proposed again.
/// @param lungs for the handles of planes
std::map<Fissure, FissureEdit> editsOf(const GivenFissures& given,
                                       const std::vector<std::shared_ptr<const LungShape>>& lungs);

/// What splits the lungs. @throws as planeThrough()
LobeInputs inputsOf(const LobeEdits& edits);

}  // namespace pneuma
