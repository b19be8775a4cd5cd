#include "pipeline/detail/ct_scan.h"

#include <algorithm>
#include <cmath>

#include "core/joint_progress.h"
#include "core/parallel.h"
#include "core/random.h"

namespace pneuma {
namespace {

/// A box of voxels of one slice, or a part of a voxel, in voxel coordinates.
struct Block {
  Vec3 centre;
  Vec3 extent;
};

/// One slice of a body. A block of voxels that one shape fills is set at once, any other is divided
/// further, in the end below the size of a voxel.
class SlicePainter {
 public:
  SlicePainter(const CtBody& body, const ImageGeometry& geometry, int k)
      : body_(body),
        geometry_(geometry),
        steps_(geometry.steps()),
        products_((steps_.transpose() * steps_).cwiseAbs()),
        k_(k) {
    for (const CtShape& shape : body) {
      if (shape.label == Lobe::RightLung || shape.label == Lobe::LeftLung) lungs_.push_back(&shape);
    }
    hu_.resize(geometry.sliceCount());
    labels_.resize(geometry.sliceCount());
  }

  void paint() {
    ImageGeometry slice = geometry_;
    slice.size[2] = 1;
    slice.origin = world({0.0, 0.0, static_cast<double>(k_)});
    const Box3 box = slice.bounds();
    for (const CtShape& shape : body_) {
      if (shape.box.intersects(box)) candidates_.push_back(&shape);
    }
    paint(0, 0, geometry_.size[0], geometry_.size[1], 0);
  }

  std::vector<float> hu_;
  std::vector<std::uint8_t> labels_;

 private:
  /// A voxel is divided until its parts are no larger than this.
  static constexpr double PartMm = 1.26;

  /// Paints the voxels [i, i + width) x [j, j + height), where only the shapes from `first` to the
  /// end of candidates_ may be.
  void paint(int i, int j, int width, int height, std::size_t first) {
    const Block block{{i + (width - 1) / 2.0, j + (height - 1) / 2.0, static_cast<double>(k_)},
                      {static_cast<double>(width), static_cast<double>(height), 1.0}};
    const std::size_t mine = candidates_.size();
    const bool filled = narrow(block, first);
    if (filled || candidates_.size() == mine) {
      fill(i, j, width, height, filled ? candidates_[mine] : nullptr);
    } else if (width == 1 && height == 1) {
      const Vec3 centre = world(block.centre);
      const std::size_t at = voxel(i, j);
      hu_[at] = static_cast<float>(mean(block, mine));
      labels_[at] = label(topmost(centre, mine), centre);
    } else if (width >= height) {
      paint(i, j, width / 2, height, mine);
      paint(i + width / 2, j, width - width / 2, height, mine);
    } else {
      paint(i, j, width, height / 2, mine);
      paint(i, j + height / 2, width, height - height / 2, mine);
    }
    candidates_.resize(mine);
  }

  /// Adds those of the shapes from `first` on that reach into the block to the end of candidates_.
  /// @return whether the first of them fills it
  bool narrow(const Block& block, std::size_t first) {
    const Vec3 centre = world(block.centre);
    const double radius = radiusMm(block);
    const std::size_t end = candidates_.size();
    for (std::size_t c = first; c < end; ++c) {
      const CtShape& shape = *candidates_[c];
      if (shape.box.squaredExteriorDistance(centre) > radius * radius) continue;
      const double level = shape.level(centre);
      if (level < -radius) continue;
      candidates_.push_back(&shape);
      if (level > radius) return candidates_.size() == end + 1;
    }
    return false;
  }

  /// From the block's centre to its farthest corner, or more.
  double radiusMm(const Block& block) const {
    return 0.5 * std::sqrt(block.extent.dot(products_ * block.extent));
  }

  Vec3 world(const Vec3& voxel) const { return geometry_.origin + steps_ * voxel; }

