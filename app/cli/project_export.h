#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "pipeline/project.h"

namespace pneuma::cli {

/// Something in a project that goes to a file of its own.
struct ProjectPart {
  std::string stem;  ///< of the file
  std::shared_ptr<const TriangleMesh> mesh;
  std::shared_ptr<const AirwayTree> tree;
  std::string file;                                         ///< of what is neither, with its end
  std::function<void(const std::filesystem::path&)> write;  ///< likewise
};

/// Surfaces, trees, labels and the fissures that were set.
/// @throws as readProject(); InputMissing if there is nothing
std::vector<ProjectPart> partsOfProject(const std::filesystem::path& path,
                                        const Progress& progress);

}  // namespace pneuma::cli
