#pragma once

#include <array>
#include <memory>
#include <vector>

#include "document/property_sheet.h"
#include "pipeline/breathe.h"
#include "render/breathing_scene.h"
#include "render/scene.h"

namespace pneuma {

/// What colours the lungs while they breathe.
enum class BreathColour { Lobe, Displacement, VolumeChange };

/// Lungs that breathe, ready to be shown.
struct Breath {
  BreathingLungs lungs;
  BreatheOptions options;
  Json report;
  double farthestMm = 0.0;             ///< that a point of a surface goes from rest
  std::vector<SceneSurface> surfaces;  ///< at rest, in the order of the model's
  std::array<std::shared_ptr<const BreathingScene>, 3> scenes;  ///< of these, by BreathColour
};

/// Makes what is shown of them; takes a second for a million triangles.
/// @param model that breathes
std::shared_ptr<const Breath> breathOf(const LungModel& model, BreathingLungs lungs,
                                       const BreatheOptions& options, Json report);

/// How far each lung has moved at a share of the period, so that its volume is the curve's.
BreathScale scaleAt(const Breath& breath, double phase);

/// Both lungs' volume at a share of the period, ml.
double volumeMlAt(const Breath& breath, double phase);

/// What the breath is like, and its checks.
PropertySheet breathSheet(const Breath& breath);

}  // namespace pneuma
