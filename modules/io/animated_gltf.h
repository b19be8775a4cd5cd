#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "core/progress.h"
#include "io/atomic_file.h"

namespace pneuma {

/// A surface that moves from x to x + w u, with a weight w that changes in time. Three numbers a
/// point; LPS, mm.
struct MorphingMesh {
  std::string name;
  std::array<double, 4> colour{1.0, 1.0, 1.0, 1.0};  ///< sRGB and opacity, 0 .. 1
  std::vector<float> points;
  std::vector<float> normals;         ///< unit vectors at w = 0
  std::vector<std::uint8_t> colours;  ///< sRGB of each point in place of `colour`'s; or none
  std::vector<std::array<std::uint32_t, 3>> triangles;
  std::vector<float> displacement;  ///< u
  std::vector<float> normalSlope;   ///< what normals change by at w = 1
  std::size_t motion = 0;           ///< whose weights it takes
};

/// Weights of everything that moves together, one for each moment.
using MorphWeights = std::vector<double>;

/// Writes meshes and their motion as binary glTF 2.0 (.glb), for web pages, Blender and slides: one
/// morph target a mesh, weights between moments by straight lines. The scene is in metres with y up
/// and the patient facing z, as glTF has it.
/// @param seconds of the moments, rising, from 0
/// @param motions each with as many weights as moments
/// @throws OutputFailed; InvalidInput if there is nothing to write or it would exceed 4 GB;
/// Cancelled
void writeAnimatedGltf(const std::filesystem::path& path, const std::vector<MorphingMesh>& meshes,
                       const std::vector<double>& seconds, const std::vector<MorphWeights>& motions,
                       Existing existing = Existing::Replace, const Progress& progress = {});

}  // namespace pneuma
