#pragma once

#include <array>
#include <memory>
#include <span>
#include <string_view>
#include <vector>

#include "breathing/lung_frame.h"
#include "breathing/posture.h"
#include "breathing/radial_field.h"
#include "core/triangle_mesh.h"

namespace pneuma {

/// What moves a lung: constants that were fitted to landmarks of people, in other postures than
/// supine with what the elastic surface says of the difference; the spring network of Santhanam
/// 2008 with its force law and its directions; or the elastic surface in the network's place.
enum class MotionModel { Preset, Published, Continuous };

constexpr auto choices(MotionModel) {
  return std::array<std::string_view, 3>{"preset", "published", "continuous"};
}

/// The wall of a lung moved by forces: a response to the force law of a posture times the
/// directions there, brought to a volume. Reasoned, not measured: neither the constants of the
/// force nor those of the directions are in print.
class SurfaceMotion {
 public:
  /// @param wall closed, LPS, mm; must outlive this
  /// @param model Published or Continuous
  /// @param stiffness of the wall's points by that of healthy lung, above 0; empty: healthy
  SurfaceMotion(const TriangleMesh& wall, const LungFrame& frame, MotionModel model,
                std::span<const double> stiffness = {});
  ~SurfaceMotion();
  SurfaceMotion(const SurfaceMotion&) = delete;
  SurfaceMotion& operator=(const SurfaceMotion&) = delete;

  /// u of the wall's points, mm: moved by it the wall encloses `wantedMm3`.
  /// @throws InvalidInput if no multiple of it reaches that volume
  std::vector<Vec3> at(Posture posture, double wantedMm3) const;

 private:
  struct Operator;

  const TriangleMesh& wall_;
  LungFrame frame_;
  std::unique_ptr<Operator> operator_;
};

/// `displacement` times what makes the wall enclose `wantedMm3`.
/// @throws InvalidInput if no multiple does
double multipleFor(const TriangleMesh& wall, const std::vector<Vec3>& displacement,
                   double wantedMm3);

/// What is known at a wall's points carried on into the lung, from a thousand of them.
RadialField intoTheLung(const TriangleMesh& wall, const std::vector<Vec3>& displacement);

}  // namespace pneuma
