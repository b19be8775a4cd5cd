#pragma once

#include <memory>
#include <vector>

#include "breathing/motion_fit.h"
#include "breathing/motion_form.h"
#include "core/triangle_mesh.h"

namespace pneuma {

/// A point of a lung's wall and the plane of a later surface that it is brought to.
struct WallPair {
  Vec3 start = Vec3::Zero();
  Vec3 target = Vec3::Zero();
  Vec3 normal = Vec3::Zero();  ///< of the later surface, outwards, of length 1

  /// How far the moved point is outside of the plane, mm.
  double distanceMm(const Vec3& moved) const { return (moved - target).dot(normal); }
};

/// How well a motion brings a lung's wall onto its surface at a later volume: distances of the
/// moved wall from that surface, along the surface's normal.
///
/// A wall may slide along its surface unseen, so that this is a hint and no more: constants that
/// move points wrongly may agree with it. Hold them to landmarks.
class WallReading {
 public:
  /// @param rest,later the closed surfaces of the lung, one frame
  /// @param mostPoints of `rest` that are moved
  /// @throws InvalidInput if the volume does not rise
  WallReading(Side side, const TriangleMesh& rest, const TriangleMesh& later,
              std::size_t mostPoints = 300);
  ~WallReading();
  WallReading(WallReading&&) noexcept;
  WallReading& operator=(WallReading&&) noexcept;

  /// The lung with its strain between the two surfaces.
  const StrainedLung& lung() const;

  /// Points of the wall with what is nearest to them once they moved by the form and a shift.
  /// Left out: what is farther than 30 mm or faces elsewhere than the point does.
  std::vector<WallPair> pairs(const MotionForm& form, const Vec3& shift) const;

 private:
  struct Walls;
  std::unique_ptr<Walls> walls_;
};

/// Mean of the distances' sizes over the pairs, mm; 0 without any.
double meanDistanceMm(const WallReading& reading, const MotionForm& form, const Vec3& shift);

}  // namespace pneuma
