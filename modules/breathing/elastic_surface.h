#pragma once

#include <optional>
#include <span>
#include <vector>

#include "breathing/point_matrix.h"
#include "breathing/surface_proxy.h"

namespace pneuma {

struct ElasticOptions {
  double lengthMm = 10.0;            ///< l, over which points pull each other along
  std::size_t mostPoints = 100'000;  ///< a surface with more is solved on a coarse one instead
};

/// The surface of a lung as an elastic skin on springs to the ground, the operator of Santhanam
/// 2008 for any size of triangles: w of
///   (M E + l^2 L[E]) w = M f,
/// M the area of a point, E its stiffness by the median, L the Laplacian of the surface, f the
/// force by area. Like the paper's it is linear, keeps the sum of forces (of M E w and M f), is
/// above 0 where forces are, and answers to a force at one point at another as it does the other
/// way round. Unlike the paper's (SpringNetwork) it reaches as far on a fine surface as on a coarse
/// one, shows nothing of the points' edges, and the size of E cancels. With l = 0, w = f / E.
class ElasticSurface {
 public:
  /// @param surface closed, mm
  /// @param stiffness by point, any unit, above 0; empty: the same everywhere
  /// @throws InvalidInput if the surface has no area, there are not as many stiffnesses as points,
  /// or one is not above 0
  explicit ElasticSurface(const TriangleMesh& surface, std::span<const double> stiffness = {},
                          const ElasticOptions& options = {});

  /// w of every point, in the unit of `force`.
  /// @throws InvalidInput if there are not as many forces as points; Cancelled
  std::vector<double> response(std::span<const double> force, const SolveOptions& options = {1e-10},
                               const Progress& progress = {}) const;

  /// M, mm^2.
  const std::vector<double>& areas() const { return areas_; }

  /// Points that the equation is solved for.
  std::size_t solvedPoints() const { return matrix_.size(); }

 private:
  std::vector<double> areas_;
  std::optional<SurfaceProxy> proxy_;
  PointMatrix matrix_;
};

}  // namespace pneuma
