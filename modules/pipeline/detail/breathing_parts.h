#pragma once

#include <map>
#include <string>
#include <vector>

#include "pipeline/breathe.h"

namespace pneuma {

/// The closed surfaces of whole lungs of a model, its lobes joined where there are lobes.
std::map<Side, TriangleMesh> wallsOf(const LungModel& model, std::vector<std::string>& warnings,
                                     const Progress& progress);

/// Every surface of the model with its displacements.
std::vector<MovingSurface> movingSurfaces(const LungModel& model,
                                          const std::map<Side, LungMotion>& motion,
                                          const Progress& progress);

/// Fills the displacements of the tree.
/// @throws InvalidInput if the tree lies elsewhere than the lungs
void moveTree(BreathingLungs& lungs, const Progress& progress);

/// Points of a grid within a closed surface.
std::vector<Vec3> pointsWithin(const TriangleMesh& surface, const Box3& box, double stepMm);

}  // namespace pneuma
