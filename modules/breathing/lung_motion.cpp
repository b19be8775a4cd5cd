#include "breathing/lung_motion.h"

#include <algorithm>
#include <cmath>
#include <string>

#include <Eigen/LU>

#include "core/error.h"
#include "core/parallel.h"

namespace pneuma {
namespace {

constexpr double SmallestMm = 50.0;
constexpr double LargestMm = 500.0;
constexpr double NeverFolds = 100.0;  // s, where no triangle ever turns over

std::string millilitres(double mm3) { return std::to_string(std::lround(mm3 / 1000.0)) + " ml"; }

/// The box of a lung, examined.
LungFrame frameOf(Side side, const TriangleMesh& wall) {
  const Box3 box = bounds(wall);
  const double least = wall.points.empty() ? 0.0 : box.sizes().minCoeff();
  const double most = wall.points.empty() ? 0.0 : box.sizes().maxCoeff();
  if (least < SmallestMm || most > LargestMm) {
    throw InvalidInput("a lung is " + std::to_string(most) + " mm long and " +
                       std::to_string(least) + " mm wide; lungs are 50 to 500 mm: are these mm?");
  }
  if (!(signedVolumeMm3(wall) > 0.0)) {
    throw InvalidInput("a lung's surface is inside out; repair it with 'pneuma repair'");
  }
  return {side, box};
}

FormField fieldOf(const LungMotionOptions& options, const LungFrame& frame, double gain) {
  return options.form ? FormField(*options.form, frame, std::cbrt(1.0 + gain) - 1.0)
                      : FormField(PresetField(options.preset, frame, gain));
}

}  // namespace

LungMotion::LungMotion(Side side, const TriangleMesh& wall, const LungMotionOptions& options,
                       double mostMm3)
    : side_(side), wall_(wall), ofWall_(wall.points.size()) {
  const LungFrame frame = frameOf(side, wall);
  if (options.model == MotionModel::Preset) {
    preset_ = fieldOf(options, frame, mostMm3 / signedVolumeMm3(wall) - 1.0);
    layer_.emplace(wall);
    if (options.posture != Posture::Supine || !options.stiffness.empty()) {
      const SurfaceMotion skin(wall_, frame, MotionModel::Continuous, options.stiffness);
      std::vector<Vec3> difference = skin.at(options.posture, mostMm3);
      const std::vector<Vec3> supine =
          SurfaceMotion(wall_, frame, MotionModel::Continuous).at(Posture::Supine, mostMm3);
      for (std::size_t n = 0; n < supine.size(); ++n) difference[n] -= supine[n];
      byForces_.emplace(intoTheLung(wall_, difference));
      forceShare_ = options.postureShare;
    }
  } else {
    const SurfaceMotion moved(wall_, frame, options.model, options.stiffness);
    byForces_.emplace(intoTheLung(wall_, moved.at(options.posture, mostMm3)));
  }
  parallelFor(ofWall_.size(), [&](std::size_t n) { ofWall_[n] = fieldAt(wall_.points[n]); });
  if (layer_) {
    thicknessMm_ = layer_->thicknessFor(ofWall_, mostMm3);
    for (std::size_t n = 0; n < ofWall_.size(); ++n) {
      ofWall_[n] += thicknessMm_ * layer_->normals()[n];
    }
  } else {
    // Between its centres the field is not quite the wall's.
    forceShare_ = multipleFor(wall_, ofWall_, mostMm3);
    for (Vec3& u : ofWall_) u *= forceShare_;
  }
  volume_ = volumePolynomial(wall_, ofWall_);
  maxScale_ = foldLimit(wall_, ofWall_).value_or(NeverFolds) / SafeTimes;
  minScale_ = foldLimit(wall_, ofWall_, -1.0).value_or(-NeverFolds) / SafeTimes;
}

Vec3 LungMotion::fieldAt(const Vec3& p) const {
  if (!byForces_) return preset_->at(p);
  const Vec3 byForces = forceShare_ * byForces_->at(p);
  return preset_ ? Vec3(preset_->at(p) + byForces) : byForces;
}

Vec3 LungMotion::at(const Vec3& p) const {
  return layer_ ? Vec3(fieldAt(p) + thicknessMm_ * layer_->at(p)) : fieldAt(p);
}

FieldAt LungMotion::withGradientAt(const Vec3& p) const {
  FieldAt field{fieldAt(p), Eigen::Matrix3d::Zero()};
  if (preset_) field.gradient += preset_->gradientAt(p);
  if (byForces_) field.gradient += forceShare_ * byForces_->gradientAt(p);
  if (!layer_) return field;
  const FieldAt layer = layer_->withGradientAt(p);
  field.value += thicknessMm_ * layer.value;
  field.gradient += thicknessMm_ * layer.gradient;
  return field;
}

double LungMotion::scaleFor(const VolumePolynomial& volume, double volumeMm3) const {
  const std::optional<double> scale = scaleForVolume(volume, volumeMm3);
  if (scale && *scale >= minScale_ && *scale <= maxScale_) return *scale;
  throw InvalidInput("at " + millilitres(volumeMm3) + " the " + std::string(name(side_)) +
                     " lung would fold; it does not from " + millilitres(volume.at(minScale_)) +
                     " to " + millilitres(volume.at(maxScale_)) + ": ask for a smaller breath");
}

namespace {

Eigen::Matrix3d differencesAt(const LungMotion& motion, const Vec3& p) {
  constexpr double HalfMm = 0.5;
  Eigen::Matrix3d gradient;
  for (int axis = 0; axis < 3; ++axis) {
    const Vec3 step = HalfMm * Vec3::Unit(axis);
    gradient.col(axis) = motion.at(p + step) - motion.at(p - step);
  }
  return gradient;
}

}  // namespace

double leastDeterminant(const LungMotion& motion, std::span<const Vec3> points, double s) {
  std::vector<double> found(points.size());
  parallelFor(points.size(), [&](std::size_t n) {
    found[n] = (Eigen::Matrix3d::Identity() + s * differencesAt(motion, points[n])).determinant();
  });
  return found.empty() ? 1.0 : *std::ranges::min_element(found);
}

}  // namespace pneuma
