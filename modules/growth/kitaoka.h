#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <string_view>
#include <tuple>

#include "core/options.h"
#include "core/progress.h"
#include "growth/containment.h"
#include "growth/growth_result.h"

namespace pneuma {

/// A rule or a refinement that can be switched.
enum class Switch { Off, On };

constexpr std::array<std::string_view, 2> choices(Switch) { return {"off", "on"}; }

/// Where a terminal ends.
enum class TerminalEnds {
  Rule,    ///< where the rules for every branch put it, as in the paper
  Centre,  ///< at the centre of the region it serves
};

constexpr std::array<std::string_view, 2> choices(TerminalEnds) { return {"rule", "centre"}; }

/// What of a lobe each of its inlets serves.
enum class InletRegions {
  Auto,      ///< Division below template airways, Nearest below measured ones
  Division,  ///< as the bifurcations above the inlets divide it, by the half-planes of rule 4a
  Nearest,   ///< all that is nearer to its end than to that of any other inlet
};

constexpr std::array<std::string_view, 3> choices(InletRegions) {
  return {"auto", "division", "nearest"};
}

/// Options of growth by Kitaoka's rules. The rules' parameters have the values of Kitaoka 1999;
/// what goes beyond the paper has the values that serve a person's lobes best
/// (docs/algorithms/kitaoka.md). kitaokaPaper() has the paper's values throughout.
struct KitaokaOptions {
  double flowThreshold = 6e-5;  ///< of the whole flow; smaller flows end a branch
  std::uint64_t terminals = 0;
  double lengthToDiameter = 3.0;
  double rotationDeg = 90.0;
  double minDistanceToLength = 3.0;
  double maxDistanceToLength = 6.0;
  double ratioThreshold = 0.05;
  double lastRatio = 0.35;
  double diameterExponent = 2.8;
  double trunkDiameterMm = 0.0;
  int grid = 20;
  Switch rule4a = Switch::On;
  Switch rule6a = Switch::On;
  Switch rule7a = Switch::On;
  Switch rule8a = Switch::On;
  double lengthSpread = 0.0;
  double rotationSpreadDeg = 0.0;
  std::uint64_t seed = 1;
  InletRegions inletRegions = InletRegions::Auto;
  Switch remeasure = Switch::On;
  Switch rescue = Switch::On;
  double symmetry = 0.0;
  TerminalEnds terminalEnds = TerminalEnds::Centre;
  double reach = 1.3;
  Containment containment = Containment::Branches;

  static constexpr auto fields() {
    using O = KitaokaOptions;
    return std::tuple{
        Field{"flow-threshold", &O::flowThreshold, "", Range{1e-8, 0.5},
              "Branches with a smaller share of the whole flow are terminals (Qc)."},
        Field{"terminals", &O::terminals, "", Range{0, 5e6},
              "Choose the flow threshold for about this many terminals; 0: as flow-threshold "
              "says."},
        Field{"length-to-diameter", &O::lengthToDiameter, "", Range{1.0, 10.0},
              "Length of a branch in diameters before rule 7a."},
        Field{"rotation", &O::rotationDeg, "deg", Range{-180.0, 180.0},
              "Rotation of successive branching planes before rule 8a."},
        Field{"min-distance-to-length", &O::minDistanceToLength, "", Range{1.0, 20.0},
              "Rule 7a shortens a branch until the way to its region's wall is this many lengths."},
        Field{"max-distance-to-length", &O::maxDistanceToLength, "", Range{1.0, 100.0},
              "Rule 7a lengthens a branch until the way to its region's wall is this many "
              "lengths."},
        Field{"ratio-threshold", &O::ratioThreshold, "", Range{0.0, 0.5},
              "Rule 8a turns the branching plane until the smaller daughter gets this share."},
        Field{"last-ratio", &O::lastRatio, "", Range{0.0, 0.5},
              "Least share of a daughter whose parent carries less than 1.5 flow thresholds."},
        Field{"diameter-exponent", &O::diameterExponent, "", Range{2.0, 4.0},
              "Exponent n of flow = C diameter^n."},
        Field{"trunk-diameter", &O::trunkDiameterMm, "mm", Range{0.0, 100.0},
              "Diameter at the whole flow, from which all others follow; 0: that of the root of "
              "template airways, else 18 mm scaled from 6,388 ml to the lungs' volume."},
        Field{"grid", &O::grid, "", Range{5, 30},
              "Cells along each side of the grid that is laid on every region."},
        Field{"rule-4a", &O::rule4a, "", Range{}, "Bent space-dividing planes."},
        Field{"rule-6a", &O::rule6a, "", Range{}, "Branching angles after the regions' shape."},
        Field{"rule-7a", &O::rule7a, "", Range{}, "Lengths after the regions' shape."},
        Field{"rule-8a", &O::rule8a, "", Range{},
              "Turned branching planes; without it too small ratios fail."},
        Field{"length-spread", &O::lengthSpread, "", Range{0.0, 1.0},
              "Standard deviation of a random change of every length-to-diameter ratio (the "
              "paper: 0.3)."},
        Field{"rotation-spread", &O::rotationSpreadDeg, "deg", Range{0.0, 45.0},
              "Standard deviation of a random change of every rotation (the paper: 5)."},
        Field{"seed", &O::seed, "", Range{0, 9007199254740991.0},
              "Seed of everything random: same seed, same tree."},
        Field{"inlet-regions", &O::inletRegions, "", Range{},
              "What each inlet of a lobe serves: by the bifurcations above (division), by distance "
              "(nearest); auto: division below template airways, nearest below measured ones."},
        Field{"remeasure", &O::remeasure, "", Range{},
              "The flow of a branch is measured on its own region's grid, not on its parent's "
              "alone: what a coarse grid misses is not lost."},
        Field{"rescue", &O::rescue, "", Range{},
              "A branch about to leave its region is shortened, turned or led back into it "
              "instead of failing."},
        Field{"symmetry", &O::symmetry, "", Range{0.0, 0.5},
              "The dividing planes are tilted until the smaller daughter gets this share; 0: as "
              "the rules say."},
        Field{"terminal-ends", &O::terminalEnds, "", Range{},
              "Terminals end as the rules say (rule) or at the centre of what they serve "
              "(centre)."},
        Field{"reach", &O::reach, "", Range{0.0, 10.0},
              "A region that reaches farther than this from its centre is divided across its "
              "longest way, whatever its flow; in edges of a cube of its own volume, at least of "
              "the mean terminal's; 0: never."},
        Field{"containment", &O::containment, "", Range{},
              "What must stay inside its lobe: none (as the paper), ends, branches."},
    };
  }

  bool operator==(const KitaokaOptions&) const = default;
};

/// The paper's options: nothing beyond its rules.
KitaokaOptions kitaokaPaper();

/// Grows by the nine basic and four supplementary rules of Kitaoka, Takaki and Suki 1999 (every
/// rule, and where we differ, in docs/algorithms/kitaoka.md).
/// @throws InvalidInput, InvalidOption, Cancelled (see growAirways); InvalidInput if the tree would
///         not fit into memory
GrowthResult growByKitaoka(const AirwayTree& central, std::span<const LobeRegion> lobes,
                           const KitaokaOptions& options, const Progress& progress = {});

}  // namespace pneuma
