#include "segmentation/fissure_sheetness.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include <Eigen/Eigenvalues>
#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>

#include "core/error.h"
#include "core/joint_progress.h"
#include "core/parallel.h"
#include "segmentation/closing.h"

namespace pneuma {
namespace {

constexpr double SigmaMm = 1.0;
constexpr double LeastSigmaVoxels = 0.5;
constexpr double Reach = 3.5;  ///< of the kernels, in sigmas
constexpr float DarkHu = -850.0F;
constexpr float LowestHu = -1000.0F;
constexpr float HighestHu = -300.0F;
constexpr double NearOutsideMm = 2.0;
constexpr float LeastCurvature = 2.0F;  ///< HU / mm^2, of all directions together

/// Smoothing, first and second derivative along one axis, per mm: what they are for a parabola is
/// exact, although a voxel may be as wide as the Gaussian.
struct Kernels {
  int radius = 0;
  std::vector<float> smooth;
  std::vector<float> first;
  std::vector<float> second;
};

Kernels kernelsFor(double spacing) {
  const double sigma = std::max(SigmaMm, LeastSigmaVoxels * spacing);
  Kernels kernels;
  kernels.radius = static_cast<int>(std::ceil(Reach * sigma / spacing));
  const auto count = static_cast<std::size_t>(2 * kernels.radius + 1);
  std::vector<double> x(count);
  std::vector<double> g(count);
  double sum = 0.0;
  double spread = 0.0;
  for (std::size_t t = 0; t < count; ++t) {
    x[t] = spacing * (static_cast<double>(t) - kernels.radius);
    g[t] = std::exp(-0.5 * x[t] * x[t] / (sigma * sigma));
    sum += g[t];
    spread += g[t] * x[t] * x[t];
  }
  spread /= sum;
  double fourth = 0.0;
  for (std::size_t t = 0; t < count; ++t) {
    fourth += g[t] / sum * x[t] * x[t] * (x[t] * x[t] - spread);
  }
  for (std::size_t t = 0; t < count; ++t) {
    const double weight = g[t] / sum;
    kernels.smooth.push_back(static_cast<float>(weight));
    kernels.first.push_back(static_cast<float>(weight * x[t] / spread));
    kernels.second.push_back(static_cast<float>(2.0 * weight * (x[t] * x[t] - spread) / fourth));
  }
  return kernels;
}

/// One lung's sheetness, slice by slice.
class SheetWork {
 public:
  SheetWork(const CtImage& ct, const LabelImage& labels, std::uint8_t label, const VoxelBox& box,
            SheetnessImage& result)
      : ct_(ct), labels_(labels), label_(label), box_(box), result_(result) {
    const ImageGeometry& geometry = ct.geometry;
    for (int axis = 0; axis < 3; ++axis) {
      kernels_[static_cast<std::size_t>(axis)] = kernelsFor(geometry.spacing[axis]);
    }
    mmFromAxes_ = geometry.direction.inverse().cast<float>();
    for (int x = -1; x <= 1; ++x) {
      for (int y = -1; y <= 1; ++y) {
        for (int z = -1; z <= 1; ++z) {
          const Vec3 way = Vec3(x, y, z).stableNormalized() * NearOutsideMm;
          const Eigen::Array3d voxels = way.array() / geometry.spacing.array();
          around_.emplace_back(voxels.round().cast<int>());
        }
      }
    }
  }

  void slice(int k) {
    const cv::Rect part = lungIn(k);
    if (part.empty()) return;
    const cv::Rect wide = widened(part);
    std::array<cv::Mat, 3> along;  // smoothed, first, second derivative along k
    derive(k, wide, along);
    const auto& [ki, kj, kk] = kernels_;
    const auto plane = [&](const cv::Mat& from, const std::vector<float>& alongI,
                           const std::vector<float>& alongJ) {
      cv::Mat to;
      cv::sepFilter2D(from, to, CV_32F, alongI, alongJ, {-1, -1}, 0.0, cv::BORDER_REPLICATE);
      return to;
    };
    const cv::Mat ii = plane(along[0], ki.second, kj.smooth);
    const cv::Mat ij = plane(along[0], ki.first, kj.first);
    const cv::Mat jj = plane(along[0], ki.smooth, kj.second);
    const cv::Mat ik = plane(along[1], ki.first, kj.smooth);
    const cv::Mat jk = plane(along[1], ki.smooth, kj.first);
    const cv::Mat kk2 = plane(along[2], ki.smooth, kj.smooth);
    for (int j = part.y; j < part.y + part.height; ++j) {
      for (int i = part.x; i < part.x + part.width; ++i) {
        if (!isInside(i, j, k) || isNearOutside(i, j, k)) continue;
        const int row = j - wide.y;
        const int column = i - wide.x;
        const auto at = [&](const cv::Mat& from) { return from.at<float>(row, column); };
        Eigen::Matrix3f curvature;
        curvature << at(ii), at(ij), at(ik), at(ij), at(jj), at(jk), at(ik), at(jk), at(kk2);
        result_.at(i - box_.low.x(), j - box_.low.y(), k - box_.low.z()) = sheetOf(curvature);
      }
    }
  }

