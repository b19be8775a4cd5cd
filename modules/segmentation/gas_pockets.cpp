#include "segmentation/gas_pockets.h"

#include <algorithm>
#include <array>
#include <cmath>

#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>

#include "core/units.h"
#include "segmentation/closing.h"
#include "segmentation/distance_map.h"
#include "segmentation/lung_labels.h"
#include "segmentation/lung_separation.h"
#include "segmentation/voxel_runs.h"

namespace pneuma {
namespace {

constexpr double BlurMm = 2.0;
constexpr double ErosionMm = 2.0;
constexpr double GasBelowHu = -930.0;
constexpr double LeastMl = 20.0;
constexpr double MostSdHu = 35.0;

constexpr double LungFromMm = 12.0;  ///< this far from the pocket all is lung
constexpr double WallContrastHu = 100.0;
constexpr double MostOpen = 0.35;  ///< of its surface that may open into the lung
constexpr double MostShare = 0.4;  ///< of the lung that a pocket may be

/// Nonzero where a slice's part of the box is thin over a wide space, inside the label.
std::vector<std::uint8_t> thinPlaces(const CtImage& ct, const LabelImage& labels,
                                     std::uint8_t label, const VoxelBox& box) {
  const Vec3& spacing = ct.geometry.spacing;
  std::vector<std::uint8_t> thin(box.voxelCount(), 0);
  const int erodeX = static_cast<int>(std::lround(ErosionMm / spacing.x()));
  const int erodeY = static_cast<int>(std::lround(ErosionMm / spacing.y()));
  const cv::Mat disc =
      cv::getStructuringElement(cv::MORPH_ELLIPSE, {2 * erodeX + 1, 2 * erodeY + 1});
  parallelFor(static_cast<std::size_t>(box.size[2]), [&](std::size_t k) {
    cv::Mat hu(box.size[1], box.size[0], CV_32F);
    cv::Mat inside(box.size[1], box.size[0], CV_8U);
    for (int j = 0; j < box.size[1]; ++j) {
      const std::size_t from =
          ct.geometry.index(box.low.x(), box.low.y() + j, box.low.z() + static_cast<int>(k));
      for (int i = 0; i < box.size[0]; ++i) {
        const std::size_t v = from + static_cast<std::size_t>(i);
        hu.at<float>(j, i) = ct.voxels[v];
        inside.at<std::uint8_t>(j, i) = labels.voxels[v] == label ? 1 : 0;
      }
    }
    cv::GaussianBlur(hu, hu, {}, BlurMm / spacing.x(), BlurMm / spacing.y(), cv::BORDER_REPLICATE);
    cv::erode(inside, inside, disc);
    for (int j = 0; j < box.size[1]; ++j) {
      for (int i = 0; i < box.size[0]; ++i) {
        if (inside.at<std::uint8_t>(j, i) != 0 && hu.at<float>(j, i) < GasBelowHu) {
          thin[box.index(i, j, static_cast<int>(k))] = 1;
        }
      }
    }
  });
  return thin;
}

/// Mean and standard deviation of densities.
struct Density {
  double sum = 0.0;
  double squares = 0.0;
  double count = 0.0;

  void add(double hu) {
    sum += hu;
    squares += hu * hu;
    count += 1.0;
  }

  double mean() const { return count > 0.0 ? sum / count : 0.0; }

  double deviation() const {
    return std::sqrt(std::max(0.0, squares / std::max(count, 1.0) - mean() * mean()));
  }
};

/// One pocket that was found, in the box of its lung.
class Pocket {
 public:
  Pocket(const CtImage& ct, LabelImage& labels, std::uint8_t label, const VoxelBox& lungBox,
         const VoxelRuns& runs, const VoxelComponents& parts, std::size_t part)
      : ct_(ct), labels_(labels), label_(label) {
    const Vec3& spacing = ct.geometry.spacing;
    const VoxelComponent& component = parts.all[part];
    const Eigen::Vector3i margin = (1.5 * LungFromMm / spacing.array()).ceil().cast<int>() + 1;
    box_ = within(boxAround(component.low + lungBox.low, component.high + lungBox.low, margin),
                  ct.geometry);
    marks_.assign(box_.voxelCount(), 0);
    const Eigen::Vector3i shift = lungBox.low - box_.low;
    const auto rows = static_cast<std::size_t>(runs.size[1]);
    for (std::size_t row = 0; row < runs.rowCount(); ++row) {
      for (std::uint32_t r = runs.rowStart[row]; r < runs.rowStart[row + 1]; ++r) {
        if (parts.ofRun[r] != part) continue;
        const int j = static_cast<int>(row % rows) + shift.y();
        const int k = static_cast<int>(row / rows) + shift.z();
        for (int i = runs.runs[r].first; i < runs.runs[r].end; ++i) {
          marks_[box_.index(i + shift.x(), j, k)] = PocketMark;
          density_.add(ct.at(i + lungBox.low.x(), j + box_.low.y(), k + box_.low.z()));
        }
      }
    }
  }

  bool isUniform() const { return density_.deviation() < MostSdHu; }

