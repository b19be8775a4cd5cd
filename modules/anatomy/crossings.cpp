#include "anatomy/crossings.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <cstdint>

#include "anatomy/centreline.h"
#include "core/error.h"
#include "core/parallel.h"

namespace pneuma {
namespace {

using Pair = std::pair<std::size_t, std::size_t>;
using Cell = Eigen::Vector3i;

constexpr std::size_t MostOverlaps = 5'000'000;  // before pairs found twice are joined
constexpr double MostCells = 4e6;
constexpr double MostEntries = 5e7;  // of capsules in cells

/// A piece of a tube, short enough to lie in few cells.
struct Capsule {
  Vec3 from;
  Vec3 to;
  double radius = 0.0;
  int chain = 0;  ///< index of the first branch of its chain
  Cell low;       ///< the cells it may touch
  Cell high;
};

/// One-daughter steps joined: the first branch of every branch's chain, and the chain above it.
class Chains {
 public:
  explicit Chains(const AirwayTree& tree) : of_(tree.size()), mother_(tree.size(), -1) {
    const Children children(tree);
    for (std::size_t i = 0; i < tree.size(); ++i) {
      const int parent = tree[i].parent;
      of_[i] = static_cast<int>(i);
      if (parent < 0) continue;
      const int above = of_[static_cast<std::size_t>(parent)];
      if (children.of(static_cast<std::size_t>(parent)).size() == 1) {
        of_[i] = above;
      } else {
        mother_[i] = above;
      }
    }
  }

  int of(std::size_t branch) const { return of_[branch]; }

  bool areKin(int a, int b) const {
    const int motherOfA = motherOf(a);
    const int motherOfB = motherOf(b);
    const int grandmotherOfA = motherOf(motherOfA);
    const int grandmotherOfB = motherOf(motherOfB);
    const auto same = [](int x, int y) { return x >= 0 && x == y; };
    return a == b || same(a, motherOfB) || same(b, motherOfA) || same(motherOfA, motherOfB) ||
           same(a, grandmotherOfB) || same(b, grandmotherOfA) || same(grandmotherOfA, motherOfB) ||
           same(grandmotherOfB, motherOfA);
  }

 private:
  int motherOf(int chain) const {
    return chain < 0 ? -1 : mother_[static_cast<std::size_t>(chain)];
  }

  std::vector<int> of_;
  std::vector<int> mother_;
};

/// Squared distance between the segments p0-p1 and q0-q1.
double squaredDistance(const Vec3& p0, const Vec3& p1, const Vec3& q0, const Vec3& q1) {
  const Vec3 u = p1 - p0;
  const Vec3 v = q1 - q0;
  const Vec3 w = p0 - q0;
  const double uu = u.squaredNorm();
  const double vv = v.squaredNorm();
  const double uv = u.dot(v);
  const double uw = u.dot(w);
  const double vw = v.dot(w);
  // Nearest point of the first line to the second, kept on the segment; then the point of the
  // second segment nearest to it, and back. Exact for segments, also parallel and zero-length ones.
  const double denominator = uu * vv - uv * uv;
  double s =
      denominator > 1e-12 * uu * vv ? std::clamp((uv * vw - vv * uw) / denominator, 0.0, 1.0) : 0.0;
  const double t = vv > 0.0 ? std::clamp((uv * s + vw) / vv, 0.0, 1.0) : 0.0;
  s = uu > 0.0 ? std::clamp((uv * t - uw) / uu, 0.0, 1.0) : 0.0;
  return (w + s * u - t * v).squaredNorm();
}

/// Capsules in the cells of a uniform grid.
class CapsuleGrid {
 public:
  CapsuleGrid(const AirwayTree& tree, const Chains& chains);

  /// Calls `f(a, b)` for the chains of capsules that overlap and meet first in cells of layer k,
  /// and `pause()` every now and then.
  template <class F, class Pause>
  void forEachOverlap(int k, F&& f, Pause&& pause) const;

  const Cell& size() const { return size_; }

 private:
  Cell cellOf(const Vec3& p) const {
    return ((p - origin_) / cellMm_).array().floor().matrix().cast<int>();
  }

  std::size_t index(int i, int j, int k) const {
    return static_cast<std::size_t>(i) +
           static_cast<std::size_t>(size_.x()) *
               (static_cast<std::size_t>(j) +
                static_cast<std::size_t>(size_.y()) * static_cast<std::size_t>(k));
  }

  template <class F>
  void forEachCell(const Capsule& capsule, F&& f) const {
    for (int k = capsule.low.z(); k <= capsule.high.z(); ++k)
      for (int j = capsule.low.y(); j <= capsule.high.y(); ++j)
        for (int i = capsule.low.x(); i <= capsule.high.x(); ++i) f(index(i, j, k));
  }

  void layCells(const Box3& box, double cellMm);
  void addCapsules(const CentrelinePiece& piece, int chain);
  double entries() const;
  void fillCells();

