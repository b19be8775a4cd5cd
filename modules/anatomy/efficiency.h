#pragma once

#include <cstddef>
#include <optional>
#include <span>

#include "anatomy/airway_tree.h"
#include "core/progress.h"

namespace pneuma {

/// The lattice of cubes in which terminals are counted for C_n.
struct EfficiencyCubes {
  double edgeMm = 30.0;
  Vec3 node = Vec3::Zero();  ///< a corner of a cube, LPS, mm
  double leastInside = 0.5;  ///< share of a cube that must lie in the organ, or it is left out
};

/// Kitaoka 1999's cubes for her simple organ: not told in the paper; those at least half inside
/// agree best with her tables.
EfficiencyCubes simpleOrganCubes();

/// For her thorax, whose plane of symmetry is x = 0 and whose apex lies at z = 0: half a cube
/// shifted in x, at least 70 % inside. That gives the 181 cubes of the paper.
EfficiencyCubes thoraxCubes();

/// The lung volume to which Kitaoka 1999 relates the airways of every organ, ml.
inline constexpr double PaperLungVolumeMl = 6388.0;

/// Terminals that a cube holds on average in today's definition of C_n. Terminals that are spread
/// at random then have C_n = 1 / sqrt(40) = 0.158 in every organ and at every number of terminals.
inline constexpr double TerminalsPerCube = 40.0;

/// The efficiency functions in one set of definitions. Smaller is better.
struct EfficiencyFunctions {
  std::optional<double> cn;  ///< C_n: coefficient of variation of the density of terminals
  double vr = 0.0;           ///< V_r: airway volume / volume of the lungs
  double el = 0.0;           ///< EL: energy loss per terminal
  std::optional<double> pi;  ///< PI: Q_f + C_n + C_a + V_r + EL
  EfficiencyCubes cubes;     ///< C_n was taken in
  std::size_t cubeCount = 0;
  double lungVolumeMl = 0.0;  ///< V_r was taken of
};

/// The efficiency functions of an airway tree (Kitaoka, Takaki, Suki 1999, "Evaluation of generated
/// airway trees"). Flows are shares of the lung supplied at and below a branch. What too few
/// terminals or cubes leave unknown is nothing.
struct Efficiency {
  std::size_t branches = 0;  ///< N_T: all branches, the trunk too
  std::size_t terminals = 0;
  std::size_t failed = 0;    ///< terminals that left their region or could not divide it
  double qf = 0.0;           ///< Q_f: share of the flow that ends in failed terminals
  std::optional<double> ca;  ///< C_a: coefficient of variation of the flows of good terminals
  double airwayVolumeMl = 0.0;
  /// As the paper: V_r of 6,388 ml whatever the organ; C_n counts the terminals of whole cubes of
  /// 30 mm, also where a part of the cube lies outside; EL with a constant of 4.
  EfficiencyFunctions paper;
  /// As one would choose today: V_r of the organ's own volume; C_n of the terminals per ml of organ
  /// in cubes at least 90 % inside, of such a size that they hold 40 terminals on average; EL with
  /// Poiseuille's constant 128 / pi.
  EfficiencyFunctions today;
};

/// The efficiency functions of any tree, grown or measured, in its lobes.
///
/// Terminals of unknown ending are good. Terminals that supply nothing in a tree that says what it
/// supplies (a bronchus to a lobe that was not given) have no acinus and are left out of C_a.
/// @param cubes of the paper's C_n
/// @throws InvalidInput for an empty tree, no lobe, or lobes without volume; Cancelled
Efficiency efficiency(const AirwayTree& tree, std::span<const LobeRegion> lobes,
                      const EfficiencyCubes& cubes = simpleOrganCubes(),
                      const Progress& progress = {});

}  // namespace pneuma
