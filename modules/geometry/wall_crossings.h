#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "core/triangle_mesh.h"

namespace pneuma {

/// How often a way of straight segments passes through triangles.
enum class Crossings : std::int8_t {
  Even,
  Odd,
  Unsure,  ///< it touches a triangle's border or plane so closely that rounding would decide
};

/// Crossings of two ways, one after the other.
constexpr Crossings operator+(Crossings a, Crossings b) {
  if (a == Crossings::Unsure || b == Crossings::Unsure) return Crossings::Unsure;
  return a == b ? Crossings::Even : Crossings::Odd;
}

/// Counts where segments cross triangles without rounding errors: every sign is certain (Shewchuk's
/// bound for the orientation of four points), or the answer is Unsure.
class WallCrossings {
 public:
  /// Triangles that name the same place twice are kept but never crossed.
  explicit WallCrossings(const TriangleMesh& mesh);

  std::size_t size() const { return corners_.size(); }

  const std::array<Vec3, 3>& corners(std::size_t triangle) const { return corners_[triangle]; }

  /// Crossings of the segment from `p` to `q` with a triangle. Even is none at all.
  Crossings of(const Vec3& p, const Vec3& q, std::uint32_t triangle) const;

  /// The same with all of the listed triangles.
  Crossings parity(const Vec3& p, const Vec3& q, std::span<const std::uint32_t> triangles) const;

 private:
  std::vector<std::array<Vec3, 3>> corners_;
};

}  // namespace pneuma