  /// Cuts the pocket off where the set is thinnest and takes it out of the lung, if there is a
  /// wall. Returns the number of voxels removed.
  std::size_t remove(std::size_t lungVoxels, const Progress& progress) {
    std::vector<std::uint8_t> outside(marks_.size(), 0);
    forEachVoxel(
        [&](std::size_t at, std::size_t v) { outside[at] = labels_.voxels[v] == label_ ? 0 : 1; });
    const Vec3& spacing = ct_.geometry.spacing;
    const std::vector<float> toPocket =
        squaredDistances(marks_, box_.size, spacing, LungFromMm, progress);
    const std::vector<float> inLung = squaredDistances(outside, box_.size, spacing, 30.0, progress);
    forEachVoxel([&](std::size_t at, std::size_t) {
      if (outside[at] == 0 && std::isinf(toPocket[at])) marks_[at] = LungMark;
    });
    floodByDistance(box_, inLung, marks_, progress);
    if (!hasWall()) return 0;
    // Of the label: another pocket may have taken some of it.
    std::size_t pocket = 0;
    forEachVoxel([&](std::size_t at, std::size_t v) {
      if (marks_[at] == PocketMark && labels_.voxels[v] == label_) ++pocket;
    });
    if (static_cast<double>(pocket) > MostShare * static_cast<double>(lungVoxels)) return 0;
    forEachVoxel([&](std::size_t at, std::size_t v) {
      if (marks_[at] == PocketMark && labels_.voxels[v] == label_) labels_.voxels[v] = 0;
    });
    return pocket;
  }

 private:
  static constexpr std::uint8_t PocketMark = 1;
  static constexpr std::uint8_t LungMark = 2;

  template <class F>
  void forEachVoxel(F&& f) const {
    forEachRow(box_, ct_.geometry, [&](std::size_t at, std::size_t v, std::size_t count) {
      for (std::size_t i = 0; i < count; ++i) f(at + i, v + i);
    });
  }

  /// The pocket opens into the lung on little of its surface, and what is there is denser than the
  /// gas: a wall, blurred.
  bool hasWall() const {
    const ImageGeometry& geometry = ct_.geometry;
    const std::array<std::size_t, 3> steps = {
        1, static_cast<std::size_t>(box_.size[0]),
        static_cast<std::size_t>(box_.size[0]) * static_cast<std::size_t>(box_.size[1])};
    Density wall;
    double open = 0.0;
    double closed = 0.0;
    forEachVoxel([&](std::size_t at, std::size_t v) {
      for (std::size_t axis = 0; axis < 3; ++axis) {
        const std::size_t next = at + steps[axis];
        if (next >= marks_.size() || marks_[next] == marks_[at]) continue;
        if (marks_[at] != PocketMark && marks_[next] != PocketMark) continue;
        const double mm2 = geometry.voxelMm3() / geometry.spacing[static_cast<int>(axis)];
        if (marks_[at] == 0 || marks_[next] == 0) {
          closed += mm2;
        } else {
          open += mm2;
          wall.add(ct_.voxels[v]);
        }
      }
    });
    return open == 0.0 ||
           (open < MostOpen * (open + closed) && wall.mean() > density_.mean() + WallContrastHu);
  }

  const CtImage& ct_;
  LabelImage& labels_;
  std::uint8_t label_;
  VoxelBox box_;
  std::vector<std::uint8_t> marks_;
  Density density_;
};

}  // namespace

double removeGasPockets(const CtImage& ct, LabelImage& labels, const Progress& progress) {
  const double voxelMl = millilitres(ct.geometry.voxelMm3());
  std::size_t removed = 0;
  std::array<VoxelBox, 2> boxes;
  const std::array<std::uint8_t, 2> lungs = {RightLabel, LeftLabel};
  int bottom = ct.geometry.size[2];
  int top = 0;
  for (std::size_t n = 0; n < 2; ++n) {
    boxes[n] = within(boxOf(labels, lungs[n], 0.0), labels.geometry);
    if (boxes[n].voxelCount() == 0) continue;
    bottom = std::min(bottom, boxes[n].low.z());
    top = std::max(top, boxes[n].low.z() + boxes[n].size[2]);
  }
  const int lowerThird = bottom + (top - bottom) / 3;
  for (std::size_t n = 0; n < 2; ++n) {
    VoxelBox box = boxes[n];
    box.size[2] = lowerThird - box.low.z();
    if (boxes[n].voxelCount() == 0 || box.size[2] <= 0) continue;
    progress.report(0.5 * static_cast<double>(n));
    const std::vector<std::uint8_t> thin = thinPlaces(ct, labels, lungs[n], box);
    const VoxelRuns runs = runsWhere(box.size, [&](std::size_t v) { return thin[v] != 0; });
    const VoxelComponents parts = components(runs, Connection::InVolume);
    const auto lungVoxels =
        static_cast<std::size_t>(std::count(labels.voxels.begin(), labels.voxels.end(), lungs[n]));
    for (std::size_t part = 0; part < parts.all.size(); ++part) {
      if (static_cast<double>(parts.all[part].voxels) * voxelMl < LeastMl) continue;
      progress.throwIfStopped();
      Pocket pocket(ct, labels, lungs[n], box, runs, parts, part);
      if (pocket.isUniform()) removed += pocket.remove(lungVoxels, progress);
    }
  }
  return static_cast<double>(removed) * voxelMl;
}

}  // namespace pneuma
