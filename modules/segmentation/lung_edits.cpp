#include "segmentation/lung_edits.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <limits>
#include <utility>

#include "core/error.h"
#include "core/parallel.h"
#include "core/units.h"
#include "segmentation/inner_air.h"
#include "segmentation/lung_labels.h"
#include "segmentation/voxel_box.h"

namespace pneuma {
namespace {

constexpr double EmptyAirHu = -950.0;     ///< a voxel's surroundings, if it is no lung
constexpr double EmptyRegionHu = -970.0;  ///< a whole region likewise
constexpr double NearestLungMm = 60.0;
constexpr double Rounding = 1e-9;  ///< of a radius, mm: voxels just on it are covered
constexpr std::size_t TellEvery = std::size_t{1} << 20;

std::string placeOf(const Vec3& p) {
  std::array<char, 96> text{};
  std::snprintf(text.data(), text.size(), "(%.1f, %.1f, %.1f) mm", p.x(), p.y(), p.z());
  return text.data();
}

bool isInside(const ImageGeometry& geometry, const Vec3& point) {
  const Vec3 voxel = geometry.voxelFromWorld(point);
  for (int axis = 0; axis < 3; ++axis) {
    const int size = geometry.size[static_cast<std::size_t>(axis)];
    if (!(voxel[axis] >= -0.5 && voxel[axis] <= size - 0.5)) return false;
  }
  return true;
}

Eigen::Vector3i voxelAt(const ImageGeometry& geometry, const Vec3& point) {
  const Vec3 voxel = geometry.voxelFromWorld(point);
  Eigen::Vector3i nearest;
  for (int axis = 0; axis < 3; ++axis) {
    nearest[axis] = std::clamp(static_cast<int>(std::floor(voxel[axis] + 0.5)), 0,
                               geometry.size[static_cast<std::size_t>(axis)] - 1);
  }
  return nearest;
}

std::uint8_t labelOf(Side side) { return side == Side::Right ? RightLabel : LeftLabel; }

/// The LPS axis across a disc; -1 for a ball.
int discAxis(BrushShape shape) {
  switch (shape) {
    case BrushShape::AxialDisc:
      return 2;
    case BrushShape::CoronalDisc:
      return 1;
    case BrushShape::SagittalDisc:
      return 0;
    case BrushShape::Ball:
      break;
  }
  return -1;
}

/// What a brush covers between two points of its stroke.
class Stroke {
 public:
  Stroke(const LungEdit& edit, const Vec3& from, const Vec3& to, const ImageGeometry& geometry)
      : from_(from), along_(to - from), axis_(discAxis(edit.shape)), radiusMm_(edit.radiusMm) {
    Vec3 flat = along_;
    if (axis_ >= 0) {
      flat[axis_] = 0.0;
      halfMm_ = 0.5 * geometry.steps().row(axis_).cwiseAbs().maxCoeff();
    }
    length2_ = flat.squaredNorm();
  }

  bool covers(const Vec3& p) const {
    Vec3 offset = p - from_;
    double dot = offset.dot(along_);
    if (axis_ >= 0) dot -= offset[axis_] * along_[axis_];
    const double t = length2_ > 0.0 ? std::clamp(dot / length2_, 0.0, 1.0) : 0.0;
    offset -= t * along_;
    if (axis_ >= 0) {
      if (offset[axis_] < -halfMm_ || offset[axis_] >= halfMm_) return false;
      offset[axis_] = 0.0;
    }
    return offset.squaredNorm() <= (radiusMm_ + Rounding) * (radiusMm_ + Rounding);
  }

  /// All that it may cover of an image.
  VoxelBox box(const ImageGeometry& geometry) const {
    const Mat3 voxelFromMm = geometry.steps().inverse();
    const Vec3 a = geometry.voxelFromWorld(from_);
    const Vec3 b = geometry.voxelFromWorld(from_ + along_);
    Eigen::Vector3i low;
    Eigen::Vector3i high;
    for (int axis = 0; axis < 3; ++axis) {
      const double reach = std::max(radiusMm_, halfMm_) * voxelFromMm.row(axis).norm();
      const auto last = static_cast<double>(geometry.size[static_cast<std::size_t>(axis)]);
      const auto limited = [&](double at) { return std::clamp(at, -1.0, last); };
      low[axis] = static_cast<int>(std::floor(limited(std::min(a[axis], b[axis]) - reach)));
      high[axis] = static_cast<int>(std::ceil(limited(std::max(a[axis], b[axis]) + reach)));
    }
    return within(boxAround(low, high, Eigen::Vector3i::Zero()), geometry);
  }

