#include "segmentation/inner_air.h"

namespace pneuma {
namespace {

// A lung at the border of the slices is told from the air around the body by these.
constexpr int LungLowHu = -940;
constexpr int LungHighHu = -600;
constexpr double LungShare = 0.6;  ///< of its voxels in that range
constexpr double LungLeastMm2 = 500.0;

/// What touches the border in one slice.
struct BorderPart {
  bool touches = false;
  std::size_t lungLike = 0;  ///< voxels of a lung's density
};

std::vector<BorderPart> borderParts(const CtImage& ct, const VoxelRuns& air,
                                    const VoxelComponents& parts) {
  const auto [width, height, depth] = air.size;
  std::vector<BorderPart> result(parts.all.size());
  const auto padded = [&](std::size_t voxel) { return ct.voxels[voxel] < PaddingBelowHu; };
  for (int k = 0; k < depth; ++k) {
    const std::size_t firstRow = static_cast<std::size_t>(k) * static_cast<std::size_t>(height);
    forEachRun(air, k, [&](std::size_t row, const VoxelRun& run, std::uint32_t r) {
      const std::size_t voxel = air.rowVoxel(row);
      const std::size_t j = row - firstRow;
      const bool touches = j == 0 || j + 1 == static_cast<std::size_t>(height) || run.first == 0 ||
                           run.end == width || padded(voxel + run.first - 1) ||
                           padded(voxel + run.end);
      if (touches) result[parts.ofRun[r]].touches = true;
    });
  }
  parallelFor(static_cast<std::size_t>(depth), [&](std::size_t k) {
    // A part lies in one slice, so that no two threads add to the same one.
    forEachRun(air, static_cast<int>(k),
               [&](std::size_t row, const VoxelRun& run, std::uint32_t r) {
                 BorderPart& part = result[parts.ofRun[r]];
                 if (!part.touches) return;
                 const std::int16_t* hu = ct.voxels.data() + air.rowVoxel(row);
                 for (int i = run.first; i < run.end; ++i) {
                   if (hu[i] >= LungLowHu && hu[i] <= LungHighHu) ++part.lungLike;
                 }
               });
  });
  return result;
}

/// The middle of all soft tissue along i, from every fourth voxel.
double bodyCentre(const CtImage& ct) {
  const auto [width, height, depth] = ct.geometry.size;
  double sum = 0.0;
  double count = 0.0;
  for (int k = 0; k < depth; k += std::max(1, depth / 32)) {
    for (int j = 0; j < height; j += 4) {
      for (int i = 0; i < width; i += 4) {
        const int hu = ct.at(i, j, k);
        if (hu < -300 || hu > 300) continue;
        sum += i;
        count += 1.0;
      }
    }
  }
  return count > 0.0 ? sum / count : 0.5 * (width - 1);
}

}  // namespace

InnerAir findInnerAir(const CtImage& ct, double thresholdHu) {
  const VoxelRuns air = runsWhere(ct.geometry.size, [&](std::size_t voxel) {
    const int hu = ct.voxels[voxel];
    return hu < thresholdHu && hu >= PaddingBelowHu;
  });
  const VoxelComponents parts = components(air, Connection::InSlices);
  const std::vector<BorderPart> border = borderParts(ct, air, parts);
  const Vec3& spacing = ct.geometry.spacing;
  const double leastVoxels = LungLeastMm2 / (spacing.x() * spacing.y());

  InnerAir inner;
  inner.runs.size = air.size;
  inner.runs.rowStart.reserve(air.rowStart.size());
  inner.runs.rowStart.push_back(0);
  for (std::size_t row = 0; row < air.rowCount(); ++row) {
    for (std::uint32_t r = air.rowStart[row]; r < air.rowStart[row + 1]; ++r) {
      const std::size_t part = parts.ofRun[r];
      if (border[part].touches) {
        const auto voxels = static_cast<double>(parts.all[part].voxels);
        if (voxels < leastVoxels ||
            static_cast<double>(border[part].lungLike) < LungShare * voxels) {
          continue;
        }
      }
      inner.runs.runs.push_back(air.runs[r]);
    }
    inner.runs.rowStart.push_back(static_cast<std::uint32_t>(inner.runs.runs.size()));
  }
  inner.inSlices = components(inner.runs, Connection::InSlices);
  inner.bodyCentre = bodyCentre(ct);
  return inner;
}

}  // namespace pneuma
