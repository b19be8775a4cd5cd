#pragma once

#include "geometry/test_surfaces.h"

namespace pneuma {

/// An egg of a lung's size, its apex up.
inline TriangleMesh eggLung() {
  TriangleMesh mesh = testing::sphere(1.0, Vec3::Zero(), 5);
  for (Vec3& p : mesh.points) {
    p = p.cwiseProduct(Vec3(55.0, 80.0, 115.0)) * (1.0 - 0.15 * p.z());
  }
  return mesh;
}

}  // namespace pneuma
