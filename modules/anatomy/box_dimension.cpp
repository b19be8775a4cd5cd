#include "anatomy/box_dimension.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <string>

#include "anatomy/centreline.h"
#include "core/error.h"

namespace pneuma {
namespace {

constexpr double SmallestBoxMm = 2.0;
constexpr int Octaves = 5;
constexpr double LongestTotalMm = 2e7;
constexpr double MostBoxesAcross = 1 << 21;  // what fits into a key

using Cell = std::array<std::int64_t, 3>;

/// Three coordinates of 21 bits each.
std::uint64_t keyOf(const Cell& cell) {
  return static_cast<std::uint64_t>(cell[0]) | static_cast<std::uint64_t>(cell[1]) << 21 |
         static_cast<std::uint64_t>(cell[2]) << 42;
}

/// The box of twice the size around the box `key`.
std::uint64_t outerBox(std::uint64_t key) {
  constexpr std::uint64_t FromNextField =
      std::uint64_t{1} << 20 | std::uint64_t{1} << 41 | std::uint64_t{1} << 62;
  return (key >> 1) & ~FromNextField;
}

void keepUnique(std::vector<std::uint64_t>& keys) {
  std::ranges::sort(keys);
  keys.erase(std::ranges::unique(keys).begin(), keys.end());
}

/// Appends the keys of all unit boxes that the segment from `a` to `b` passes through
/// (Amanatides & Woo 1987), `a` and `b` in units of the boxes.
void appendBoxes(const Vec3& a, const Vec3& b, std::vector<std::uint64_t>& keys) {
  Cell cell{};
  Cell left{};  // steps still to be made along every axis
  Cell step{};
  std::array<double, 3> next{};  // share of the segment at which the next box is entered
  std::array<double, 3> width{};
  std::int64_t steps = 0;
  for (std::size_t k = 0; k < 3; ++k) {
    const auto axis = static_cast<Eigen::Index>(k);
    const double along = b[axis] - a[axis];
    cell[k] = static_cast<std::int64_t>(std::floor(a[axis]));
    const std::int64_t last = static_cast<std::int64_t>(std::floor(b[axis]));
    step[k] = last < cell[k] ? -1 : 1;
    left[k] = std::abs(last - cell[k]);
    steps += left[k];
    const double side = static_cast<double>(cell[k] + (step[k] > 0 ? 1 : 0));
    next[k] = left[k] > 0 ? (side - a[axis]) / along : std::numeric_limits<double>::infinity();
    width[k] = left[k] > 0 ? std::abs(1.0 / along) : 0.0;
  }
  keys.push_back(keyOf(cell));
  for (; steps > 0; --steps) {
    const auto k = static_cast<std::size_t>(std::ranges::min_element(next) - next.begin());
    cell[k] += step[k];
    next[k] = --left[k] > 0 ? next[k] + width[k] : std::numeric_limits<double>::infinity();
    keys.push_back(keyOf(cell));
  }
}

/// @param keys of the smallest boxes, in any order and more than once
std::vector<BoxDimension> slopes(std::vector<std::uint64_t> keys, double boxMm, int octaves) {
  keepUnique(keys);
  std::vector<BoxDimension> dimensions;
  for (int octave = 0; octave < octaves; ++octave, boxMm *= 2.0) {
    const double small = static_cast<double>(keys.size());
    for (std::uint64_t& key : keys) key = outerBox(key);
    keepUnique(keys);
    dimensions.push_back({boxMm, std::log2(small / static_cast<double>(keys.size()))});
  }
  return dimensions;
}

}  // namespace

std::vector<BoxDimension> boxDimensions(const AirwayTree& tree,
                                        std::span<const std::size_t> branches) {
  if (branches.empty()) return {};
  Box3 box;
  double total = 0.0;
  for (const std::size_t i : branches) {
    forEachPiece(tree[i], [&](const CentrelinePiece& piece) {
      box.extend(piece.from);
      box.extend(piece.to);
      total += (piece.to - piece.from).norm();
    });
  }
  if (!(total < LongestTotalMm && box.sizes().maxCoeff() < SmallestBoxMm * MostBoxesAcross)) {
    throw InvalidInput("the airways are " + std::to_string(std::llround(total / 1e6)) +
                       " km long together, which no lung is; check the tree's units (mm)");
  }
  std::vector<std::uint64_t> keys;
  for (const std::size_t i : branches) {
    forEachPiece(tree[i], [&](const CentrelinePiece& piece) {
      appendBoxes((piece.from - box.min()) / SmallestBoxMm, (piece.to - box.min()) / SmallestBoxMm,
                  keys);
    });
  }
  return slopes(std::move(keys), SmallestBoxMm, Octaves);
}

std::vector<BoxDimension> boxDimensions(std::span<const Vec3> points, double smallestBoxMm,
                                        int octaves) {
  if (points.empty()) return {};
  Box3 box;
  for (const Vec3& p : points) box.extend(p);
  if (!(box.sizes().maxCoeff() < smallestBoxMm * MostBoxesAcross)) {
    throw InvalidInput("the points lie too far apart to count boxes of " +
                       std::to_string(smallestBoxMm) + " mm; choose larger boxes");
  }
  std::vector<std::uint64_t> keys;
  keys.reserve(points.size());
  for (const Vec3& p : points) {
    // From half a box before the lowest, so that points of a lattice lie in the middle of boxes.
    const Vec3 q = (p - box.min()) / smallestBoxMm + Vec3::Constant(0.5);
    keys.push_back(keyOf({static_cast<std::int64_t>(q.x()), static_cast<std::int64_t>(q.y()),
                          static_cast<std::int64_t>(q.z())}));
  }
  return slopes(std::move(keys), smallestBoxMm, octaves);
}

}  // namespace pneuma
