#include "pipeline/detail/level_table.h"

#include <algorithm>
#include <cmath>

#include "core/parallel.h"

namespace pneuma {

LevelTable::LevelTable(const std::function<double(const Vec3&)>& level, const Box3& box,
                       double cellMm)
    : origin_(box.min()), cellMm_(cellMm) {
  size_ = (box.sizes() / cellMm).array().ceil().matrix().cast<int>() + Eigen::Vector3i::Ones();
  const auto plane = static_cast<std::size_t>(size_.x()) * static_cast<std::size_t>(size_.y());
  levels_.resize(plane * static_cast<std::size_t>(size_.z()));
  parallelFor(static_cast<std::size_t>(size_.z()), [&](std::size_t k) {
    std::size_t node = k * plane;
    for (int j = 0; j < size_.y(); ++j) {
      for (int i = 0; i < size_.x(); ++i) {
        const Vec3 p = origin_ + cellMm * Vec3(i, j, static_cast<double>(k));
        levels_[node++] = static_cast<float>(level(p));
      }
    }
  });
}

double LevelTable::operator()(const Vec3& p) const {
  const Vec3 cells = (p - origin_) / cellMm_;
  std::size_t at = 0;
  double fraction[3];
  std::size_t stride[3] = {
      1, static_cast<std::size_t>(size_.x()),
      static_cast<std::size_t>(size_.x()) * static_cast<std::size_t>(size_.y())};
  for (int axis = 0; axis < 3; ++axis) {
    const double c = std::clamp(cells[axis], 0.0, size_[axis] - 1.0);
    const int cell = std::min(static_cast<int>(c), size_[axis] - 2);
    fraction[axis] = c - cell;
    at += stride[axis] * static_cast<std::size_t>(cell);
  }
  const auto alongX = [&](std::size_t node) {
    const double a = static_cast<double>(levels_[node]);
    return a + fraction[0] * (static_cast<double>(levels_[node + 1]) - a);
  };
  const auto alongY = [&](std::size_t node) {
    const double a = alongX(node);
    return a + fraction[1] * (alongX(node + stride[1]) - a);
  };
  const double a = alongY(at);
  return a + fraction[2] * (alongY(at + stride[2]) - a);
}

}  // namespace pneuma
