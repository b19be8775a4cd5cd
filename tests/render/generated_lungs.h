#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <numbers>
#include <vector>

#include "anatomy/segment.h"
#include "render/scene.h"

namespace pneuma::test {

/// A closed ellipsoid, oriented outwards. @param finer so many times as many rows and columns
inline TriangleMesh ellipsoid(const Vec3& centre, const Vec3& semiAxes, std::uint32_t finer = 1) {
  const std::uint32_t rows = 24 * finer;
  const std::uint32_t columns = 36 * finer;
  TriangleMesh mesh;
  const auto add = [&](double polar, double turn) {
    const Vec3 unit(std::sin(polar) * std::cos(turn), std::sin(polar) * std::sin(turn),
                    std::cos(polar));
    mesh.points.push_back(centre + semiAxes.cwiseProduct(unit));
  };
  add(0.0, 0.0);
  for (std::uint32_t row = 1; row < rows; ++row) {
    for (std::uint32_t column = 0; column < columns; ++column) {
      add(std::numbers::pi * row / rows, 2.0 * std::numbers::pi * column / columns);
    }
  }
  add(std::numbers::pi, 0.0);
  const auto at = [columns](std::uint32_t row, std::uint32_t column) {
    return 1 + (row - 1) * columns + column % columns;
  };
  const auto last = static_cast<std::uint32_t>(mesh.points.size() - 1);
  for (std::uint32_t column = 0; column < columns; ++column) {
    mesh.triangles.push_back({0, at(1, column), at(1, column + 1)});
    for (std::uint32_t row = 1; row + 1 < rows; ++row) {
      mesh.triangles.push_back({at(row, column), at(row + 1, column), at(row + 1, column + 1)});
      mesh.triangles.push_back({at(row, column), at(row + 1, column + 1), at(row, column + 1)});
    }
    mesh.triangles.push_back({at(rows - 1, column), last, at(rows - 1, column + 1)});
  }
  return mesh;
}

struct EllipsoidLobe {
  Lobe lobe;
  Vec3 centre;
  Vec3 semiAxes;
};

/// Five ellipsoids placed like lobes, LPS, mm.
inline std::vector<EllipsoidLobe> ellipsoidLobes() {
  return {{Lobe::RightUpper, {-72, -10, 75}, {46, 60, 52}},
          {Lobe::RightMiddle, {-80, -45, 5}, {40, 38, 28}},
          {Lobe::RightLower, {-75, 28, -40}, {50, 52, 62}},
          {Lobe::LeftUpper, {72, -22, 50}, {46, 58, 74}},
          {Lobe::LeftLower, {75, 30, -45}, {46, 50, 60}}};
}

inline std::vector<SceneSurface> generatedLobes() {
  std::vector<SceneSurface> surfaces;
  for (const EllipsoidLobe& lobe : ellipsoidLobes()) {
    surfaces.push_back({lobe.lobe,
                        std::make_shared<const TriangleMesh>(ellipsoid(lobe.centre, lobe.semiAxes)),
                        true});
  }
  return surfaces;
}

/// One of the first two segments of a lobe.
inline std::uint8_t segmentOf(Lobe lobe, bool first) {
  bool found = false;
  for (const Segment& segment : segments()) {
    if (segment.lobe != lobe) continue;
    if (first || found) return segment.number;
    found = true;
  }
  return 0;
}

/// Splits a branch in two, again and again, each time in the plane across the last one.
inline void splitBranch(AirwayTree& tree, int parent, const Vec3& ahead, const Vec3& across,
                        double lengthMm, int depth) {
  if (depth == 0) return;
  const Branch mother = tree[static_cast<std::size_t>(parent)];
  for (const double sign : {1.0, -1.0}) {
    Branch branch;
    branch.parent = parent;
    branch.proximal = mother.distal;
    const Vec3 way = rotated(ahead, across, sign * 0.62);
    branch.distal = branch.proximal + lengthMm * way;
    branch.radiusMm = 0.78 * mother.radiusMm;
    branch.lobe = mother.lobe;
    branch.segment = depth >= 5 ? segmentOf(mother.lobe, sign > 0.0) : mother.segment;
    const int index = tree.add(branch);
    splitBranch(tree, index, way, way.cross(across).normalized(), 0.83 * lengthMm, depth - 1);
  }
}

/// Trachea and main bronchi, the left one along a curved centreline, and a symmetric tree of
/// 2^depth terminals in every lobe.
inline std::shared_ptr<const AirwayTree> generatedTree(int depth = 5) {
  AirwayTree tree;
  const auto add = [&](int parent, const Vec3& from, const Vec3& to, double radius, Lobe lobe) {
    Branch branch;
    branch.parent = parent;
    branch.proximal = from;
    branch.distal = to;
    branch.radiusMm = radius;
    branch.lobe = lobe;
    branch.origin = Origin::Measured;
    return tree.add(branch);
  };
  const Vec3 carina(0, 5, 80);
  const Vec3 rightEnd(-26, 5, 52);
  const Vec3 leftEnd(32, 5, 42);
  const int trachea = add(-1, {0, 5, 150}, carina, 8.5, Lobe::Central);
  const int right = add(trachea, carina, rightEnd, 6.5, Lobe::Central);
  Branch curved;
  curved.parent = trachea;
  curved.proximal = carina;
  curved.distal = leftEnd;
  curved.radiusMm = 5.8;
  curved.lobe = Lobe::Central;
  curved.origin = Origin::Measured;
  curved.via = {{{6, 5, 66}, 6.4}, {{14, 5, 55}, 6.0}, {{23, 5, 47}, 5.5}};
  const int left = tree.add(curved);
  for (const EllipsoidLobe& lobe : ellipsoidLobes()) {
    const bool onRight = side(lobe.lobe) == Side::Right;
    const Vec3 from = onRight ? rightEnd : leftEnd;
    const Vec3 to = from + 0.55 * (lobe.centre - from);
    const int inlet = add(onRight ? right : left, from, to, 4.0, lobe.lobe);
    const Vec3 ahead = (to - from).normalized();
    const double length = 0.36 * lobe.semiAxes.minCoeff();
    splitBranch(tree, inlet, ahead, anyPerpendicular(ahead), length, depth);
  }
  return std::make_shared<const AirwayTree>(std::move(tree));
}

}  // namespace pneuma::test
