#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <string_view>
#include <vector>

#include "core/triangle_mesh.h"

namespace pneuma {

/// A point of an assignment curve.
struct StrainPoint {
  double r =
      0.0;  ///< distance from the centroid of the most deformable region, share of the largest
  double strain = 0.0;

  bool operator==(const StrainPoint&) const = default;
};

/// Table 3 of Santhanam 2003.
inline constexpr std::array<StrainPoint, 3> PublishedStrain = {
    {{0.0, 0.4}, {0.5, 0.2}, {1.0, 0.075}}};

/// The strain that a point of a lung's surface is given before force is shared out, by its distance
/// from the most deformable region (Santhanam 2003, sections 4.1 and 5.2). A disease is a change of
/// this curve.
class StrainCurve {
 public:
  /// "Exponential to the mid point, then gaussian": the one such pair through the paper's table. It
  /// has a corner at r = 0.5, which shows as a crease.
  static StrainCurve published();

  /// Through points of one's own, without a corner, and nowhere above or below the points on either
  /// side (Fritsch and Carlson 1980).
  /// @throws InvalidInput unless there are two or more with r rising from 0 to 1, strains above 0
  explicit StrainCurve(std::span<const StrainPoint> points);

  /// @param r beyond 0 .. 1 the strain stays that at the end
  double at(double r) const;

  /// d strain / d r; at a corner that to its right.
  double slope(double r) const;

 private:
  StrainCurve() = default;

  std::size_t intervalOf(double r) const;

  std::vector<StrainPoint> points_;  ///< none: the published curve
  std::vector<double> slopes_;       ///< at the points
};

/// Curves to begin with. Only the first two are the paper's points; it says that diseases are
/// changes of the curve and prints none, so that the others are ours, reasoned and not measured.
enum class StrainPreset {
  Published,  ///< the paper's points, exponential and gaussian
  Smooth,     ///< the paper's points without the corner
  Copd,       ///< blown up, the diaphragm flat: base and apex move more alike
  Fibrosis,   ///< scarred from the base up: the base is hardly more deformable than the apex
  Palsy,      ///< the diaphragm does not pull: the middle moves most
  Dyspnea,    ///< neck and rib muscles help: the apex moves more
  Obesity,    ///< the base is pressed shut and opens little
};

constexpr auto choices(StrainPreset) {
  return std::array<std::string_view, 7>{"published", "smooth",  "copd",   "fibrosis",
                                         "palsy",     "dyspnea", "obesity"};
}

/// The points of a preset.
std::span<const StrainPoint> strainPoints(StrainPreset preset);

StrainCurve strainCurve(StrainPreset preset);

/// The default region of maximum deformation: points whose outward normal is within 45 degrees of
/// straight down, in the lowest 40 % of the lung's height. Indices, rising.
/// @param surface closed, oriented outwards, LPS
/// @throws InvalidInput if there is none
std::vector<std::uint32_t> diaphragmaticSurface(const TriangleMesh& surface);

/// The strain S of every point of a surface.
/// @param region points of maximum deformation; their centroid is r = 0, the farthest point r = 1
/// @throws InvalidInput if the region is empty or names a point that is not there
std::vector<double> initialStrain(const TriangleMesh& surface,
                                  std::span<const std::uint32_t> region, const StrainCurve& curve);

}  // namespace pneuma