 private:
  Vec3 from_;
  Vec3 along_;
  int axis_;
  double radiusMm_;
  double halfMm_ = 0.0;   ///< of a disc's thickness
  double length2_ = 0.0;  ///< in the disc's plane
};

/// @return how many voxels were changed
std::size_t brush(const CtImage& ct, const LungEdit& edit, const Stroke& stroke,
                  LabelImage& labels) {
  const ImageGeometry& geometry = labels.geometry;
  const VoxelBox box = stroke.box(geometry);
  const bool paints = edit.tool == LungTool::Paint;
  const std::uint8_t to = paints ? labelOf(edit.side) : std::uint8_t{0};
  const auto changes = [&](std::uint8_t label) {
    if (label == to || (label != 0 && label != RightLabel && label != LeftLabel)) return false;
    return paints || edit.side == Side::None || label == labelOf(edit.side);
  };
  const Mat3 steps = geometry.steps();
  std::vector<std::size_t> changed(static_cast<std::size_t>(box.size[2]), 0);
  parallelFor(changed.size(), [&](std::size_t slice) {
    const int k = box.low.z() + static_cast<int>(slice);
    for (int j = box.low.y(); j < box.low.y() + box.size[1]; ++j) {
      // The same place for every box, so that a stroke in parts is that stroke.
      const Vec3 row = geometry.origin + j * steps.col(1) + k * steps.col(2);
      std::size_t v = geometry.index(box.low.x(), j, k);
      for (int i = box.low.x(); i < box.low.x() + box.size[0]; ++i, ++v) {
        if (!changes(labels.voxels[v])) continue;
        if (edit.belowHu && ct.voxels[v] >= *edit.belowHu) continue;
        if (!stroke.covers(row + i * steps.col(0))) continue;
        labels.voxels[v] = to;
        ++changed[slice];
      }
    }
  });
  std::size_t sum = 0;
  for (const std::size_t count : changed) sum += count;
  return sum;
}

/// Grows from a seed. What it took is marked at once, and taken back if it may not be.
class SeedGrowth {
 public:
  SeedGrowth(const CtImage& ct, const LungEdit& edit, LabelImage& labels)
      : ct_(ct),
        labels_(labels),
        geometry_(labels.geometry),
        label_(labelOf(edit.side)),
        belowHu_(edit.belowHu.value_or(SeedBelowHu)),
        upAxis_(patientAxes(geometry_).from[2]),
        most_(static_cast<std::size_t>(cubicMillimetres(MostSeedMl) / geometry_.voxelMm3())) {}

  std::size_t grow(const Vec3& seed, const Progress& progress) {
    requireSeed(seed);
    const Eigen::Vector3i at = voxelAt(geometry_, seed);
    try {
      take(at);
      for (std::size_t next = 0; next < taken_.size(); ++next) {
        if (next % TellEvery == 0) progress.throwIfStopped();
        const Eigen::Vector3i voxel = taken_[next];  // taking more moves them
        spread(voxel);
      }
      if (sumHu_ < EmptyRegionHu * static_cast<double>(taken_.size())) {
        refuse(taken_.front(),
               "is as empty as air outside of lungs, like gas of the stomach or an "
               "airway");
      }
    } catch (...) {
      for (const Eigen::Vector3i& voxel : taken_) {
        labels_.at(voxel.x(), voxel.y(), voxel.z()) = 0;
      }
      throw;
    }
    return taken_.size();
  }