  double mean(const Block& block, std::size_t first) {
    const Vec3 sidesMm = block.extent.cwiseProduct(geometry_.spacing);
    Eigen::Index longest = 0;
    const double longestMm = sidesMm.maxCoeff(&longest);
    if (longestMm <= PartMm) {
      return blended(world(block.centre), sidesMm.mean(), first);
    }
    double sum = 0.0;
    for (const double sign : {-1.0, 1.0}) {
      Block half = block;
      half.extent[longest] /= 2.0;
      half.centre[longest] += sign * half.extent[longest] / 2.0;
      const std::size_t mine = candidates_.size();
      const bool filled = narrow(half, first);
      if (filled || candidates_.size() == mine) {
        const CtShape* shape = filled ? candidates_[mine] : nullptr;
        sum += huOf(shape, world(half.centre));
      } else {
        sum += mean(half, mine);
      }
      candidates_.resize(mine);
    }
    return sum / 2.0;
  }

  /// HU about `p`, where each shape covers as much as its level says. @param widthMm of the place
  double blended(const Vec3& p, double widthMm, std::size_t first) const {
    double open = 1.0;
    double hu = 0.0;
    for (std::size_t c = first; c < candidates_.size() && open > 0.0; ++c) {
      const double covered = std::clamp(candidates_[c]->level(p) / widthMm + 0.5, 0.0, 1.0) * open;
      if (covered == 0.0) continue;
      hu += covered * huOf(candidates_[c], p);
      open -= covered;
    }
    return hu + open * AirHu;
  }

  const CtShape* topmost(const Vec3& p, std::size_t first) const {
    for (std::size_t c = first; c < candidates_.size(); ++c) {
      if (candidates_[c]->level(p) > 0.0) return candidates_[c];
    }
    return nullptr;
  }

  void fill(int i0, int j0, int width, int height, const CtShape* shape) {
    for (int j = j0; j < j0 + height; ++j) {
      for (int i = i0; i < i0 + width; ++i) {
        const Vec3 p =
            world({static_cast<double>(i), static_cast<double>(j), static_cast<double>(k_)});
        hu_[voxel(i, j)] = static_cast<float>(huOf(shape, p));
        labels_[voxel(i, j)] = label(shape, p);
      }
    }
  }

  static double huOf(const CtShape* shape, const Vec3& p) {
    if (shape == nullptr) return AirHu;
    return shape->huAt ? shape->huAt(p) : shape->hu;
  }

  std::uint8_t label(const CtShape* shape, const Vec3& p) const {
    if (shape == nullptr) return 0;
    if (!shape->labelledAsLung) return static_cast<std::uint8_t>(shape->label);
    for (const CtShape* lung : lungs_) {
      if (lung->level(p) > 0.0) return static_cast<std::uint8_t>(lung->label);
    }
    return 0;
  }

  std::size_t voxel(int i, int j) const { return geometry_.index(i, j, 0); }

