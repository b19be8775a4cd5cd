#include "document/lobe_edits.h"

#include "lobes/fissure_fit.h"

namespace pneuma {

std::vector<Vec3> marksOf(const FissureEdit& edit) {
  if (edit.method == FissureMethod::Points) return edit.points;
  if (!edit.handles) return {};
  return {edit.handles->begin(), edit.handles->end()};
}

FissurePlane planeThrough(const std::array<Vec3, 3>& handles) {
  const BestPlane plane = bestPlane(handles);
  return {plane.centre, plane.axes[2]};
}

LobeInputs inputsOf(const LobeEdits& edits) {
  LobeInputs inputs;
  inputs.shares = edits.shares;
  for (const auto& [fissure, edit] : edits.fissures) {
    if (edit.method == FissureMethod::Plane && edit.handles) {
      inputs.given[fissure].plane = planeThrough(*edit.handles);
    } else if (edit.method == FissureMethod::Points && edit.points.size() >= LeastFissurePoints) {
      inputs.given[fissure].points = edit.points;
    }
  }
  return inputs;
}

}  // namespace pneuma
