#pragma once

#include <map>
#include <span>
#include <utility>
#include <vector>

#include "anatomy/fissure.h"
#include "core/random.h"
#include "core/triangle_mesh.h"

namespace pneuma {

/// Where lobes touch: the true fissure between them, as places and the area each stands for.
struct FissureContact {
  std::vector<Vec3> points;      ///< midpoints of triangles of the lower lobe, and of the gap there
  std::vector<double> areasMm2;  ///< of those triangles
  double areaMm2 = 0.0;
  double gapMeanMm = 0.0;  ///< distance of the neighbour, mean by area; 0 if triangles are shared
  double gapLargestMm = 0.0;  ///< largest; more than 5 mm apart is no contact
  bool shared = false;        ///< the lobes have the same triangles there
};

/// The lobes on both sides of a fissure, below and above; the right oblique one lies between the
/// lower lobe and both others.
std::vector<std::pair<Lobe, Lobe>> lobesBeside(Fissure fissure);

/// Where two closed surfaces, oriented outwards, touch. Triangles that both have, bit by bit, are
/// the contact; where there are none or few, triangles of the first whose middle is within 5 mm of
/// the second, the surfaces facing each other there. Empty if they do not touch.
FissureContact contactBetween(const TriangleMesh& below, const TriangleMesh& above);

/// Two lobes beside a fissure, and where they touch.
struct LobePair {
  Lobe below = Lobe::Whole;
  Lobe above = Lobe::Whole;
  FissureContact contact;
};

/// Those of lobesBeside(); none if a lobe is missing.
std::vector<LobePair> pairsBeside(Fissure fissure, const std::map<Lobe, TriangleMesh>& lobes);

/// Contacts beside one fissure as one.
FissureContact joined(std::span<const LobePair> pairs);

/// The true fissure of lobes that touch.
/// @return nothing upon it if a lobe beside the fissure is missing
FissureContact fissureContact(Fissure fissure, const std::map<Lobe, TriangleMesh>& lobes);

/// `n` places spread over a contact: first the one farthest from its middle, then each time the one
/// farthest from all before. The same for the same contact.
/// @throws InvalidInput if the contact has fewer
std::vector<Vec3> farthestPoints(const FissureContact& contact, std::size_t n);

/// `n` random places spread over a contact: each the one of twelve drawn by area that is farthest
/// from those before (Mitchell 1991, best candidate).
/// @throws InvalidInput if the contact has fewer
std::vector<Vec3> spreadPoints(const FissureContact& contact, std::size_t n, Random& random);

/// Points as a hand would set them: normal deviations of this size along each axis.
std::vector<Vec3> withNoise(std::span<const Vec3> points, double noiseMm, Random& random);

}  // namespace pneuma
