#include "pipeline/motion_cases.h"

#include <algorithm>
#include <array>
#include <cmath>

#include <Eigen/LU>
#include <Eigen/QR>

#include "core/error.h"
#include "geometry/nearest_triangle.h"
#include "io/landmark_file.h"
#include "io/volume_file.h"
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

/// The lung that each landmark lies in or next to.
void findLungs(std::vector<LandmarkPair>& landmarks, const LabelImage& mask,
               const std::map<Side, TriangleMesh>& walls) {
  std::map<Side, NearestTriangle> nearest;
  for (const auto& [side, wall] : walls) nearest.try_emplace(side, wall);
  for (LandmarkPair& pair : landmarks) {
    const Eigen::Vector3i voxel =
        mask.geometry.voxelFromWorld(pair.rest).array().round().matrix().cast<int>();
    const Eigen::Vector3i size(mask.geometry.size.data());
    const bool within = (voxel.array() >= 0).all() && (voxel.array() < size.array()).all();
    const std::uint8_t label = within ? mask.at(voxel.x(), voxel.y(), voxel.z()) : std::uint8_t{0};
    if (label != 0) {
      pair.side = label == RightLabel ? Side::Right : Side::Left;
    } else {
      const bool right = nearest.at(Side::Right).distanceMm(pair.rest) <
                         nearest.at(Side::Left).distanceMm(pair.rest);
      pair.side = right ? Side::Right : Side::Left;
    }
  }
}

double strainOf(double volumeRatio) { return std::cbrt(volumeRatio) - 1.0; }

/// Volume ratio of the affine map that fits landmarks best.
double affineRatio(const std::vector<LandmarkPair>& landmarks, Side side) {
  const auto count = std::ranges::count(landmarks, side, &LandmarkPair::side);
  Eigen::MatrixX4d places(count, 4);
  Eigen::MatrixX3d moved(count, 3);
  Eigen::Index row = 0;
  for (const LandmarkPair& pair : landmarks) {
    if (pair.side != side) continue;
    places.row(row) << pair.rest.transpose(), 1.0;
    moved.row(row++) = pair.moved.transpose();
  }
  const Eigen::Matrix<double, 4, 3> affine = places.colPivHouseholderQr().solve(moved);
  return affine.topRows<3>().determinant();
}

QuietBreathCase readQuietBreathCase(const fs::path& path, const std::string& name) {
  QuietBreathCase found;
  found.name = name;
  found.landmarks = readLandmarkPairs(path);
  // Slices are counted downwards there.
  for (LandmarkPair& pair : found.landmarks) {
    pair.rest.z() = -pair.rest.z();
    pair.moved.z() = -pair.moved.z();
  }
  std::vector<double> xs;
  for (const LandmarkPair& pair : found.landmarks) xs.push_back(pair.rest.x());
  std::ranges::sort(xs);
  double middle = xs.front();
  double gap = 0.0;
  for (std::size_t n = 1; n < xs.size(); ++n) {
    if (xs[n] - xs[n - 1] <= gap) continue;
    gap = xs[n] - xs[n - 1];
    middle = 0.5 * (xs[n] + xs[n - 1]);
  }
  std::map<Side, Box3> boxes;
  for (LandmarkPair& pair : found.landmarks) {
    pair.side = pair.rest.x() < middle ? Side::Right : Side::Left;
    boxes[pair.side].extend(pair.rest);
  }
  for (const auto& [side, box] : boxes) {
    found.lungs.emplace(side,
                        StrainedLung{{side, box}, strainOf(affineRatio(found.landmarks, side))});
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
  findLungs(found.landmarks, rest, found.walls);
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
