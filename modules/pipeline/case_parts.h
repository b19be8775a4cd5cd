#pragma once

#include <filesystem>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "pipeline/project.h"

namespace pneuma {

/// Something of a case that goes to a file of its own.
struct CasePart {
  std::string stem;  ///< of the file
  std::shared_ptr<const TriangleMesh> mesh;
  std::shared_ptr<const AirwayTree> tree;
  std::string file;                                         ///< of what is neither, with its end
  std::function<void(const std::filesystem::path&)> write;  ///< likewise
};

/// Surfaces, trees, labels and the fissures that were set.
std::vector<CasePart> partsOf(const ProjectState& state);

/// A project alone, or surfaces, trees and images that become a case without a file.
/// @throws as readProject() and openFiles()
Project openCase(const std::vector<std::filesystem::path>& paths, const Progress& progress = {});

}  // namespace pneuma
