#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "anatomy/lobe.h"
#include "core/progress.h"

namespace pneuma {

/// Points that fill lobes: the nodes of one cubic lattice that lie inside them.
struct SeedPoints {
  double spacingMm = 0.0;
  Vec3 anchor = Vec3::Zero();               ///< a node of the lattice, LPS, mm
  std::vector<std::vector<Vec3>> byRegion;  ///< the points of each lobe, in lattice order

  std::size_t count() const;
};

/// Where lattices lie relative to the corner of the lobes' box, in spacings; odd, so that no node
/// lies on a round coordinate.
inline const Vec3 LatticeOffset(0.37, 0.29, 0.43);

/// Of all lobes together.
double totalVolumeMm3(std::span<const LobeRegion> lobes);

/// Lattice points of the given spacing.
/// @param jitter each point is moved by up to this share of half the spacing per axis; moved points
///        that leave their lobe stay where they were
/// @throws InvalidInput if more than 40 million nodes would be looked at, or a lobe gets no point
SeedPoints seedLattice(std::span<const LobeRegion> lobes, double spacingMm, double jitter,
                       std::uint64_t seed, const Progress& progress = {});

/// Exactly `count` points: the spacing that gives a few more, less a random surplus.
SeedPoints seedExactly(std::span<const LobeRegion> lobes, std::size_t count, double jitter,
                       std::uint64_t seed, const Progress& progress = {});

}  // namespace pneuma
