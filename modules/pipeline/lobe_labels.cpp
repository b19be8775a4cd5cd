#include "pipeline/lobe_labels.h"

#include <algorithm>

#include "core/parallel.h"
#include "geometry/nearest_triangle.h"
#include "geometry/surface_voxels.h"
#include "lobes/height_table.h"
#include "segmentation/lung_labels.h"
#include "segmentation/voxel_runs.h"

namespace pneuma {
namespace {

constexpr int MarginVoxels = 2;

/// The box of the voxels with a label, LPS.
Box3 boxOfLabel(const LabelImage& image, std::uint8_t label) {
  const ImageGeometry& geometry = image.geometry;
  std::vector<VoxelComponent> ofSlice(static_cast<std::size_t>(geometry.size[2]));
  parallelFor(ofSlice.size(), [&](std::size_t k) {
    VoxelComponent& box = ofSlice[k];
    for (int j = 0; j < geometry.size[1]; ++j) {
      const std::uint8_t* row = &image.voxels[geometry.index(0, j, static_cast<int>(k))];
      const std::uint8_t* end = row + geometry.size[0];
      const std::uint8_t* first = std::find(row, end, label);
      if (first == end) continue;
      const std::uint8_t* last = end - 1;
      while (*last != label) --last;
      for (const auto i : {first - row, last - row}) {
        const Eigen::Vector3i voxel(static_cast<int>(i), j, static_cast<int>(k));
        box.low = box.low.cwiseMin(voxel);
        box.high = box.high.cwiseMax(voxel);
      }
    }
  });
  VoxelComponent all;
  for (const VoxelComponent& box : ofSlice) {
    all.low = all.low.cwiseMin(box.low);
    all.high = all.high.cwiseMax(box.high);
  }
  Box3 box;
  for (int corner = 0; corner < 8 && all.high.z() >= 0; ++corner) {
    const Eigen::Vector3i voxel((corner & 1) != 0 ? all.high.x() : all.low.x(),
                                (corner & 2) != 0 ? all.high.y() : all.low.y(),
                                (corner & 4) != 0 ? all.high.z() : all.low.z());
    box.extend(geometry.worldFromVoxel(voxel.cast<double>()));
  }
  return box;
}

/// By the meshes: where a fissure folds, or pieces went to the lobe around them, heights do not
/// tell. What the image has beyond the lung's surface goes to the lobe whose surface is nearest.
void divideByMeshes(LabelImage& image, const SplitLung& lung, const Progress& progress) {
  const std::uint8_t whole = lung.side == Side::Right ? RightLabel : LeftLabel;
  for (const Lobe lobe : lobesOf(lung.side)) {
    const TriangleMesh mesh = surfaceOf(lung.complex, static_cast<RegionId>(lobe)).mesh;
    const std::vector<std::uint8_t> inside = voxelsInside(mesh, image.geometry, progress);
    for (std::size_t v = 0; v < inside.size(); ++v) {
      if (inside[v] != 0 && image.voxels[v] == whole) {
        image.voxels[v] = static_cast<std::uint8_t>(lobe);
      }
    }
  }
  TriangleMesh wall{lung.complex.points, {}};
  std::vector<RegionId> lobeOf;
  for (const Facet& facet : lung.complex.facets) {
    if (facet.behind != OutsideRegion && facet.front != OutsideRegion) continue;
    wall.triangles.push_back(facet.corners);
    lobeOf.push_back(std::max(facet.behind, facet.front));
  }
  const NearestTriangle nearest(wall);
  const ImageGeometry& geometry = image.geometry;
  parallelFor(static_cast<std::size_t>(geometry.size[2]), [&](std::size_t k) {
    progress.throwIfStopped();
    for (int j = 0; j < geometry.size[1]; ++j) {
      std::uint8_t* row = &image.voxels[geometry.index(0, j, static_cast<int>(k))];
      for (int i = 0; i < geometry.size[0]; ++i) {
        if (row[i] != whole) continue;
        const Eigen::Vector3i voxel(i, j, static_cast<int>(k));
        const Vec3 p = geometry.worldFromVoxel(voxel.cast<double>());
        row[i] = lobeOf[nearest.nearest(p).triangle];
      }
    }
  });
}

void divide(LabelImage& image, const SplitLung& lung, const UsedFissures& fissures,
            const Progress& progress) {
  const bool byHeights = std::ranges::all_of(lung.reports, [&](const auto& report) {
    const SplitReport& split = report.second;
    return split.piecesJoined == 0 && split.movedMm == 0.0 && !fissures.at(report.first).sheet;
  });
  if (!byHeights) {
    divideByMeshes(image, lung, progress);
    return;
  }
  const bool right = lung.side == Side::Right;
  const std::uint8_t whole = right ? RightLabel : LeftLabel;
  const Box3 box = boxOfLabel(image, whole);
  if (box.isEmpty()) return;
  const auto surface = [&](Fissure fissure) { return fissures.at(fissure).surface; };
  const HeightTable oblique(surface(right ? Fissure::RightOblique : Fissure::LeftOblique), box);
  const HeightTable horizontal(
      right ? surface(Fissure::RightHorizontal) : surface(Fissure::LeftOblique), box);
  const auto label = [](Lobe lobe) { return static_cast<std::uint8_t>(lobe); };
  const ImageGeometry& geometry = image.geometry;
  const Mat3 steps = geometry.steps();
  parallelFor(static_cast<std::size_t>(geometry.size[2]), [&](std::size_t k) {
    progress.throwIfStopped();
    for (int j = 0; j < geometry.size[1]; ++j) {
      std::uint8_t* row = &image.voxels[geometry.index(0, j, static_cast<int>(k))];
      const Vec3 start =
          geometry.origin + steps * Vec3(0.0, static_cast<double>(j), static_cast<double>(k));
      for (int i = 0; i < geometry.size[0]; ++i) {
        if (row[i] != whole) continue;
        const Vec3 p = start + static_cast<double>(i) * steps.col(0);
        const bool below = oblique.below(p);
        row[i] = label(lobeBy(lung.side, below, !below && right && horizontal.below(p)));
      }
    }
  });
}

}  // namespace

LabelImage lobeLabels(const LabelImage& lungs, const LobesOfLungs& lobes,
                      const Progress& progress) {
  LabelImage image = lungs;
  for (const SplitLung& lung : lobes.lungs) {
    divide(image, lung, lobes.fissures, progress);
  }
  return image;
}

LabelImage lungLabels(const LungModel& model, double spacingMm, const Progress& progress) {
  Box3 box;
  for (const LobeSurface& surface : *model.surfaces) box.extend(bounds(*surface.mesh));
  LabelImage image;
  image.geometry = geometryAround(box, spacingMm, MarginVoxels);
  image.voxels.assign(image.geometry.voxelCount(), 0);
  for (const LobeSurface& surface : *model.surfaces) {
    const std::vector<std::uint8_t> inside = voxelsInside(*surface.mesh, image.geometry, progress);
    for (std::size_t v = 0; v < inside.size(); ++v) {
      if (inside[v] != 0) image.voxels[v] = static_cast<std::uint8_t>(surface.lobe);
    }
  }
  return image;
}

}  // namespace pneuma
