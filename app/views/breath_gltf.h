#pragma once

#include <filesystem>

#include "core/progress.h"
#include "io/atomic_file.h"
#include "pipeline/breathe.h"

namespace pneuma {

/// Writes lungs that breathe, and their airways as tubes, as animated glTF (.glb), in the colours
/// of pictures. Needs no OpenGL.
/// @throws OutputFailed; InvalidInput if it is too much for one file; Cancelled
void writeBreathGltf(const std::filesystem::path& path, const BreathingLungs& lungs,
                     Existing existing, const Progress& progress = {});

}  // namespace pneuma
