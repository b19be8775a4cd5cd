#include "io/ct_corrections.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <mutex>

#include "core/error.h"
#include "core/memory.h"
#include "core/parallel.h"
#include "core/units.h"

namespace pneuma {
namespace {

constexpr double WholeShift = 1e-6;  // pixels; a shift so near a whole one needs no interpolation

/// Progress of tasks that end in any order.
class Counted {
 public:
  Counted(const Progress& progress, std::size_t all) : progress_(progress), all_(all) {}

  void next() {
    const std::lock_guard lock(mutex_);
    progress_.report(static_cast<double>(++done_) / static_cast<double>(all_));
  }

 private:
  const Progress& progress_;
  std::mutex mutex_;
  std::size_t done_ = 0;
  std::size_t all_;
};

std::int16_t rounded(double hu) {
  return static_cast<std::int16_t>(std::clamp(std::round(hu), -32768.0, 32767.0));
}

/// Linear between two voxels; where one is padding, the nearer one.
std::int16_t between(std::int16_t a, std::int16_t b, double t) {
  if (a == PaddingHu || b == PaddingHu) return t < 0.5 ? a : b;
  return rounded(a + (b - a) * t);
}

/// The row as if it had been sampled `shift` pixels further: result[i] = row(i + shift).
/// `row(i)` gives padding outside.
template <class Row>
std::int16_t shiftedPixel(const Row& row, int whole, double t) {
  if (t == 0.0) return row(whole);
  const std::array<std::int16_t, 4> v = {row(whole - 1), row(whole), row(whole + 1),
                                         row(whole + 2)};
  if (std::ranges::find(v, PaddingHu) != v.end()) return between(v[1], v[2], t);
  // Keys 1981, a = -1/2: exact for parabolas, keeps the noise better than linear does.
  const double t2 = t * t;
  const double t3 = t2 * t;
  const double hu = v[0] * (-0.5 * t3 + t2 - 0.5 * t) + v[1] * (1.5 * t3 - 2.5 * t2 + 1.0) +
                    v[2] * (-1.5 * t3 + 2.0 * t2 + 0.5 * t) + v[3] * (0.5 * t3 - 0.5 * t2);
  const auto [low, high] = std::ranges::minmax(v);
  return std::clamp(rounded(hu), low, high);
}

struct Split {
  int whole = 0;
  double rest = 0.0;
};

Split split(double shift) {
  const double nearest = std::round(shift);
  if (std::abs(shift - nearest) < WholeShift) return {static_cast<int>(nearest), 0.0};
  const double floor = std::floor(shift);
  return {static_cast<int>(floor), shift - floor};
}

/// One sum of voxels of a line along an axis.
struct Tap {
  int first = 0;
  std::vector<double> weights;  ///< sum to 1
};

/// For every new position the voxels around it and their weights. `at` ascending.
std::vector<Tap> tapsOf(const std::vector<double>& at, const std::vector<double>& wanted,
                        double side) {
  const int n = static_cast<int>(at.size());
  const double mean = n > 1 ? (at.back() - at.front()) / (n - 1) : side;
  std::vector<Tap> taps;
  for (const double p : wanted) {
    Tap tap;
    if (side <= mean * (1.0 + 1e-9)) {
      const auto above = std::ranges::upper_bound(at, p);
      const int i = std::clamp(static_cast<int>(above - at.begin()) - 1, 0, std::max(0, n - 2));
      tap.first = i;
      const double step =
          n > 1 ? at[static_cast<std::size_t>(i) + 1] - at[static_cast<std::size_t>(i)] : 1.0;
      const double t = std::clamp((p - at[static_cast<std::size_t>(i)]) / step, 0.0, 1.0);
      tap.weights = n > 1 ? std::vector<double>{1.0 - t, t} : std::vector<double>{1.0};
    } else {
      double sum = 0.0;
      int last = -1;
      for (int i = 0; i < n; ++i) {
        const auto k = static_cast<std::size_t>(i);
        const double low = i == 0 ? mean : at[k] - at[k - 1];
        const double high = i == n - 1 ? mean : at[k + 1] - at[k];
        // The share of the line that this voxel stands for, under a tent as wide as two new voxels.
        const double weight = std::max(0.0, 1.0 - std::abs(at[k] - p) / side) * (low + high) / 2.0;
        if (weight <= 0.0) continue;
        if (last < 0) tap.first = i;
        last = i;
        tap.weights.push_back(weight);
        sum += weight;
      }
      for (double& weight : tap.weights) weight /= sum;
    }
    taps.push_back(std::move(tap));
  }
  return taps;
}

std::int16_t weighted(const std::int16_t* first, std::ptrdiff_t stride, const Tap& tap) {
  double sum = 0.0;
  double measured = 0.0;
  for (const double weight : tap.weights) {
    if (*first != PaddingHu) {
      sum += weight * *first;
      measured += weight;
    }
    first += stride;
  }
  return measured < 0.5 ? PaddingHu : rounded(sum / measured);
}

/// The image with its axis resampled to `count` voxels of `side`, the first at `start` (mm from the
/// first old one); `at`: where the old ones stand.
CtImage alongAxis(const CtImage& image, Eigen::Index axis, const std::vector<double>& at,
                  double start, double side, int count, const Progress& progress) {
  std::vector<double> wanted(static_cast<std::size_t>(count));
  for (std::size_t i = 0; i < wanted.size(); ++i) wanted[i] = start + side * static_cast<double>(i);
  const std::vector<Tap> taps = tapsOf(at, wanted, side);
  CtImage result;
  result.geometry = image.geometry;
  result.geometry.size[static_cast<std::size_t>(axis)] = count;
  result.geometry.spacing[axis] = side;
  result.geometry.origin += image.geometry.direction.col(axis) * start;
  result.voxels.resize(result.geometry.voxelCount());
  const auto& size = result.geometry.size;
  const std::array<std::ptrdiff_t, 3> strides = {
      1, image.geometry.size[0], static_cast<std::ptrdiff_t>(image.geometry.sliceCount())};
  const std::ptrdiff_t stride = strides[static_cast<std::size_t>(axis)];
  Counted counted(progress, static_cast<std::size_t>(size[2]));
  parallelFor(static_cast<std::size_t>(size[2]), [&](std::size_t slice) {
    const int k = static_cast<int>(slice);
    for (int j = 0; j < size[1]; ++j) {
      for (int i = 0; i < size[0]; ++i) {
        std::array<int, 3> voxel = {i, j, k};
        const Tap& tap = taps[static_cast<std::size_t>(voxel[static_cast<std::size_t>(axis)])];
        voxel[static_cast<std::size_t>(axis)] = tap.first;
        result.at(i, j, k) = weighted(&image.at(voxel[0], voxel[1], voxel[2]), stride, tap);
      }
    }
    counted.next();
  });
  return result;
}

std::string megabytes(std::uint64_t bytes) { return std::to_string((bytes + 999999) / 1000000); }

}  // namespace

void requireMemory(std::uint64_t bytes, const std::string& what) {
  const std::uint64_t available = availableMemoryBytes();
  if (available == 0 || bytes <= available) return;
  throw Error(ExitCode::OutOfMemory, what + " takes " + megabytes(bytes) + " MB of memory, but " +
                                         megabytes(available) + " MB are free; " +
                                         adviceForMemory());
}

double tiltDeg(const ImageGeometry& geometry) {
  const Vec3 normal = geometry.direction.col(0).cross(geometry.direction.col(1));
  const double angle = degrees(angleBetween(normal, geometry.direction.col(2)));
  return std::min(angle, 180.0 - angle);  // whichever way the slices are stacked
}

CtImage withSlicesFilled(CtImage image, std::span<const std::size_t> missing) {
  const auto slices = static_cast<std::size_t>(image.geometry.size[2]);
  std::vector<bool> there(slices, true);
  for (const std::size_t k : missing) there[k] = false;
  if (!there.front() || !there.back()) {
    throw InvalidInput(
        "the first or the last slice of the stack is missing; there is nothing "
        "beyond it to interpolate from");
  }
  const std::size_t size = image.geometry.sliceCount();
  std::int16_t* voxels = image.voxels.data();
  parallelFor(missing.size(), [&](std::size_t m) {
    const std::size_t k = missing[m];
    std::size_t below = k;
    std::size_t above = k;
    while (!there[below]) --below;
    while (!there[above]) ++above;
    const double t = static_cast<double>(k - below) / static_cast<double>(above - below);
    const std::int16_t* a = voxels + below * size;
    const std::int16_t* b = voxels + above * size;
    std::int16_t* to = voxels + k * size;
    for (std::size_t i = 0; i < size; ++i) to[i] = between(a[i], b[i], t);
  });
  return image;
}

CtImage untilted(const CtImage& image, const Progress& progress) {
  const ImageGeometry& from = image.geometry;
  Vec3 normal = from.direction.col(0).cross(from.direction.col(1));
  if (normal.dot(from.direction.col(2)) < 0.0) normal = -normal;
  // How far a slice lies beside the first, in pixels per slice.
  const Vec3 step = from.direction.col(2) * from.spacing.z();
  const std::array<double, 2> shift = {step.dot(from.direction.col(0)) / from.spacing.x(),
                                       step.dot(from.direction.col(1)) / from.spacing.y()};
  ImageGeometry to = from;
  to.direction.col(2) = normal;
  to.spacing.z() = step.dot(normal);
  std::array<int, 2> low{};  // first pixel of the new grid, counted in the old one's first slice
  for (std::size_t a = 0; a < 2; ++a) {
    const double last = shift[a] * (from.size[2] - 1);
    low[a] = static_cast<int>(std::floor(std::min(0.0, last) + WholeShift));
    const int high = static_cast<int>(std::ceil(std::max(0.0, last) - WholeShift));
    to.size[a] = from.size[a] + high - low[a];
  }
  to.origin = from.worldFromVoxel(Vec3(low[0], low[1], 0.0));
  requireMemory(to.voxelCount() * sizeof(std::int16_t), "the CT without its tilt");
  CtImage result{to, std::vector<std::int16_t>(to.voxelCount(), PaddingHu)};
  Counted counted(progress, static_cast<std::size_t>(to.size[2]));
  parallelFor(static_cast<std::size_t>(to.size[2]), [&](std::size_t slice) {
    const int k = static_cast<int>(slice);
    const Split x = split(low[0] - shift[0] * k);
    const Split y = split(low[1] - shift[1] * k);
    std::vector<std::int16_t> row(static_cast<std::size_t>(from.size[0]));
    for (int j = 0; j < to.size[1]; ++j) {
      for (int i = 0; i < from.size[0]; ++i) {
        row[static_cast<std::size_t>(i)] = shiftedPixel(
            [&](int v) { return v < 0 || v >= from.size[1] ? PaddingHu : image.at(i, v, k); },
            j + y.whole, y.rest);
      }
      for (int i = 0; i < to.size[0]; ++i) {
        result.at(i, j, k) = shiftedPixel(
            [&](int u) {
              return u < 0 || u >= from.size[0] ? PaddingHu : row[static_cast<std::size_t>(u)];
            },
            i + x.whole, x.rest);
      }
    }
    counted.next();
  });
  return result;
}

CtImage resampled(const CtImage& image, double sideMm, std::span<const double> slicePositionsMm,
                  const Progress& progress) {
  const ImageGeometry& from = image.geometry;
  std::array<int, 3> count{};
  std::array<double, 3> start{};
  std::array<std::vector<double>, 3> at;
  for (std::size_t a = 0; a < 3; ++a) {
    const double spacing = from.spacing[static_cast<Eigen::Index>(a)];
    const double length = spacing * from.size[a];
    count[a] = static_cast<int>(std::clamp(std::round(length / sideMm), 1.0, 1e6));
    start[a] = (length - spacing) / 2.0 - sideMm * (count[a] - 1) / 2.0;
    for (int i = 0; i < from.size[a]; ++i) at[a].push_back(spacing * i);
  }
  if (!slicePositionsMm.empty()) at[2].assign(slicePositionsMm.begin(), slicePositionsMm.end());
  const double bytes = 2.0 * count[0] * count[1] * static_cast<double>(count[2]);
  requireMemory(static_cast<std::uint64_t>(std::min(bytes, 1e18)), "the resampled CT");
  // Axes that shrink first: the rest then has less to do.
  std::array<std::size_t, 3> order = {0, 1, 2};
  const auto growth = [&](std::size_t a) { return static_cast<double>(count[a]) / from.size[a]; };
  std::ranges::stable_sort(order, {}, growth);
  CtImage result;
  bool changed = false;
  for (std::size_t pass = 0; pass < 3; ++pass) {
    const std::size_t a = order[pass];
    const auto axis = static_cast<Eigen::Index>(a);
    const bool asItIs = count[a] == from.size[a] && (a != 2 || slicePositionsMm.empty()) &&
                        std::abs(sideMm - from.spacing[axis]) < 1e-9 * sideMm;
    if (asItIs) continue;
    result = alongAxis(changed ? result : image, axis, at[a], start[a], sideMm, count[a],
                       progress.part(static_cast<double>(pass) / 3.0,
                                     static_cast<double>(pass + 1) / 3.0, "resampling"));
    changed = true;
  }
  progress.report(1.0);
  return changed ? result : image;
}

}  // namespace pneuma
