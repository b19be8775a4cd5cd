#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "anatomy/airway_tree.h"
#include "core/random.h"
#include "core/triangle_mesh.h"

/// What the tests of files write and read.
namespace pneuma::testing {

/// A measured trachea and main bronchi with points between their ends, a template bronchus, grown
/// branches below, one of them a one-daughter step. Numbers need all digits.
inline AirwayTree sampleTree() {
  Random random(7);
  const auto step = [&random] {
    return Vec3(random.uniform(-9, 9), random.uniform(-9, 9), random.uniform(-30, -10));
  };
  AirwayTree tree;
  const auto add = [&](int parent, double radiusMm, Lobe lobe, Origin origin, int viaCount) {
    Branch branch;
    branch.parent = parent;
    branch.proximal =
        parent < 0 ? Vec3(1.0 / 3.0, -186.25, 1e-7) : tree[static_cast<std::size_t>(parent)].distal;
    Vec3 end = branch.proximal;
    for (int i = 0; i < viaCount; ++i) {
      end += step();
      branch.via.push_back({end, radiusMm * random.uniform(0.8, 1.2)});
    }
    branch.distal = end + step();
    branch.radiusMm = radiusMm;
    branch.lobe = lobe;
    branch.segment = static_cast<std::uint8_t>(parent < 2 ? 0 : parent % 11);
    branch.origin = origin;
    branch.ending = origin == Origin::Grown ? static_cast<Ending>(tree.size() % 4) : Ending::None;
    branch.suppliedMl = origin == Origin::Grown ? random.uniform(0.1, 0.2) : 0.0;
    return tree.add(branch);
  };
  const int trachea = add(-1, 8.1, Lobe::Central, Origin::Measured, 4);
  const int right = add(trachea, 6.0 + 1e-13, Lobe::Central, Origin::Measured, 3);
  const int left = add(trachea, 5.5, Lobe::Central, Origin::Measured, 0);
  const int upper = add(left, 4.1, Lobe::LeftUpper, Origin::Template, 0);
  const int lower = add(left, 4.3, Lobe::LeftLower, Origin::Template, 1);
  const int single = add(upper, 3.1, Lobe::LeftUpper, Origin::Grown, 0);
  for (const int parent : {right, single, lower}) {
    add(parent, 1.0 / 3.0, Lobe::LeftUpper, Origin::Grown, 0);
    add(parent, 0.7, Lobe::RightMiddle, Origin::Grown, 0);
  }
  return tree;
}

/// A ball of 20 * 4^n triangles would do as well; this has corners that floats cannot hold.
inline TriangleMesh sampleSurface() {
  TriangleMesh mesh;
  mesh.points = {{0.1, 0, 0}, {30.2, 0, 0}, {0, 40.3, 0}, {0, 0, 50.4}};
  mesh.triangles = {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {0, 3, 2}};
  return mesh;
}

}  // namespace pneuma::testing
