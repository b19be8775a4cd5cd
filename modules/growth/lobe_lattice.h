#pragma once

#include <optional>
#include <span>

#include "core/domain.h"
#include "core/progress.h"
#include "growth/aggregation_lattice.h"

namespace pneuma {

/// A lobe on a cubic lattice: the voxels whose centre lies inside are open.
class LobeLattice {
 public:
  using Cell = LatticeCell<3>;

  /// @param anchor centre of a voxel; the same for all lobes, so that their voxels fit together
  /// @param voxelMm side of a voxel
  /// @param seeds points that must be on the lattice whether they lie inside or not
  /// @throws Cancelled
  LobeLattice(const Domain& domain, const Vec3& anchor, double voxelMm, std::span<const Vec3> seeds,
              const Progress& progress = {});

  AggregationLattice<3>& cells() { return *cells_; }

  const AggregationLattice<3>& cells() const { return *cells_; }

  Vec3 centre(const Cell& cell) const { return first_ + voxelMm_ * cell.cast<double>(); }

  Cell cellOf(const Vec3& p) const {
    return ((p - first_) / voxelMm_).array().round().matrix().cast<int>();
  }

  /// Memory that a lattice over this box may take, bytes.
  static double bytesFor(const Box3& box, double voxelMm);

 private:
  double voxelMm_;
  Vec3 first_ = Vec3::Zero();  ///< centre of the first voxel
  std::optional<AggregationLattice<3>> cells_;
};

}  // namespace pneuma