 private:
  void requireSeed(const Vec3& seed) const {
    const Eigen::Vector3i at = voxelAt(geometry_, seed);
    const std::uint8_t label = labels_.at(at.x(), at.y(), at.z());
    const int hu = ct_.at(at.x(), at.y(), at.z());
    if (label != 0) {
      throw InvalidInput(
          "the seed at " + placeOf(seed) + " lies in the " +
          (label == AirwayLabel ? "airways" : std::string(longName(static_cast<Lobe>(label)))) +
          " already; put it where a lung is missing");
    }
    if (hu < belowHu_ && hu >= PaddingBelowHu) return;
    throw InvalidInput("the seed at " + placeOf(seed) + " has " + std::to_string(hu) +
                       " HU, which is not less dense than " +
                       std::to_string(static_cast<int>(std::lround(belowHu_))) +
                       " HU; put it into air of the lung, raise the limit, or paint");
  }

  [[noreturn]] void refuse(const Eigen::Vector3i& voxel, const std::string& what) const {
    throw InvalidInput("what hangs together with the seed " + what + " (near " +
                       placeOf(geometry_.worldFromVoxel(voxel.cast<double>())) +
                       "); lower the limit, or paint it");
  }

  bool mayTake(const Eigen::Vector3i& voxel) const {
    const int hu = ct_.at(voxel.x(), voxel.y(), voxel.z());
    return labels_.at(voxel.x(), voxel.y(), voxel.z()) == 0 && hu < belowHu_ &&
           hu >= PaddingBelowHu;
  }

  void take(const Eigen::Vector3i& voxel) {
    labels_.at(voxel.x(), voxel.y(), voxel.z()) = label_;
    sumHu_ += ct_.at(voxel.x(), voxel.y(), voxel.z());
    taken_.push_back(voxel);
    if (taken_.size() > most_) {
      refuse(voxel, "is more than " + std::to_string(static_cast<int>(MostSeedMl)) + " ml");
    }
  }

  void spread(const Eigen::Vector3i& voxel) {
    bool besideAirway = false;
    bool atBorder = false;
    for (int axis = 0; axis < 3; ++axis) {
      for (const int step : {-1, 1}) {
        Eigen::Vector3i next = voxel;
        next[axis] += step;
        if (next[axis] < 0 || next[axis] >= geometry_.size[static_cast<std::size_t>(axis)]) {
          // Lungs may go on above and below the slices.
          atBorder |= axis != upAxis_;
        } else if (labels_.at(next.x(), next.y(), next.z()) == AirwayLabel) {
          besideAirway = true;
        } else if (mayTake(next)) {
          take(next);
        }
      }
    }
    if (atBorder && isEmptyAround(voxel)) refuse(voxel, "leaks out of the body");
    if (besideAirway && isEmptyAround(voxel)) refuse(voxel, "leaks into the airways");
  }

  /// Of a voxel and those around it, so that noise does not decide.
  bool isEmptyAround(const Eigen::Vector3i& voxel) const {
    double sum = 0.0;
    int count = 0;
    for (int k = voxel.z() - 1; k <= voxel.z() + 1; ++k) {
      for (int j = voxel.y() - 1; j <= voxel.y() + 1; ++j) {
        for (int i = voxel.x() - 1; i <= voxel.x() + 1; ++i) {
          const auto& [width, height, depth] = geometry_.size;
          if (i < 0 || j < 0 || k < 0 || i >= width || j >= height || k >= depth) continue;
          sum += ct_.at(i, j, k);
          ++count;
        }
      }
    }
    return sum < EmptyAirHu * count;
  }

