#include "cli/outline_picture.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace pneuma::cli {
namespace {

using Colour = std::array<std::uint8_t, 3>;

constexpr Colour Grey = {150, 156, 166};
constexpr Colour Black = {20, 22, 26};
constexpr Colour Red = {200, 40, 40};
constexpr std::array<Colour, 3> RegionColours = {{{31, 119, 200}, {230, 130, 20}, {40, 150, 70}}};

constexpr double MmPerPixel = 0.3;
constexpr double MarginMm = 8.0;

/// Seen from the front: the patient's right is on the left, the head above.
class Canvas {
 public:
  explicit Canvas(const Box3& box)
      : left_(box.min().x() - MarginMm), top_(box.max().z() + MarginMm) {
    picture_.width = static_cast<int>((box.sizes().x() + 2.0 * MarginMm) / MmPerPixel);
    picture_.height = static_cast<int>((box.sizes().z() + 2.0 * MarginMm) / MmPerPixel);
    picture_.rgb.assign(static_cast<std::size_t>(picture_.width * picture_.height) * 3, 255);
  }

  /// A filled square of `sideMm` around a point.
  void square(const Vec3& p, double sideMm, const Colour& colour) {
    const double x = (p.x() - left_) / MmPerPixel;
    const double y = (top_ - p.z()) / MmPerPixel;
    const double half = sideMm / MmPerPixel / 2.0;
    const auto first = [](double v) { return static_cast<int>(std::lround(v)); };
    for (int row = first(y - half); row < std::max(first(y + half), first(y - half) + 1); ++row)
      for (int column = first(x - half); column < std::max(first(x + half), first(x - half) + 1);
           ++column) {
        if (row < 0 || column < 0 || row >= picture_.height || column >= picture_.width) continue;
        const auto at = static_cast<std::size_t>(row * picture_.width + column) * 3;
        std::ranges::copy(colour, picture_.rgb.begin() + static_cast<std::ptrdiff_t>(at));
      }
  }

  void line(const Vec3& a, const Vec3& b, double widthMm, const Colour& colour) {
    const int steps = std::max(1, static_cast<int>((b - a).norm() / MmPerPixel));
    for (int i = 0; i <= steps; ++i) {
      square(a + (b - a) * (static_cast<double>(i) / steps), widthMm, colour);
    }
  }

  Picture picture() && { return std::move(picture_); }

 private:
  double left_;
  double top_;
  Picture picture_;
};

}  // namespace

Picture outlinePicture(const OutlineAggregate& aggregate) {
  Box3 box;
  for (const Vec3& corner : aggregate.outline) box.extend(corner);
  for (const Branch& branch : aggregate.tree) {
    if (branch.origin == Origin::Template) box.extend(branch.proximal);
  }
  Canvas canvas(box);
  for (std::size_t i = 0; i < aggregate.outline.size(); ++i) {
    canvas.line(aggregate.outline[i], aggregate.outline[(i + 1) % aggregate.outline.size()],
                2.0 * MmPerPixel, Grey);
  }
  for (const Vec3& p : aggregate.cluster.positions) {
    canvas.square(p, aggregate.cluster.voxelMm, Black);
  }
  for (const Branch& branch : aggregate.tree) {
    if (branch.origin == Origin::Template) canvas.line(branch.proximal, branch.distal, 1.8, Red);
  }
  for (std::size_t i = 0; i < aggregate.keyPoints.size(); ++i) {
    canvas.square(aggregate.keyPoints[i], 2.1, RegionColours[aggregate.keyPointRegions[i]]);
  }
  return std::move(canvas).picture();
}

}  // namespace pneuma::cli
