#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "anatomy/airway_tree.h"
#include "anatomy/box_dimension.h"
#include "anatomy/homogeneity.h"
#include "anatomy/order_ratios.h"
#include "anatomy/published_bands.h"
#include "anatomy/summary.h"
#include "core/progress.h"

namespace pneuma {

/// The morphometry of a tree or of the part of it in one lobe. Definitions in
/// docs/algorithms/morphometry.md. Angles in degrees, lengths in mm, volumes in ml.
struct Morphometry {
  std::size_t branches = 0;
  std::size_t branchesContracted = 0;  ///< after joining one-daughter chains
  std::size_t terminals = 0;
  Summary terminalGeneration;
  Summary terminalLengthMm;
  Summary pathLengthMm;            ///< root to terminal ends along the airways
  Summary branchingAngleDeg;       ///< daughters of mothers with two or more daughters
  Summary branchingAngleMajorDeg;  ///< the wider daughter, by flow where diameters are equal
  Summary branchingAngleMinorDeg;
  std::vector<std::pair<std::string, Summary>> branchingAngleByParentDiameterDeg;
  Summary rotationAngleDeg;  ///< between successive branching planes, folded to 0-90
  Summary lengthToDiameter;
  Summary lengthToParent;
  double lengthToParentBelowOne = 0.0;  ///< share of branches shorter than their parent
  Summary diameterToParent;
  Summary diameterMinorToMajor;
  OrderRatios horsfield;
  OrderRatios strahler;
  double deadSpaceMl = 0.0;  ///< sum of the branches' cylinders
  std::optional<Gap> gap;    ///< where a region is known
  std::vector<BoxDimension> boxDimension;
  std::size_t crossings = 0;  ///< pairs of branches, not kin, whose tubes overlap
};

/// What to measure beside the tree itself.
struct MorphometryInput {
  std::span<const LobeRegion> lobes;  ///< for the gap; may be empty
  std::uint64_t seed = 1;             ///< of the random points of the gap
  std::size_t gapPoints = 100000;
};

/// Measures the whole tree.
/// @throws InvalidInput for an empty tree; Cancelled
Morphometry measure(const AirwayTree& tree, const MorphometryInput& input = {},
                    const Progress& progress = {});

/// The same for the branches of every lobe that occurs in the tree (Lobe::Central too).
std::map<Lobe, Morphometry> measureByLobe(const AirwayTree& tree,
                                          const MorphometryInput& input = {},
                                          const Progress& progress = {});

}  // namespace pneuma
