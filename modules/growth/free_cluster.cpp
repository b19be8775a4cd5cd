#include "growth/free_cluster.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "growth/aggregation.h"

namespace pneuma {
namespace {

template <int D>
using Point = Eigen::Matrix<double, D, 1>;

/// Uniform on the unit circle or sphere.
template <int D>
Point<D> onSphere(Random& random) {
  while (true) {
    Point<D> p;
    for (int axis = 0; axis < D; ++axis) p[axis] = random.uniform(-1.0, 1.0);
    const double square = p.squaredNorm();
    if (square > 1e-6 && square <= 1.0) return p / std::sqrt(square);
  }
}

/// Where Brownian motion from outside first hits the sphere of `radius` around the origin; the
/// origin itself if it never does. Poisson's kernel, inverted.
template <int D>
Point<D> returned(const Point<D>& from, double radius, Random& random) {
  const double distance = from.norm();
  const double a = radius / distance;
  const Point<D> axis = from / distance;
  if constexpr (D == 2) {
    const double angle = 2.0 * std::atan((1.0 - a) / (1.0 + a) *
                                         std::tan(std::numbers::pi * (random.uniform() - 0.5)));
    const Point<2> across(-axis.y(), axis.x());
    return radius * (std::cos(angle) * axis + std::sin(angle) * across);
  } else {
    if (random.uniform() >= a) return Point<3>::Zero();
    const double root = (1.0 - a * a) / (1.0 - a + 2.0 * a * random.uniform());
    const double cosine = std::clamp((1.0 + a * a - root * root) / (2.0 * a), -1.0, 1.0);
    const Vec3 across =
        rotated(anyPerpendicular(axis), axis, random.uniform(0.0, 2.0 * std::numbers::pi));
    return radius * (cosine * axis + std::sqrt(1.0 - cosine * cosine) * across);
  }
}

/// Half the side of a lattice that holds a cluster of so many particles: 2.2 times the radius of
/// gyration's law, which the farthest arms never reach.
template <int D>
int halfSide(std::size_t count) {
  const double dimension = D == 2 ? 1.71 : 2.5;
  return 24 + static_cast<int>(2.2 * std::pow(static_cast<double>(count), 1.0 / dimension));
}

template <int D>
class FreeGrower {
 public:
  using Cell = LatticeCell<D>;

  FreeGrower(std::size_t count, std::uint64_t seed)
      : half_(halfSide<D>(count)), lattice_(Cell::Constant(2 * half_ + 1)), random_(seed) {
    Cell brick = Cell::Zero();
    typename AggregationLattice<D>::BrickWords all;
    all.fill(~std::uint64_t{0});
    while (brick[D - 1] < lattice_.bricksAlong()[D - 1]) {
      lattice_.setOpen(brick, all);
      for (int axis = 0; axis < D; ++axis) {
        if (++brick[axis] < lattice_.bricksAlong()[axis] || axis == D - 1) break;
        brick[axis] = 0;
      }
    }
    lattice_.findWalls();
    lattice_.addToCluster(centre());
  }

  Vec3 addOne(const Progress& progress) {
    const Cell cell = arrived(progress);
    lattice_.addToCluster(cell);
    const Cell from = cell - centre();
    radius_ = std::max(radius_, from.template cast<double>().norm());
    Vec3 point = Vec3::Zero();
    for (int axis = 0; axis < D; ++axis) point[axis] = from[axis];
    return point;
  }

 private:
  Cell centre() const { return Cell::Constant(half_); }

  Cell start(double radius) { return rounded(radius * onSphere<D>(random_)); }

  Cell rounded(const Point<D>& p) const {
    return centre() + p.array().round().matrix().template cast<int>();
  }

  bool touches(const Cell& cell) const {
    for (int axis = 0; axis < D; ++axis) {
      Cell other = cell;
      ++other[axis];
      if (lattice_.inCluster(other)) return true;
      other[axis] -= 2;
      if (lattice_.inCluster(other)) return true;
    }
    return false;
  }

  /// Walks until a walker touches the cluster.
  Cell arrived(const Progress& progress) {
    const CubeWalk<D>& jumps = cubeWalk<D>();
    const double launch = radius_ + 3.0;
    Cell cell = start(launch);
    for (std::uint64_t move = 1;; ++move) {
      if (move % (1 << 14) == 0) progress.throwIfStopped();
      const int radius = lattice_.look(cell).free;
      if (radius <= 1 && touches(cell)) return cell;
      const Cell next = cell + jumps.exit(radius, random_);
      const Point<D> at = (next - centre()).template cast<double>();
      if (at.norm() > launch + 1.0) {
        const Point<D> back = returned<D>(at, launch, random_);
        cell = back.isZero() ? start(launch) : rounded(back);
      } else if (!lattice_.inCluster(next)) {
        cell = next;
      }
    }
  }

  int half_;
  AggregationLattice<D> lattice_;
  Random random_;
  double radius_ = 0.0;  ///< of the farthest particle
};

}  // namespace

template <int D>
std::vector<Vec3> freeCluster(std::size_t count, std::uint64_t seed, const Progress& progress) {
  FreeGrower<D> grower(count, seed);
  std::vector<Vec3> points = {Vec3::Zero()};
  while (points.size() < count) {
    points.push_back(grower.addOne(progress));
    if (points.size() % 256 == 0) {
      progress.report(static_cast<double>(points.size()) / static_cast<double>(count));
    }
  }
  progress.report(1.0);
  return points;
}

template std::vector<Vec3> freeCluster<2>(std::size_t, std::uint64_t, const Progress&);
template std::vector<Vec3> freeCluster<3>(std::size_t, std::uint64_t, const Progress&);

}  // namespace pneuma
