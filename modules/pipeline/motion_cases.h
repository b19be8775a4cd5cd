#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "anatomy/landmark_pair.h"
#include "breathing/motion_fit.h"
#include "core/progress.h"
#include "core/triangle_mesh.h"

namespace pneuma {

/// Whose lungs the model of breathing is held to.

/// A deep breath: case 1 of COPDgene (Castillo 2013), both scans in one frame.
struct DeepBreathCase {
  std::vector<LandmarkPair> landmarks;
  std::map<Side, TriangleMesh> walls;     ///< at the end of expiration
  std::map<Side, double> inspirationMm3;  ///< of each lung
  StrainedLungs lungs;                    ///< by the walls' boxes and the volumes
};

/// Quiet breathing: a case of DIR-Lab's 4D CTs (Castillo 2009), which has neither lungs nor
/// volumes. Boxes are those of the landmarks; the strain is that of the affine map that fits the
/// landmarks of a lung best, that is, of its inside, and so taken from what it is held to.
struct QuietBreathCase {
  std::string name;  ///< "1"
  std::vector<LandmarkPair> landmarks;
  StrainedLungs lungs;
};

/// @param data folder that holds motion_copdgene_case01
/// @throws InputMissing, InvalidInput; Cancelled
DeepBreathCase readDeepBreathCase(const std::filesystem::path& data, const Progress& progress = {});

/// Cases 1, 4 and 7. @param data folder that holds motion_dirlab_4dct
/// @throws InputMissing, InvalidInput
std::vector<QuietBreathCase> readQuietBreathCases(const std::filesystem::path& data);

}  // namespace pneuma
