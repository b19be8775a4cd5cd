#include "pipeline/detail/sample_walls.h"

#include "pipeline/detail/breathing_parts.h"
#include "pipeline/sample_chest.h"

namespace pneuma {

std::map<Side, TriangleMesh> sampleWalls(const Progress& progress) {
  constexpr double CellMm = 5.0;
  LungModel model;
  model.surfaces = std::make_shared<const std::vector<LobeSurface>>(
      sampleChest(CellMm, progress.part(0.0, 0.7, "making lungs")).lobes);
  std::vector<std::string> warnings;
  return wallsOf(model, warnings, progress.part(0.7, 1.0, "joining lobes"));
}

}  // namespace pneuma
