#include "pipeline/motion_cases.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "core/error.h"
#include "io/landmark_file.h"
#include "io/volume_file.h"
#include "pipeline/landmark_lungs.h"
#include "segmentation/label_surface.h"
#include "segmentation/lung_labels.h"
#include "segmentation/lung_separation.h"

namespace pneuma {
namespace {

namespace fs = std::filesystem;

constexpr std::array<std::pair<Side, std::uint8_t>, 2> LungLabels = {
    {{Side::Right, RightLabel}, {Side::Left, LeftLabel}}};

/// The box of all voxels that are set.
VoxelBox boxOfMask(const LabelImage& mask, const std::string& name) {
  Eigen::AlignedBox3i box;
  for (int k = 0; k < mask.geometry.size[2]; ++k) {
    for (int j = 0; j < mask.geometry.size[1]; ++j) {
      for (int i = 0; i < mask.geometry.size[0]; ++i) {
        if (mask.at(i, j, k) != 0) box.extend(Eigen::Vector3i(i, j, k));
      }
    }
  }
  if (box.isEmpty()) throw InvalidInput("'" + name + "' is empty; it has to hold two lungs");
  return boxAround(box.min(), box.max());
}

/// The lungs of a mask that holds both, which may touch.
LabelImage readLungMask(const fs::path& path, const Progress& progress) {
  LabelImage mask = readLabelVolume(path, progress.part(0.0, 0.2, "reading lungs"));
  mask = turned(mask, patientAxes(mask.geometry));
  const VoxelBox box = boxOfMask(mask, path.string());
  std::vector<std::uint8_t> set(box.voxelCount(), 0);
  forEachRow(box, mask.geometry, [&](std::size_t at, std::size_t v, std::size_t count) {
    std::copy_n(mask.voxels.begin() + static_cast<std::ptrdiff_t>(v), count,
                set.begin() + static_cast<std::ptrdiff_t>(at));
  });
  const double middle = box.low.x() + 0.5 * (box.size[0] - 1);
  if (!separateLungs(box, mask.geometry.spacing, middle, set,
                     progress.part(0.2, 1.0, "telling the lungs apart"))
           .done) {
    throw InvalidInput("'" + path.string() + "' does not fall into two lungs");
  }
  forEachRow(box, mask.geometry, [&](std::size_t at, std::size_t v, std::size_t count) {
    for (std::size_t n = 0; n < count; ++n) {
      const std::uint8_t lung = set[at + n];
      mask.voxels[v + n] = lung == 0 ? std::uint8_t{0} : lung == 1 ? RightLabel : LeftLabel;
    }
  });
  return mask;
}

double strainOf(double volumeRatio) { return std::cbrt(volumeRatio) - 1.0; }

QuietBreathCase readQuietBreathCase(const fs::path& path, const std::string& name) {
  QuietBreathCase found;
  found.name = name;
  found.landmarks = readLandmarkPairs(path);
  // Slices are counted downwards there.
  for (LandmarkPair& pair : found.landmarks) {
    pair.rest.z() = -pair.rest.z();
    pair.moved.z() = -pair.moved.z();
  }
  tellSidesByGap(found.landmarks);
  for (const auto& [side, box] : boxesOf(found.landmarks)) {
    found.lungs.emplace(side, StrainedLung{{side, box}, innerStrain(found.landmarks, side)});
  }
  return found;
}

}  // namespace

DeepBreathCase readDeepBreathCase(const fs::path& data, const Progress& progress) {
  const fs::path folder = data / "motion_copdgene_case01";
  DeepBreathCase found;
  found.landmarks = readLandmarkPairs(folder / "case_01_landmarks_mm.csv");
  const LabelImage rest =
      readLungMask(folder / "case_01_exp_mask.mha", progress.part(0.0, 0.3, "expiration"));
  const LabelImage moved =
      readLungMask(folder / "case_01_insp_mask.mha", progress.part(0.3, 0.6, "inspiration"));
  double from = 0.6;
  for (const auto& [side, label] : LungLabels) {
    const Progress part = progress.part(from, from + 0.2, "drawing surfaces");
    from += 0.2;
    const TriangleMesh& wall =
        found.walls.emplace(side, labelSurface(rest, label, {}, part)).first->second;
    const double mm3 = labelVolumeMm3(moved, label);
    found.inspirationMm3[side] = mm3;
    found.lungs.emplace(side,
                        StrainedLung{{side, bounds(wall)}, strainOf(mm3 / signedVolumeMm3(wall))});
  }
  tellSidesByWalls(found.landmarks, found.walls);
  progress.report(1.0);
  return found;
}

std::vector<QuietBreathCase> readQuietBreathCases(const fs::path& data) {
  const fs::path folder = data / "motion_dirlab_4dct";
  std::vector<QuietBreathCase> cases;
  for (const char* name : {"1", "4", "7"}) {
    cases.push_back(
        readQuietBreathCase(folder / ("case0" + std::string(name) + "_landmarks_mm.csv"), name));
  }
  return cases;
}

}  // namespace pneuma