  const CtBody& body_;
  const ImageGeometry& geometry_;
  Mat3 steps_;
  Mat3 products_;  ///< of the steps with each other, without signs
  int k_;
  std::vector<const CtShape*> lungs_;
  /// The shapes that may be in the block at hand stand at the end, below them those of the blocks
  /// that it is a part of.
  std::vector<const CtShape*> candidates_;
};

/// Weights of a Gaussian at -n .. n, sum 1.
std::vector<float> gaussian(double sigma) {
  const int reach = static_cast<int>(std::ceil(3.0 * sigma));
  std::vector<float> weights;
  double sum = 0.0;
  for (int i = -reach; i <= reach; ++i) {
    const double z = sigma > 0.0 ? i / sigma : 0.0;
    weights.push_back(static_cast<float>(std::exp(-z * z / 2.0)));
    sum += static_cast<double>(weights.back());
  }
  for (float& weight : weights) weight = static_cast<float>(static_cast<double>(weight) / sum);
  return weights;
}

double norm(const std::vector<float>& weights) {
  double sum = 0.0;
  for (const float weight : weights) sum += static_cast<double>(weight * weight);
  return std::sqrt(sum);
}

/// Convolves every row; what lies outside the slice is like its border.
void blurRows(std::vector<float>& slice, int width, int height, const std::vector<float>& weights) {
  const int reach = static_cast<int>(weights.size()) / 2;
  std::vector<float> row(static_cast<std::size_t>(width + 2 * reach));
  for (int j = 0; j < height; ++j) {
    float* values = slice.data() + static_cast<std::size_t>(j) * static_cast<std::size_t>(width);
    std::fill_n(row.begin(), reach, values[0]);
    std::copy_n(values, width, row.begin() + reach);
    std::fill_n(row.begin() + reach + width, reach, values[width - 1]);
    std::fill_n(values, width, 0.0F);
    for (std::size_t w = 0; w < weights.size(); ++w) {
      for (int i = 0; i < width; ++i) {
        values[i] += weights[w] * row[static_cast<std::size_t>(i) + w];
      }
    }
  }
}

void blurColumns(std::vector<float>& slice, int width, int height,
                 const std::vector<float>& weights) {
  const int reach = static_cast<int>(weights.size()) / 2;
  const std::vector<float> source = slice;
  std::fill(slice.begin(), slice.end(), 0.0F);
  const auto columns = static_cast<std::size_t>(width);
  for (int j = 0; j < height; ++j) {
    float* values = slice.data() + static_cast<std::size_t>(j) * columns;
    for (std::size_t w = 0; w < weights.size(); ++w) {
      const int from = std::clamp(j + static_cast<int>(w) - reach, 0, height - 1);
      const float* row = source.data() + static_cast<std::size_t>(from) * columns;
      for (std::size_t i = 0; i < columns; ++i) values[i] += weights[w] * row[i];
    }
  }
}

/// Nearly normal, mean 0 and standard deviation 1: the sum of four uniform numbers.
float whiteNoise(Random& random) {
  const std::uint64_t bits = random.bits();
  const double sum = static_cast<double>((bits & 0xffff) + ((bits >> 16) & 0xffff) +
                                         ((bits >> 32) & 0xffff) + (bits >> 48));
  return static_cast<float>((sum / 65535.0 - 2.0) * std::sqrt(3.0));
}

}  // namespace

ScannedBody scanned(const CtBody& body, const ImageGeometry& geometry, const ScanSettings& settings,
                    const Progress& progress) {
  constexpr double LowestHu = -1024.0;
  constexpr double HighestHu = 3071.0;
  const std::vector<float> alongI = gaussian(settings.blurMm / geometry.spacing.x());
  const std::vector<float> alongJ = gaussian(settings.blurMm / geometry.spacing.y());
  // So strong that the blur leaves what was asked for.
  const double whiteHu = settings.noiseHu / (norm(alongI) * norm(alongJ));

  ScannedBody result;
  result.image.geometry = result.labels.geometry = geometry;
  result.image.voxels.resize(geometry.voxelCount());
  result.labels.voxels.resize(geometry.voxelCount());
  const auto slices = static_cast<std::size_t>(geometry.size[2]);
  JointProgress joint(progress, slices);
  parallelFor(slices, [&](std::size_t k) {
    SlicePainter painter(body, geometry, static_cast<int>(k));
    painter.paint();
    std::vector<float>& hu = painter.hu_;
    Random random(settings.seed + 0x9e3779b97f4a7c15U * (k + 1));
    for (float& value : hu) value += static_cast<float>(whiteHu) * whiteNoise(random);
    blurRows(hu, geometry.size[0], geometry.size[1], alongI);
    blurColumns(hu, geometry.size[0], geometry.size[1], alongJ);
    const std::size_t first = geometry.index(0, 0, static_cast<int>(k));
    std::ranges::copy(painter.labels_,
                      result.labels.voxels.begin() + static_cast<std::ptrdiff_t>(first));
    std::size_t at = 0;
    for (int j = 0; j < geometry.size[1]; ++j) {
      for (int i = 0; i < geometry.size[0]; ++i, ++at) {
        const double right = (i - (geometry.size[0] - 1) / 2.0) * geometry.spacing.x();
        const double down = (j - (geometry.size[1] - 1) / 2.0) * geometry.spacing.y();
        const bool seen = std::hypot(right, down) <= settings.circleMm;
        const double rounded =
            std::clamp(std::round(static_cast<double>(hu[at])), LowestHu, HighestHu);
        result.image.voxels[first + at] = seen ? static_cast<std::int16_t>(rounded) : PaddingHu;
      }
    }
    joint.task(k).report(1.0);
  });
  return result;
}

}  // namespace pneuma
