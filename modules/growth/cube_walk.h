#pragma once

#include <cstdint>
#include <vector>

#include <Eigen/Core>

#include "core/random.h"

namespace pneuma {

/// A place of a square (D = 2) or cubic (D = 3) lattice.
template <int D>
using LatticeCell = Eigen::Matrix<int, D, 1>;

/// Many steps of a random walk at once. A walker that steps to one of its 2 D neighbours with equal
/// probability leaves the square or cube |x| < r around its start (largest coordinate) at a place
/// whose distribution is known in closed form: with a_m = m pi / 2r, m odd,
///   D = 3: p(i, j) = 1/r^2 sum_mn cos(a_m i) cos(a_n j) / (2 cosh(g r)),
///          cosh g = 3 - cos a_m - cos a_n
/// on each of the six faces, and likewise for D = 2. Up to ExactRadius the law is this one; beyond,
/// that of a larger cube is stretched, which differs from it by less than the lattice's grain.
template <int D>
class CubeWalk {
 public:
  static constexpr int ExactRadius = 16;

  CubeWalk();

  /// The displacement at which the walk first reaches distance `radius` (>= 1) along any axis.
  LatticeCell<D> exit(int radius, Random& random) const {
    const std::uint64_t bits = random.bits();
    LatticeCell<D> way;
    const int known = radius <= ExactRadius ? radius : StretchedRadius;
    const Place place = placeOn(known, bits >> 32);
    std::array<int, 2> along = {place.i, place.j};
    if (radius > ExactRadius) along = stretched(along, radius, random.bits());
    const auto axis = static_cast<int>(((bits >> 3 & 0x1FFFFFFFU) * D) >> 29);
    way[axis] = (bits & 1U) != 0 ? radius : -radius;
    way[(axis + 1) % D] = (bits & 2U) != 0 ? along[0] : -along[0];
    if constexpr (D == 3) way[(axis + 2) % D] = (bits & 4U) != 0 ? along[1] : -along[1];
    return way;
  }

  /// How many steps the walk takes to there on average.
  double meanSteps(int radius) const {
    if (radius <= ExactRadius) return meanSteps_[static_cast<std::size_t>(radius)];
    const double ratio = static_cast<double>(radius) / ExactRadius;
    return meanSteps_[ExactRadius] * ratio * ratio;
  }

  /// Probability of leaving through the place (i, j) of one given face; j = 0 where D = 2.
  static double exitProbability(int radius, int i, int j);

 private:
  static constexpr int StretchedRadius = 32;

  struct Place {
    std::uint8_t i = 0;
    std::uint8_t j = 0;
  };

  /// Walker's alias method: take `self` with probability keep / 2^32, else `other`.
  struct Entry {
    std::uint32_t keep = 0;
    Place self;
    Place other;
  };

  /// @param random 32 random bits
  Place placeOn(int radius, std::uint64_t random) const {
    const auto r = static_cast<std::uint64_t>(radius);
    const std::uint64_t product = random * (D == 2 ? r : r * r);
    const Entry& entry = entries_[first_[static_cast<std::size_t>(radius)] + (product >> 32)];
    return static_cast<std::uint32_t>(product) < entry.keep ? entry.self : entry.other;
  }

  static std::array<int, 2> stretched(const std::array<int, 2>& along, int radius,
                                      std::uint64_t bits);
  void addTable(int radius);

  std::vector<Entry> entries_;
  std::vector<std::size_t> first_;  ///< of every radius that has a table
  std::vector<double> meanSteps_;   ///< by radius
};

extern template class CubeWalk<2>;
extern template class CubeWalk<3>;

}  // namespace pneuma
