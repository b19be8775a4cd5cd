#include "lobes/height_table.h"

#include <cmath>

#include "core/parallel.h"

namespace pneuma {

HeightTable::HeightTable(const HeightSurface& surface, const Box3& box) : surface_(surface) {
  Eigen::AlignedBox2d range;
  for (int corner = 0; corner < 8; ++corner) {
    range.extend(surface.planar(box.corner(static_cast<Box3::CornerType>(corner))));
  }
  low_ = range.min();
  // One more row and column than are asked for, so that there is always a next one.
  columns_ = static_cast<std::size_t>(std::ceil(range.sizes().x())) + 2;
  const auto rows = static_cast<std::size_t>(std::ceil(range.sizes().y())) + 2;
  most_ = Vec2(static_cast<double>(columns_) - 1.5, static_cast<double>(rows) - 1.5);
  lift_.resize(columns_ * rows);
  parallelFor(rows, [&](std::size_t j) {
    for (std::size_t i = 0; i < columns_; ++i) {
      const Vec2 at(static_cast<double>(i), static_cast<double>(j));
      lift_[i + columns_ * j] = surface_.lift(low_ + at);
    }
  });
}

}  // namespace pneuma
