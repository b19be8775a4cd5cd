#include "pipeline/lobe_edits.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <Eigen/Geometry>

#include "core/units.h"
#include "lobes/fissure_fit.h"

namespace pneuma {

namespace {

constexpr double HandlesShare = 0.3;  ///< of the lung's shortest side: how far out they are

/// Three points of a plane where it passes a lung's middle.
std::array<Vec3, 3> handlesIn(const FissurePlane& plane, const Box3& lung) {
  const Vec3 normal = plane.normal.normalized();
  const Vec3 middle = lung.center() + normal.dot(plane.point - lung.center()) * normal;
  const Vec3 u = normal.unitOrthogonal();
  return handlesAround(middle, u, normal.cross(u), HandlesShare * lung.sizes().minCoeff());
}

}  // namespace

LobeEdits concerning(const LobeEdits& edits, Fissure fissure) {
  LobeEdits one;
  const auto found = edits.fissures.find(fissure);
  if (found != edits.fissures.end()) one.fissures.insert(*found);
  const auto shares = edits.shares.find(side(fissure));
  if (shares != edits.shares.end()) one.shares.insert(*shares);
  one.options = edits.options;
  one.snap = edits.snap;
  return one;
}

std::vector<Vec3> marksOf(const FissureEdit& edit) {
  if (edit.method == FissureMethod::Points) return edit.points;
  if (edit.method != FissureMethod::Plane || !edit.handles) return {};
  return {edit.handles->begin(), edit.handles->end()};
}

FissurePlane planeThrough(const std::array<Vec3, 3>& handles) {
  const BestPlane plane = bestPlane(handles);
  return {plane.centre, plane.axes[2]};
}

std::array<Vec3, 3> handlesAround(const Vec3& centre, const Vec3& u, const Vec3& v,
                                  double radiusMm) {
  std::array<Vec3, 3> handles;
  for (std::size_t i = 0; i < handles.size(); ++i) {
    const double angle =
        2.0 * std::numbers::pi * static_cast<double>(i) / 3.0 + std::numbers::pi / 2.0;
    handles[i] = centre + radiusMm * (std::cos(angle) * u + std::sin(angle) * v);
  }
  return handles;
}

PlaneAngles anglesOf(const std::array<Vec3, 3>& handles) {
  Vec3 normal = planeThrough(handles).normal;
  if (normal.z() < 0.0) normal = -normal;
  return {degrees(std::asin(std::clamp(-normal.y(), -1.0, 1.0))),
          degrees(std::atan2(normal.x(), normal.z()))};
}

std::array<Vec3, 3> turnedTo(const PlaneAngles& angles, const std::array<Vec3, 3>& handles) {
  const FissurePlane plane = planeThrough(handles);
  Vec3 normal = plane.normal;
  if (normal.z() < 0.0) normal = -normal;
  const Vec3 wanted = planeNormal(radians(angles.tiltDeg), radians(angles.turnDeg));
  const Eigen::Quaterniond turn = Eigen::Quaterniond::FromTwoVectors(normal, wanted);
  std::array<Vec3, 3> turned;
  for (std::size_t i = 0; i < turned.size(); ++i) {
    turned[i] = plane.point + turn * (handles[i] - plane.point);
  }
  return turned;
}

GivenFissures givenOf(const LobeEdits& edits) {
  GivenFissures given;
  for (const auto& [fissure, edit] : edits.fissures) {
    if (edit.method == FissureMethod::Plane && edit.handles) {
      given[fissure].plane = planeThrough(*edit.handles);
    } else if (edit.method == FissureMethod::Surface && edit.read) {
      given[fissure] = *edit.read;
    } else if (edit.method == FissureMethod::Points && !edit.points.empty()) {
      given[fissure].points = edit.points;
      const bool same =
          std::ranges::all_of(edit.weights, [](double weight) { return weight == UsualWeight; });
      if (!same) given[fissure].weights = edit.weights;
    }
  }
  return given;
}

std::map<Fissure, FissureEdit> editsOf(const GivenFissures& given,
                                       const std::vector<std::shared_ptr<const LungShape>>& lungs) {
  std::map<Fissure, FissureEdit> edits;
  for (const auto& [fissure, one] : given) {
    FissureEdit& edit = edits[fissure];
    if (one.patch || one.equation) {
      edit.method = FissureMethod::Surface;
      edit.read = std::make_shared<const GivenFissure>(one);
    } else if (one.plane) {
      const auto lung = std::ranges::find_if(
          lungs, [&](const auto& shape) { return shape->side == side(fissure); });
      if (lung == lungs.end()) continue;
      edit.method = FissureMethod::Plane;
      edit.handles = handlesIn(*one.plane, (*lung)->extent.bounds);
    } else {
      edit.points = one.points;
      edit.weights = one.weights;
      edit.weights.resize(edit.points.size(), UsualWeight);
    }
  }
  return edits;
}

LobeInputs inputsOf(const LobeEdits& edits) {
  LobeInputs inputs;
  inputs.shares = edits.shares;
  if (edits.snap) inputs.snap = SnapOptions{};
  inputs.given = givenOf(edits);
  std::erase_if(inputs.given, [](const auto& entry) {
    const GivenFissure& given = entry.second;
    return !given.points.empty() && given.points.size() < LeastFissurePoints;
  });
  return inputs;
}

}  // namespace pneuma