 private:
  bool isInside(int i, int j, int k) const { return labels_.at(i, j, k) == label_; }

  bool isNearOutside(int i, int j, int k) const {
    const auto& size = labels_.geometry.size;
    return std::ranges::any_of(around_, [&](const Eigen::Vector3i& step) {
      const int a = i + step.x();
      const int b = j + step.y();
      const int c = std::clamp(k + step.z(), 0, size[2] - 1);  // the lung may go on there
      return a < 0 || b < 0 || a >= size[0] || b >= size[1] || !isInside(a, b, c);
    });
  }

  /// The rectangle that the lung takes in a slice.
  cv::Rect lungIn(int k) const {
    int left = box_.low.x() + box_.size[0];
    int right = -1;
    int top = -1;
    int bottom = -1;
    for (int j = box_.low.y(); j < box_.low.y() + box_.size[1]; ++j) {
      const std::uint8_t* row = &labels_.at(0, j, k);
      for (int i = box_.low.x(); i < box_.low.x() + box_.size[0]; ++i) {
        if (row[i] != label_) continue;
        left = std::min(left, i);
        right = std::max(right, i);
        if (top < 0) top = j;
        bottom = j;
      }
    }
    return right < 0 ? cv::Rect() : cv::Rect(left, top, right - left + 1, bottom - top + 1);
  }

  cv::Rect widened(const cv::Rect& part) const {
    const int i = kernels_[0].radius;
    const int j = kernels_[1].radius;
    const auto& size = ct_.geometry.size;
    return cv::Rect(part.x - i, part.y - j, part.width + 2 * i, part.height + 2 * j) &
           cv::Rect(0, 0, size[0], size[1]);
  }

  void derive(int k, const cv::Rect& wide, std::array<cv::Mat, 3>& along) const {
    for (cv::Mat& image : along) image = cv::Mat::zeros(wide.size(), CV_32F);
    const Kernels& kernels = kernels_[2];
    for (int t = -kernels.radius; t <= kernels.radius; ++t) {
      const int from = std::clamp(k + t, 0, ct_.geometry.size[2] - 1);
      const auto tap = static_cast<std::size_t>(t + kernels.radius);
      for (int j = 0; j < wide.height; ++j) {
        const std::int16_t* hu = &ct_.at(wide.x, wide.y + j, from);
        const std::uint8_t* label = &labels_.at(wide.x, wide.y + j, from);
        float* smooth = along[0].ptr<float>(j);
        float* first = along[1].ptr<float>(j);
        float* second = along[2].ptr<float>(j);
        for (int i = 0; i < wide.width; ++i) {
          const float value = label[i] == label_
                                  ? std::clamp(static_cast<float>(hu[i]), LowestHu, HighestHu)
                                  : DarkHu;
          smooth[i] += kernels.smooth[tap] * value;
          first[i] += kernels.first[tap] * value;
          second[i] += kernels.second[tap] * value;
        }
      }
    }
  }