  std::vector<Capsule> capsules_;
  std::vector<std::uint32_t> offsets_;  ///< of every cell's capsules in ids_
  std::vector<std::uint32_t> ids_;
  Vec3 origin_;
  double cellMm_ = 1.0;
  Cell size_;
};

double radiusOf(const CentrelinePiece& piece) {
  return 0.5 * (piece.fromRadiusMm + piece.toRadiusMm);
}

void CapsuleGrid::layCells(const Box3& box, double cellMm) {
  cellMm_ = std::max(cellMm, 1e-9);
  while (((box.sizes() / cellMm_).array().floor() + 1.0).prod() > MostCells) cellMm_ *= 1.25;
  origin_ = box.min();
  size_ = cellOf(box.max()).array() + 1;
}

void CapsuleGrid::addCapsules(const CentrelinePiece& piece, int chain) {
  const int parts =
      std::max(1, static_cast<int>(std::ceil((piece.to - piece.from).norm() / (2.0 * cellMm_))));
  for (int i = 0; i < parts; ++i) {
    Capsule capsule;
    capsule.from = piece.from + (piece.to - piece.from) * (static_cast<double>(i) / parts);
    capsule.to = piece.from + (piece.to - piece.from) * (static_cast<double>(i + 1) / parts);
    capsule.radius = radiusOf(piece);
    capsule.chain = chain;
    const Vec3 reach = Vec3::Constant(capsule.radius);
    capsule.low = cellOf(capsule.from.cwiseMin(capsule.to) - reach).cwiseMax(0);
    capsule.high =
        cellOf(capsule.from.cwiseMax(capsule.to) + reach).cwiseMin(Cell(size_.array() - 1));
    capsules_.push_back(capsule);
  }
}

double CapsuleGrid::entries() const {
  double sum = 0.0;
  for (const Capsule& capsule : capsules_) {
    sum += ((capsule.high - capsule.low).cast<double>().array() + 1.0).prod();
  }
  return sum;
}

void CapsuleGrid::fillCells() {
  offsets_.assign(index(0, 0, size_.z()) + 1, 0);
  for (const Capsule& capsule : capsules_) {
    forEachCell(capsule, [&](std::size_t cell) { ++offsets_[cell + 1]; });
  }
  for (std::size_t i = 1; i < offsets_.size(); ++i) offsets_[i] += offsets_[i - 1];
  ids_.resize(offsets_.back());
  std::vector<std::uint32_t> next(offsets_.begin(), offsets_.end() - 1);
  for (std::size_t i = 0; i < capsules_.size(); ++i) {
    forEachCell(capsules_[i],
                [&](std::size_t cell) { ids_[next[cell]++] = static_cast<std::uint32_t>(i); });
  }
}

CapsuleGrid::CapsuleGrid(const AirwayTree& tree, const Chains& chains) {
  Box3 box;
  double extent = 0.0;
  std::size_t pieces = 0;
  for (const Branch& branch : tree) {
    forEachPiece(branch, [&](const CentrelinePiece& piece) {
      const Vec3 reach = Vec3::Constant(radiusOf(piece));
      box.extend(piece.from.cwiseMin(piece.to) - reach);
      box.extend(piece.from.cwiseMax(piece.to) + reach);
      extent += 0.5 * (piece.to - piece.from).norm() + 2.0 * radiusOf(piece);
      ++pieces;
    });
  }
  // Cells as large as a usual tube; larger where a few wide tubes would fill too many.
  double cellMm = extent / static_cast<double>(pieces);
  do {
    layCells(box, cellMm);
    capsules_.clear();
    for (std::size_t i = 0; i < tree.size(); ++i) {
      forEachPiece(tree[i],
                   [&](const CentrelinePiece& piece) { addCapsules(piece, chains.of(i)); });
    }
    cellMm = 2.0 * cellMm_;
  } while (entries() > MostEntries);
  fillCells();
}

template <class F, class Pause>
void CapsuleGrid::forEachOverlap(int k, F&& f, Pause&& pause) const {
  for (int j = 0; j < size_.y(); ++j) {
    for (int i = 0; i < size_.x(); ++i) {
      const Cell here(i, j, k);
      const std::size_t cell = index(i, j, k);
      for (std::uint32_t m = offsets_[cell]; m < offsets_[cell + 1]; ++m) {
        pause();
        const Capsule& a = capsules_[ids_[m]];
        for (std::uint32_t n = m + 1; n < offsets_[cell + 1]; ++n) {
          const Capsule& b = capsules_[ids_[n]];
          // Two capsules share a block of cells; its lowest corner looks at them for all.
          if (a.chain == b.chain || a.low.cwiseMax(b.low) != here) continue;
          const double reach = a.radius + b.radius;
          if (squaredDistance(a.from, a.to, b.from, b.to) < reach * reach) f(a.chain, b.chain);
        }
      }
    }
  }
}

}  // namespace

std::vector<Pair> crossings(const AirwayTree& tree, const Progress& progress) {
  if (tree.empty()) return {};
  const Chains chains(tree);
  const CapsuleGrid grid(tree, chains);
  progress.report(0.5);
  std::vector<std::vector<Pair>> byLayer(static_cast<std::size_t>(grid.size().z()));
  std::atomic<std::size_t> found = 0;
  parallelFor(byLayer.size(), [&](std::size_t k) {
    const auto keep = [&](int a, int b) {
      if (chains.areKin(a, b)) return;
      const auto [low, high] = std::minmax(a, b);
      byLayer[k].emplace_back(low, high);
      ++found;
    };
    grid.forEachOverlap(static_cast<int>(k), keep, [&] {
      progress.throwIfStopped();
      if (found > MostOverlaps) {
        throw InvalidInput(
            "the branches of the tree overlap nearly everywhere; check that radii and positions "
            "are in the same unit (mm)");
      }
    });
  });
  std::vector<Pair> pairs;
  for (const std::vector<Pair>& layer : byLayer) {
    pairs.insert(pairs.end(), layer.begin(), layer.end());
  }
  std::ranges::sort(pairs);
  pairs.erase(std::ranges::unique(pairs).begin(), pairs.end());
  return pairs;
}

}  // namespace pneuma
