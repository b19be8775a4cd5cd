#include "core/moving_points.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "core/parallel.h"

namespace pneuma {
namespace {

constexpr std::size_t Block = 3 << 14;  // numbers; whole vectors of three

/// body(first, last) of pieces that are large enough for a thread to begin with.
template <class Body>
void inBlocks(std::size_t count, const Body& body) {
  parallelFor((count + Block - 1) / Block, [&](std::size_t block) {
    body(block * Block, std::min(count, (block + 1) * Block));
  });
}

template <class Number>
void move(const Number* rest, const Number* slope, Number s, Number* moved, std::size_t count) {
  inBlocks(count, [=](std::size_t first, std::size_t last) {
    for (std::size_t n = first; n < last; ++n) moved[n] = rest[n] + s * slope[n];
  });
}

}  // namespace

void moveAlong(std::span<const float> rest, std::span<const float> slope, float s,
               std::span<float> moved) {
  move(rest.data(), slope.data(), s, moved.data(), moved.size());
}

void moveAlong(std::span<const double> rest, std::span<const double> slope, double s,
               std::span<double> moved) {
  move(rest.data(), slope.data(), s, moved.data(), moved.size());
}

void turnAlong(std::span<const float> normals, std::span<const float> slope, float s,
               std::span<float> turned) {
  const float* n = normals.data();
  const float* b = slope.data();
  float* to = turned.data();
  inBlocks(turned.size(), [=](std::size_t first, std::size_t last) {
    for (std::size_t i = first; i < last; i += 3) {
      const float x = n[i] + s * b[i];
      const float y = n[i + 1] + s * b[i + 1];
      const float z = n[i + 2] + s * b[i + 2];
      const float squared = x * x + y * y + z * z;
      const float scale = squared > 0.0F ? 1.0F / std::sqrt(squared) : 0.0F;
      to[i] = scale * x;
      to[i + 1] = scale * y;
      to[i + 2] = scale * z;
    }
  });
}

}  // namespace pneuma
