#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "core/progress.h"
#include "pipeline/lung_model.h"

namespace pneuma {

/// One hash of the files of a CT with their names.
/// @throws InputMissing, Cancelled
std::string contentHash(const std::vector<std::filesystem::path>& files,
                        const Progress& progress = {});

/// The same with the size and the hash of its files: of a single one its own SHA-256, of several
/// contentHash(). Every byte is read once more, unless somebody asked before.
/// @throws as ctInputFiles()
CtSource hashed(CtSource source, const Progress& progress = {});

}  // namespace pneuma
