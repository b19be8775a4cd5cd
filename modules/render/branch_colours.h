#pragma once

#include <memory>
#include <span>
#include <vector>

#include "anatomy/airway_tree.h"
#include "render/legend.h"
#include "render/scene.h"

namespace pneuma {

/// A colour for every branch, and what the colours mean.
struct BranchColours {
  std::vector<Rgb> colours;
  Legend legend;  ///< empty when coloured by lobe, whose legend also covers the surfaces
};

/// @param visible one entry per branch; scales span the visible branches only
/// @param peers trees that scale and legend are for as well
BranchColours branchColours(const AirwayTree& tree, const std::vector<bool>& visible,
                            const SceneOptions& options,
                            std::span<const std::shared_ptr<const AirwayTree>> peers = {});

/// True for the branches whose generation is at most `maxGeneration`.
std::vector<bool> branchesUpTo(const AirwayTree& tree, int maxGeneration);

}  // namespace pneuma
