#pragma once

#include <cstddef>
#include <cstdint>
#include <numeric>
#include <vector>

namespace pneuma {

/// Sets of the numbers below n that are joined one with another: a union-find whose smaller numbers
/// lead, so that sets come in the order of their first members.
class DisjointSets {
 public:
  explicit DisjointSets(std::size_t n) : parent_(n) {
    std::iota(parent_.begin(), parent_.end(), std::uint32_t{0});
  }

  /// The least number of the set that holds `i`.
  std::uint32_t find(std::uint32_t i) {
    while (parent_[i] != i) {
      parent_[i] = parent_[parent_[i]];
      i = parent_[i];
    }
    return i;
  }

  void join(std::uint32_t a, std::uint32_t b) {
    a = find(a);
    b = find(b);
    if (a < b) parent_[b] = a;
    if (b < a) parent_[a] = b;
  }

 private:
  std::vector<std::uint32_t> parent_;
};

}  // namespace pneuma
