#pragma once

#include <cstddef>
#include <memory>
#include <vector>

#include "core/math.h"

namespace pneuma {

/// Nearest-neighbour search in a fixed set of points. Built once; queries from any thread.
class PointIndex {
 public:
  struct Neighbour {
    std::size_t index = 0;
    double distance = 0.0;  ///< mm
  };

  explicit PointIndex(std::vector<Vec3> points);
  ~PointIndex();
  PointIndex(PointIndex&&) noexcept;
  PointIndex& operator=(PointIndex&&) noexcept;

  const std::vector<Vec3>& points() const;

  /// The point nearest to `p`. @pre the index is not empty
  Neighbour nearest(const Vec3& p) const;

  /// Up to `count` points, nearest first.
  std::vector<Neighbour> nearest(const Vec3& p, std::size_t count) const;

  /// All points within `radius` mm of `p`, nearest first.
  std::vector<Neighbour> within(const Vec3& p, double radius) const;

 private:
  struct Tree;
  std::unique_ptr<Tree> tree_;
};

}  // namespace pneuma
