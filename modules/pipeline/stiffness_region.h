#pragma once

#include <span>
#include <string_view>
#include <vector>

#include "io/json.h"
#include "pipeline/lung_model.h"

namespace pneuma {

/// A part of the lungs that is stiffer or softer than healthy lung: a lobe, or a ball such as a
/// tumour. It fades over 10 mm, so that the wall shows no crease.
struct StiffnessRegion {
  Lobe lobe = Lobe::Whole;  ///< Whole: a ball
  Vec3 centre = Vec3::Zero();
  double radiusMm = 0.0;
  double factor = 1.0;  ///< of Young's modulus

  bool isBall() const { return lobe == Lobe::Whole; }

  bool operator==(const StiffnessRegion&) const = default;
};

/// Of a region's factor.
inline constexpr double LeastStiffness = 0.01;
inline constexpr double MostStiffness = 100.0;

/// Young's modulus in a lobe with emphysema by that of healthy lung: reasoned, not measured.
inline constexpr double EmphysemaFactor = 0.5;

/// "LLL=0.5", or "60,-20,-150,15=5": a ball by its centre and radius, mm, LPS.
/// @throws InvalidOption saying what is wrong with the text
StiffnessRegion stiffnessRegion(std::string_view text);

/// The lung that a ball is in, by the boxes of its surfaces.
/// @throws InvalidOption if it is in none
Side sideOf(const StiffnessRegion& ball, const LungModel& model);

/// Stiffness of points of a lung by that of healthy lung; empty if no region is in that lung.
/// @param model with the lobes that regions name
/// @throws InvalidOption if a lobe is not among the model's, or a ball is in no lung
std::vector<double> stiffnessAt(std::span<const Vec3> points, Side side, const LungModel& model,
                                std::span<const StiffnessRegion> regions);

/// A lung's compliance by that of a healthy one: softer parts give way more, in proportion to their
/// volume and to 1 / factor. Reasoned, not measured.
/// @param lungMm3 the lung's volume
double complianceOf(Side side, double lungMm3, const LungModel& model,
                    std::span<const StiffnessRegion> regions);

Json toJson(std::span<const StiffnessRegion> regions);

}  // namespace pneuma
