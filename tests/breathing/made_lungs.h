#pragma once

#include <vector>

#include "anatomy/landmark_pair.h"
#include "breathing/motion_fit.h"
#include "core/random.h"
#include "geometry/test_surfaces.h"

namespace pneuma::testing {

/// An ellipsoid of the size of a lung, 3.1 l, on the right or on the left.
inline TriangleMesh madeLung(Side side, int subdivisions) {
  TriangleMesh mesh = sphere(1.0, Vec3::Zero(), subdivisions);
  const Vec3 centre(side == Side::Right ? -75.0 : 75.0, 10.0, 30.0);
  for (Vec3& p : mesh.points) p = centre + p.cwiseProduct(Vec3(60.0, 95.0, 130.0));
  return mesh;
}

/// Both lungs, which widen as in a deep breath.
inline StrainedLungs madeLungs() {
  StrainedLungs lungs;
  for (const Side side : {Side::Right, Side::Left}) {
    lungs.emplace(side, StrainedLung{{side, bounds(madeLung(side, 4))}, 0.17});
  }
  return lungs;
}

/// Places in both lungs, moved by `field(lung, place)`, a shift and noise.
template <class Field>
std::vector<LandmarkPair> madeLandmarks(std::size_t count, const Field& field, const Vec3& shift,
                                        double noiseMm, std::uint64_t seed) {
  const StrainedLungs lungs = madeLungs();
  Random random(seed);
  std::vector<LandmarkPair> landmarks;
  while (landmarks.size() < count) {
    const Side side = landmarks.size() % 2 == 0 ? Side::Right : Side::Left;
    // One after the other: compilers do not agree in which order arguments are computed.
    Vec3 place;
    for (const int axis : {2, 1, 0}) place[axis] = random.uniform(-1.0, 1.0);
    if (place.norm() > 0.95) continue;
    LandmarkPair pair;
    pair.side = side;
    pair.rest = Vec3(side == Side::Right ? -75.0 : 75.0, 10.0, 30.0) +
                place.cwiseProduct(Vec3(60.0, 95.0, 130.0));
    Vec3 noise;
    for (const int axis : {2, 1, 0}) noise[axis] = random.normal();
    pair.moved = pair.rest + field(lungs.at(side), pair.rest) + shift + noiseMm * noise;
    landmarks.push_back(pair);
  }
  return landmarks;
}

/// The published form as a field for madeLandmarks().
inline auto fieldOf(const PublishedForm& form) {
  return [form](const StrainedLung& lung, const Vec3& p) {
    return PublishedField(form, lung.frame, lung.strain).at(p);
  };
}

}  // namespace pneuma::testing
