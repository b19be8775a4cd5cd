#pragma once

#include <functional>
#include <map>
#include <vector>

#include "lobes/fissure_proposal.h"
#include "lobes/lobe_splitting.h"

/// How well fissures part a lung whose lobes are known, without cutting any surface.
namespace pneuma::testing {

/// Centres of a lung's voxels.
struct LungVoxels {
  Side side = Side::None;
  std::vector<Vec3> centres;
};

/// What `lungAt` says is a lung's, on cubic voxels.
LungVoxels lungVoxels(Side side, const Box3& box, double voxelMm,
                      const std::function<bool(const Vec3&)>& lungAt);

/// As lungBox() of the lung's surface.
LungBox boxOf(const LungVoxels& lung);

/// The lobe of each voxel by the fissures' heights.
std::vector<Lobe> lobesBy(const FissureSurfaces& fissures, const LungVoxels& lung);

/// Twice what both have over the sum of what each has.
std::map<Lobe, double> dice(const std::vector<Lobe>& one, const std::vector<Lobe>& other);

/// The best plane through points as a fissure.
HeightSurface planeThrough(const std::vector<Vec3>& points);

/// The value below which this share of the values lies.
double quantile(std::vector<double> values, double share);

}  // namespace pneuma::testing
