#pragma once

#include <optional>
#include <span>
#include <vector>

#include "core/options.h"
#include "lobes/height_surface.h"

namespace pneuma {

/// What is above a fissure lies to this side of it, up and to the front, LPS.
inline const Vec3 AboveFissures(0.0, -0.7, 1.0);

struct FissureFitOptions {
  double smoothness = 0.01;

  static constexpr auto fields() {
    return std::tuple{
        Field{"smoothness", &FissureFitOptions::smoothness, "", Range{0.0, 100.0},
              "How far a fissure may leave its points to bend less; 0 goes through all of them."},
    };
  }

  bool operator==(const FissureFitOptions&) const = default;
};

/// The plane that points lie along: their mean, and the axes of their spread.
struct BestPlane {
  Vec3 centre = Vec3::Zero();
  std::array<Vec3, 3> axes{Vec3::UnitX(), Vec3::UnitY(),
                           Vec3::UnitZ()};  ///< u (widest), v, normal up and to the front
  double scale = 1.0;  ///< root mean square distance of the points from the centre, mm
};

/// More would cost seconds and tell nothing new.
inline constexpr std::size_t MostFissurePoints = 2000;

/// @param weights of the points, positive; none: all the same
/// @throws InvalidInput for fewer than three points, more than MostFissurePoints, one that is no
/// number, all on one line
BestPlane bestPlane(std::span<const Vec3> points, std::span<const double> weights = {});

/// A thin-plate spline over the best plane of the points: with three the plane through them, with
/// more as near to them as the smoothness lets it.
/// @throws as bestPlane()
HeightSurface fitFissure(std::span<const Vec3> points, const FissureFitOptions& options = {},
                         std::span<const double> weights = {});

/// A given surface bent through points: the spline of what lies between. For few points, where a
/// surface that most people have is better than a plane. Points nearly on one line leave its slope
/// across that line as it is, so that few of them may be missed by a little.
/// @param prior without knots
HeightSurface bentThrough(const HeightSurface& prior, std::span<const Vec3> points,
                          const FissureFitOptions& options = {},
                          std::span<const double> weights = {});

/// How far each point lies from the surface that the others give, over the best plane of all, mm:
/// what tells whether one was set in a wrong place. Empty for fewer than four points.
/// @throws as bestPlane()
std::vector<double> leaveOneOut(std::span<const Vec3> points,
                                const FissureFitOptions& options = {});

}  // namespace pneuma
