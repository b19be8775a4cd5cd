#include "growth/cube_walk.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace pneuma {
namespace {

/// a_m = m pi / 2r for the r odd m.
std::vector<double> modes(int radius) {
  std::vector<double> angles;
  for (int m = 1; m < 2 * radius; m += 2) angles.push_back(m * std::numbers::pi / (2.0 * radius));
  return angles;
}

/// The part of the constant 1 in mode a of the walk inside |x| < r.
double shareOfOne(int radius, int mode, double angle) {
  const double sign = mode % 2 == 0 ? 1.0 : -1.0;
  return sign / (radius * std::tan(angle / 2.0));
}

/// Expected steps until |x| = r: sum over modes of share / (1 - mean of cosines).
template <int D>
double expectedSteps(int radius) {
  const std::vector<double> angles = modes(radius);
  double sum = 0.0;
  for (int m = 0; m < radius; ++m)
    for (int n = 0; n < radius; ++n)
      for (int k = 0; k < (D == 3 ? radius : 1); ++k) {
        const auto at = [&](int i) { return angles[static_cast<std::size_t>(i)]; };
        double share = shareOfOne(radius, m, at(m)) * shareOfOne(radius, n, at(n));
        double cosines = std::cos(at(m)) + std::cos(at(n));
        if (D == 3) {
          share *= shareOfOne(radius, k, at(k));
          cosines += std::cos(at(k));
        }
        sum += share / (1.0 - cosines / D);
      }
  return sum;
}

/// 1 / (2 cosh(g r)) with g = acosh(coshG).
double transmitted(double coshG, int radius) { return 0.5 / std::cosh(std::acosh(coshG) * radius); }

}  // namespace

template <int D>
double CubeWalk<D>::exitProbability(int radius, int i, int j) {
  double sum = 0.0;
  for (const double a : modes(radius)) {
    if constexpr (D == 2) {
      sum += std::cos(a * i) * transmitted(2.0 - std::cos(a), radius) / radius;
    } else {
      for (const double b : modes(radius)) {
        sum += std::cos(a * i) * std::cos(b * j) *
               transmitted(3.0 - std::cos(a) - std::cos(b), radius) / (radius * radius);
      }
    }
  }
  return sum;
}

template <int D>
CubeWalk<D>::CubeWalk() : first_(StretchedRadius + 1, 0), meanSteps_(ExactRadius + 1, 0.0) {
  for (int radius = 1; radius <= ExactRadius; ++radius) {
    addTable(radius);
    meanSteps_[static_cast<std::size_t>(radius)] = expectedSteps<D>(radius);
  }
  addTable(StretchedRadius);
}

/// The quarter i, j >= 0 of a face, with the weight of its mirror images; signs are drawn apart.
template <int D>
void CubeWalk<D>::addTable(int radius) {
  const auto r = static_cast<std::size_t>(radius);
  const std::size_t count = D == 2 ? r : r * r;
  // Separable sums: first over the modes of j for every mode of i, then over those of i.
  const std::vector<double> angles = modes(radius);
  std::vector<double> weights(count, 0.0);
  std::vector<double> partial(r * r, 0.0);  // mode of i, then j
  for (std::size_t m = 0; m < r; ++m)
    for (std::size_t j = 0; j < (D == 2 ? 1 : r); ++j) {
      if constexpr (D == 2) {
        partial[m * r] = transmitted(2.0 - std::cos(angles[m]), radius);
        continue;
      }
      for (const double b : angles) {
        partial[m * r + j] += std::cos(b * static_cast<double>(j)) *
                              transmitted(3.0 - std::cos(angles[m]) - std::cos(b), radius);
      }
    }
  double total = 0.0;
  for (std::size_t k = 0; k < count; ++k) {
    const std::size_t i = D == 2 ? k : k / r;
    const std::size_t j = D == 2 ? 0 : k % r;
    for (std::size_t m = 0; m < r; ++m) {
      weights[k] += std::cos(angles[m] * static_cast<double>(i)) * partial[m * r + j];
    }
    weights[k] = std::max(weights[k], 0.0) * (i > 0 ? 2.0 : 1.0) * (D == 3 && j > 0 ? 2.0 : 1.0);
    total += weights[k];
  }

  first_[r] = entries_.size();
  const auto place = [&](std::size_t k) {
    return Place{static_cast<std::uint8_t>(D == 2 ? k : k / r),
                 static_cast<std::uint8_t>(D == 2 ? 0 : k % r)};
  };
  std::vector<double> left(count);
  std::vector<std::size_t> small;
  std::vector<std::size_t> large;
  for (std::size_t k = 0; k < count; ++k) {
    left[k] = weights[k] / total * static_cast<double>(count);
    (left[k] < 1.0 ? small : large).push_back(k);
    entries_.push_back({0xFFFFFFFFU, place(k), place(k)});
  }
  while (!small.empty() && !large.empty()) {
    const std::size_t less = small.back();
    const std::size_t more = large.back();
    small.pop_back();
    Entry& entry = entries_[first_[r] + less];
    entry.keep = static_cast<std::uint32_t>(std::min(left[less] * 0x1p32, 0x1p32 - 1.0));
    entry.other = place(more);
    left[more] -= 1.0 - left[less];
    if (left[more] < 1.0) {
      large.pop_back();
      small.push_back(more);
    }
  }
}

template <int D>
std::array<int, 2> CubeWalk<D>::stretched(const std::array<int, 2>& along, int radius,
                                          std::uint64_t bits) {
  std::array<int, 2> result{};
  for (std::size_t axis = 0; axis < 2; ++axis) {
    // A cell of the known face is one unit wide; place 0 is folded onto itself by the sign.
    const double jitter = static_cast<double>(bits >> (32 * axis) & 0xFFFFFFFFU) * 0x1p-32 - 0.5;
    const double at = std::abs(along[axis] + jitter) * radius / StretchedRadius;
    result[axis] = std::min(static_cast<int>(at + 0.5), radius - 1);
  }
  return result;
}

template class CubeWalk<2>;
template class CubeWalk<3>;

}  // namespace pneuma
