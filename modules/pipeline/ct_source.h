#pragma once

#include <filesystem>
#include <memory>
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

/// A CT that was looked for.
struct FoundCt {
  std::shared_ptr<const CtImage> image;
  CtSource source;  ///< where it is, with its hash
};

/// The CT of a project at another place: its files must have the same content, and those of a
/// series the same names, as before; one file of the series is enough to say which.
/// @param source as the project keeps it, with its hash
/// @throws InvalidInput if another CT is there, or none, saying what differs; as readCt()
FoundCt foundCt(const CtSource& source, const std::filesystem::path& path,
                const Progress& progress = {});

}  // namespace pneuma
