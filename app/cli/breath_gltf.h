#pragma once

#include <filesystem>

#include "io/atomic_file.h"
#include "pipeline/breathe.h"

namespace pneuma::cli {

/// Writes lungs that breathe, and their airways as tubes, as animated glTF (.glb), in the colours
/// of pictures.
/// @throws OutputFailed; InvalidInput if it is too much for one file
void writeBreathGltf(const std::filesystem::path& path, const BreathingLungs& lungs,
                     Existing existing);

}  // namespace pneuma::cli
