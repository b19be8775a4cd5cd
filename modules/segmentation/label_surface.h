#pragma once

#include <cstdint>
#include <tuple>

#include "core/image.h"
#include "core/options.h"
#include "core/progress.h"
#include "core/triangle_mesh.h"

namespace pneuma {

struct SurfaceOptions {
  int triangles = 0;

  static constexpr auto fields() {
    return std::tuple{Field{"triangles", &SurfaceOptions::triangles, "", Range{0.0, 20e6},
                            "Triangles of a surface, about; 0: as many as its voxels need."}};
  }

  bool operator==(const SurfaceOptions&) const = default;
};

/// The closed surface of one label, oriented outwards, LPS, mm: largest component, holes filled,
/// airways that run inside it included.
///
/// Discrete flying edges, 20 iterations of a windowed sinc filter (Taubin, Zhang and Golub 1996)
/// with pass band 0.02, no point moved by more than 0.45 of a voxel's diagonal, then every point
/// moved along its normal until the surface holds the volume of its voxels again: smooth, and
/// nowhere farther than about half a voxel from where it was.
/// @throws InvalidInput if no voxel has the label; Unsupported if no surface of
/// so few triangles is closed
TriangleMesh labelSurface(const LabelImage& labels, std::uint8_t label,
                          const SurfaceOptions& options = {}, const Progress& progress = {});

/// Volume of what labelSurface() draws: the voxels of the label and of the airways in it, mm^3.
double labelVolumeMm3(const LabelImage& labels, std::uint8_t label);

/// Moves every point of a closed mesh along its normal until it holds a volume, mm^3.
void restoreVolume(TriangleMesh& mesh, double volumeMm3);

}  // namespace pneuma