  const CtImage& ct_;
  LabelImage& labels_;
  const ImageGeometry& geometry_;
  std::uint8_t label_;
  double belowHu_;
  int upAxis_;
  std::size_t most_;  ///< voxels
  double sumHu_ = 0.0;
  std::vector<Eigen::Vector3i> taken_;  ///< in the order they were found
};

}  // namespace

std::string problemOf(const LungEdit& edit, const ImageGeometry& geometry) {
  if (edit.points.empty()) return "has no points";
  if (edit.tool == LungTool::Seed && edit.points.size() != 1) {
    return "has " + std::to_string(edit.points.size()) + " points; a seed is one";
  }
  if (edit.tool != LungTool::Erase && edit.side == Side::None) {
    return "does not say which lung; \"lung\" is right or left";
  }
  if (edit.tool != LungTool::Seed &&
      !(edit.radiusMm >= LeastBrushMm && edit.radiusMm <= MostBrushMm)) {
    return "has a radius that is not from 0.5 to 100 mm";
  }
  if (edit.belowHu && !std::isfinite(*edit.belowHu)) return "has a limit that is no number";
  for (const Vec3& point : edit.points) {
    if (!point.allFinite()) return "has a point that is no place";
    if (!isInside(geometry, point)) {
      return "has a point at " + placeOf(point) + ", which is outside the image; points are LPS";
    }
  }
  return {};
}

bool sameVoxels(const ImageGeometry& a, const ImageGeometry& b) {
  constexpr double Tolerance = 0.01;
  if (a.size != b.size) return false;
  for (int corner = 0; corner < 8; ++corner) {
    Vec3 voxel;
    for (int axis = 0; axis < 3; ++axis) {
      voxel[axis] = (corner >> axis & 1) * (a.size[static_cast<std::size_t>(axis)] - 1);
    }
    if (!((a.voxelFromWorld(b.worldFromVoxel(voxel)) - voxel).cwiseAbs().maxCoeff() < Tolerance))
      return false;
  }
  return true;
}

std::size_t applyEdit(const CtImage& ct, const LungEdit& edit, LabelImage& labels,
                      const Progress& progress) {
  if (edit.tool == LungTool::Seed) {
    return SeedGrowth(ct, edit, labels).grow(edit.points.front(), progress);
  }
  std::size_t changed = 0;
  for (std::size_t i = 0; i < edit.points.size(); ++i) {
    progress.throwIfStopped();
    const Vec3& from = edit.points[i > 0 ? i - 1 : 0];
    changed += brush(ct, edit, Stroke(edit, from, edit.points[i], labels.geometry), labels);
  }
  return changed;
}

LabelImage editedLabels(const CtImage& ct, const LabelImage& labels,
                        std::span<const LungEdit> edits, const Progress& progress) {
  if (!sameVoxels(ct.geometry, labels.geometry)) {
    throw InvalidInput(
        "the labels of the lungs have other voxels than the CT; find the lungs in "
        "the CT first");
  }
  const auto nameOf = [](std::size_t i) { return "edit " + std::to_string(i + 1) + " "; };
  for (std::size_t i = 0; i < edits.size(); ++i) {
    const std::string problem = problemOf(edits[i], labels.geometry);
    if (!problem.empty()) throw InvalidInput(nameOf(i) + problem);
  }
  LabelImage edited = labels;
  for (std::size_t i = 0; i < edits.size(); ++i) {
    progress.report(static_cast<double>(i) / static_cast<double>(edits.size()));
    try {
      applyEdit(ct, edits[i], edited, progress);
    } catch (const InvalidInput& error) {
      if (edits.size() == 1) throw;
      throw InvalidInput(nameOf(i) + "cannot be done: " + error.what());
    }
  }
  return edited;
}

Side nearestLung(const LabelImage& labels, const Vec3& point) {
  const ImageGeometry& geometry = labels.geometry;
  for (double reach : {0.0, 10.0, NearestLungMm}) {
    LungEdit around;
    around.radiusMm = reach;
    const VoxelBox box = Stroke(around, point, point, geometry).box(geometry);
    double least = reach * reach + Rounding;
    Side nearest = Side::None;
    for (int k = box.low.z(); k < box.low.z() + box.size[2]; ++k) {
      for (int j = box.low.y(); j < box.low.y() + box.size[1]; ++j) {
        for (int i = box.low.x(); i < box.low.x() + box.size[0]; ++i) {
          const Side side = pneuma::side(static_cast<Lobe>(labels.at(i, j, k)));
          if (side == Side::None) continue;
          if (reach == 0.0) {
            if (voxelAt(geometry, point) == Eigen::Vector3i(i, j, k)) return side;
            continue;
          }
          const double away = (geometry.worldFromVoxel(Vec3(i, j, k)) - point).squaredNorm();
          if (away >= least) continue;
          least = away;
          nearest = side;
        }
      }
    }
    if (nearest != Side::None) return nearest;
  }
  return Side::None;
}

}  // namespace pneuma
