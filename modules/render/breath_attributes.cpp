#include "render/breath_attributes.h"

#include <algorithm>
#include <array>

#include "render/convert.h"

namespace pneuma {
namespace {

/// Displacement of the place on a branch's centreline that is nearest to a point.
Vec3 displacementAt(const Branch& branch, const std::array<Vec3, 2>& ofEnds,
                    const std::vector<Vec3>& ofVia, const Vec3& p) {
  Vec3 found = ofEnds[0];
  double least = (p - branch.proximal).squaredNorm();
  Vec3 from = branch.proximal;
  Vec3 ofFrom = ofEnds[0];
  for (std::size_t n = 0; n <= branch.via.size(); ++n) {
    const bool last = n == branch.via.size();
    const Vec3& to = last ? branch.distal : branch.via[n].position;
    const Vec3& ofTo = last ? ofEnds[1] : ofVia[n];
    const Vec3 step = to - from;
    const double length = step.squaredNorm();
    const double share = length > 0.0 ? std::clamp((p - from).dot(step) / length, 0.0, 1.0) : 0.0;
    const double distance = (p - from - share * step).squaredNorm();
    if (distance < least) {
      least = distance;
      found = (1.0 - share) * ofFrom + share * ofTo;
    }
    from = to;
    ofFrom = ofTo;
  }
  return found;
}

}  // namespace

BreathAttributes breathAttributes(const TriangleMesh& mesh, std::span<const Vec3> displacement,
                                  Side side) {
  const std::vector<Vec3> normals = areaVectors(mesh);
  std::vector<Vec3> slopes(mesh.points.size(), Vec3::Zero());
  for (const auto& triangle : mesh.triangles) {
    const auto& [a, b, c] = triangle;
    const Vec3 e = mesh.points[b] - mesh.points[a];
    const Vec3 f = mesh.points[c] - mesh.points[a];
    const Vec3 ofE = displacement[b] - displacement[a];
    const Vec3 ofF = displacement[c] - displacement[a];
    for (const std::uint32_t n : triangle) slopes[n] += ofE.cross(f) + e.cross(ofF);
  }
  BreathAttributes attributes;
  attributes.normals.reserve(3 * mesh.points.size());
  attributes.displacement.reserve(4 * mesh.points.size());
  attributes.normalSlope.reserve(3 * mesh.points.size());
  for (std::size_t n = 0; n < mesh.points.size(); ++n) {
    const double length = normals[n].norm();
    for (int axis = 0; axis < 3; ++axis) {
      attributes.normals.push_back(length > 0.0 ? static_cast<float>(normals[n][axis] / length)
                                                : 0.0F);
      attributes.displacement.push_back(static_cast<float>(displacement[n][axis]));
      attributes.normalSlope.push_back(length > 0.0 ? static_cast<float>(slopes[n][axis] / length)
                                                    : 0.0F);
    }
    attributes.displacement.push_back(side == Side::Left ? 1.0F : 0.0F);
  }
  return attributes;
}

BreathAttributes breathAttributes(const AirwayTree& tree, const TreeMotion& motion,
                                  std::span<const float> points,
                                  std::span<const std::uint32_t> branches) {
  BreathAttributes attributes;
  attributes.displacement.resize(4 * branches.size());
  attributes.normalSlope.assign(3 * branches.size(), 0.0F);
  for (std::size_t n = 0; n < branches.size(); ++n) {
    const Branch& branch = tree[branches[n]];
    const Vec3 p(points[3 * n], points[3 * n + 1], points[3 * n + 2]);
    const Vec3 u = displacementAt(branch, motion.ends[branches[n]], motion.via[branches[n]], p);
    for (int axis = 0; axis < 3; ++axis) {
      attributes.displacement[4 * n + static_cast<std::size_t>(axis)] = static_cast<float>(u[axis]);
    }
    attributes.displacement[4 * n + 3] = side(branch.lobe) == Side::Left ? 1.0F : 0.0F;
  }
  return attributes;
}

}  // namespace pneuma
