#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "core/math.h"

namespace pneuma {

/// Indices of up to `count` points, each as far as can be from those before it.
std::vector<std::uint32_t> farthestPoints(std::span<const Vec3> points, std::size_t count);

/// A field of vectors in space that takes given values at some points: a sum of the distances to
/// them and an affine map, sum_k c_k |x - x_k| + A x + b. Affine fields come out exactly; between
/// and beyond the points it bends as little as it can. Evaluations may run on several threads.
class RadialField {
 public:
  static constexpr int MostCentres = 1024;

  /// @param centres four that lie in no plane at least, none of them twice, MostCentres at most; mm
  /// @param values of the field there
  /// @throws InvalidInput if that is not so
  RadialField(std::span<const Vec3> centres, std::span<const Vec3> values);

  Vec3 at(const Vec3& p) const;

  /// grad: column j is what the field changes by along axis j, by mm. At a centre, where it has a
  /// kink, the mean over all directions.
  Eigen::Matrix3d gradientAt(const Vec3& p) const;

 private:
  using Numbers = Eigen::Array<double, Eigen::Dynamic, 1, 0, MostCentres, 1>;

  Eigen::ArrayX3d centres_;
  Eigen::MatrixX3d weights_;  // c_k
  Eigen::Matrix3d map_;       // A
  Vec3 offset_;               // b
};

}  // namespace pneuma
