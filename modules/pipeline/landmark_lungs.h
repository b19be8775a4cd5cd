#pragma once

#include <cstdint>
#include <map>
#include <span>
#include <vector>

#include "anatomy/landmark_pair.h"
#include "core/triangle_mesh.h"

namespace pneuma {

/// Says of each landmark which lung it lies in or next to, by the nearest wall.
/// @throws InvalidInput if one lies 20 mm or more outside of all lungs' boxes: not the same frame
void tellSidesByWalls(std::span<LandmarkPair> landmarks, const std::map<Side, TriangleMesh>& walls);

/// The same without lungs: both are parted by the largest gap along x.
void tellSidesByGap(std::span<LandmarkPair> landmarks);

/// Boxes of the places at rest of each lung.
std::map<Side, Box3> boxesOf(std::span<const LandmarkPair> landmarks);

/// How much a lung widens between the places of its landmarks: the cube root of the volumes' ratio
/// of the affine map that fits them best, less 1. It is that of the lung's inside, 0.75 of the
/// lung's in people with COPD who breathed in deeply.
double innerStrain(std::span<const LandmarkPair> landmarks, Side side);

inline constexpr double InnerShareOfStrain = 0.75;

/// Landmarks to fit constants to, and others to test them.
struct LandmarkSplit {
  std::vector<LandmarkPair> fitted;
  std::vector<LandmarkPair> heldOut;
};

/// @param fitted how many landmarks are drawn to be fitted, at most all
LandmarkSplit drawnLandmarks(std::vector<LandmarkPair> landmarks, std::size_t fitted,
                             std::uint64_t seed);

/// Holds out every n-th landmark, in the order given. @pre every > 0
LandmarkSplit everyNthHeldOut(std::span<const LandmarkPair> landmarks, std::size_t every);

}  // namespace pneuma