  SheetVoxel sheetOf(const Eigen::Matrix3f& alongAxes) const {
    SheetVoxel voxel;
    voxel.strength = 0;
    // What curves upwards on the whole is no bright sheet, or a faint one.
    if (alongAxes.trace() > -LeastCurvature) return voxel;
    const Eigen::Matrix3f curvature = mmFromAxes_.transpose() * alongAxes * mmFromAxes_;
    Eigen::SelfAdjointEigenSolver<Eigen::Matrix3f> solver;
    solver.computeDirect(curvature);
    const Eigen::Vector3f& values = solver.eigenvalues();  // ascending
    const float third = -values[0];
    const float second = std::max(std::abs(values[1]), std::abs(values[2]));
    if (third <= second) return voxel;
    const float strength = third * (third - second) / (third + second);
    voxel.strength = static_cast<std::uint8_t>(
        std::min(std::lround(strength / SheetVoxel::Step), long{SheetVoxel::NotMeasured} - 1));
    if (voxel.strength == 0) return voxel;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      voxel.normal[axis] = static_cast<std::int8_t>(
          std::lround(127.0F * solver.eigenvectors()(static_cast<Eigen::Index>(axis), 0)));
    }
    return voxel;
  }

  const CtImage& ct_;
  const LabelImage& labels_;
  std::uint8_t label_;
  VoxelBox box_;
  SheetnessImage& result_;
  std::array<Kernels, 3> kernels_;
  Eigen::Matrix3f mmFromAxes_;
  std::vector<Eigen::Vector3i> around_;
};

}  // namespace

SheetnessImage fissureSheetness(const CtImage& ct, const LabelImage& labels, std::uint8_t label,
                                const Progress& progress) {
  const VoxelBox box = within(boxOf(labels, label, 0.0), labels.geometry);
  if (box.voxelCount() == 0) {
    throw InvalidInput("no voxel has label " + std::to_string(int{label}) +
                       "; there is no lung to look for fissures in");
  }
  SheetnessImage result;
  result.geometry = ct.geometry;
  result.geometry.size = box.size;
  result.geometry.origin = ct.geometry.worldFromVoxel(box.low.cast<double>());
  result.voxels.resize(box.voxelCount());
  SheetWork work(ct, labels, label, box, result);
  JointProgress joint(progress, static_cast<std::size_t>(box.size[2]));
  parallelFor(static_cast<std::size_t>(box.size[2]), [&](std::size_t k) {
    joint.task(k).throwIfStopped();
    work.slice(box.low.z() + static_cast<int>(k));
    joint.task(k).report(1.0);
  });
  return result;
}

SheetSampler::SheetSampler(const SheetnessImage& sheets)
    : sheets_(sheets), voxelFromMm_(sheets.geometry.steps().inverse()) {}

double SheetSampler::strength(const Vec3& p, const Vec3& normal, double cosine) const {
  const Vec3 at = voxelFromMm_ * (p - sheets_.geometry.origin);
  const Eigen::Vector3i low = at.array().floor().cast<int>();
  const auto& size = sheets_.geometry.size;
  if (low.minCoeff() < 0 || low.x() + 1 >= size[0] || low.y() + 1 >= size[1] ||
      low.z() + 1 >= size[2]) {
    return 0.0;
  }
  const Vec3 share = at - low.cast<double>();
  double sum = 0.0;
  for (int corner = 0; corner < 8; ++corner) {
    const Eigen::Vector3i step(corner & 1, (corner >> 1) & 1, corner >> 2);
    const SheetVoxel& voxel =
        sheets_.at(low.x() + step.x(), low.y() + step.y(), low.z() + step.z());
    if (voxel.strength == 0 || voxel.strength == SheetVoxel::NotMeasured) continue;
    const Vec3 way = Vec3(voxel.normal[0], voxel.normal[1], voxel.normal[2]);
    if (std::abs(way.dot(normal)) < cosine * way.norm()) continue;
    double weight = 1.0;
    for (int axis = 0; axis < 3; ++axis)
      weight *= step[axis] == 1 ? share[axis] : 1.0 - share[axis];
    sum += weight * voxel.strength;
  }
  return sum * SheetVoxel::Step;
}

bool SheetSampler::isMeasured(const Vec3& p) const {
  const Vec3 at = voxelFromMm_ * (p - sheets_.geometry.origin);
  const Eigen::Vector3i nearest = at.array().round().cast<int>();
  const auto& size = sheets_.geometry.size;
  return nearest.minCoeff() >= 0 && nearest.x() < size[0] && nearest.y() < size[1] &&
         nearest.z() < size[2] &&
         sheets_.at(nearest.x(), nearest.y(), nearest.z()).strength != SheetVoxel::NotMeasured;
}

}  // namespace pneuma
