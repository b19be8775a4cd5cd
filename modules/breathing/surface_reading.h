#pragma once

#include <memory>
#include <vector>

#include "breathing/published_form.h"
#include "core/triangle_mesh.h"

namespace pneuma {

/// What surfaces of one lung at three volumes say of the directions in which it moves: from points
/// of the first, lines along the direction pass the second and the third; on a true direction the
/// third lies as much farther as its volume is greater.
///
/// This reading is nearly blind to directions: to first order the distances are in that ratio along
/// any line. Wrong directions pass; hold them to landmarks. Use it as a weak hint only.
class SurfaceReading {
 public:
  /// @param rest,some,more the closed surfaces of the lung at rising volumes, one frame
  /// @param mostPoints of `rest` that lines start from
  /// @throws InvalidInput if the volumes do not rise
  SurfaceReading(Side side, const TriangleMesh& rest, const TriangleMesh& some,
                 const TriangleMesh& more, std::size_t mostPoints = 1000);
  ~SurfaceReading();
  SurfaceReading(SurfaceReading&&) noexcept;
  SurfaceReading& operator=(SurfaceReading&&) noexcept;

  const LungFrame& frame() const;

  /// Third distance less the wanted multiple of the second one, mm, a value for each starting
  /// point. 0 where the direction runs along the surface, or where no triangle that faces as the
  /// starting point does is passed near enough.
  std::vector<double> residualsMm(const PublishedForm& form) const;

  /// Mean of |residual| over the points that have one. @throws InvalidInput if none has
  double meanResidualMm(const PublishedForm& form) const;

 private:
  struct Surfaces;
  std::unique_ptr<Surfaces> surfaces_;
};

}  // namespace pneuma
