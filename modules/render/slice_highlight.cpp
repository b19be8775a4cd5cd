#include "render/slice_highlight.h"

#include <algorithm>
#include <cmath>

#include "core/parallel.h"

namespace pneuma {
namespace {

enum State : std::uint8_t {
  Dense,    // not in the band
  InBand,   // in the band, as far as is known inside the patient
  Nothing,  // not measured, or beyond the image
  Outside,  // reached from the sides
};

}  // namespace

SliceHighlight::SliceHighlight(const CtImage& ct, const SliceFrame& frame, const HuBand& band) {
  const double finest = ct.geometry.spacing.minCoeff();
  const Vec3 extent = ct.geometry.bounds().sizes();
  const ViewAxes axes = axesOf(frame.plane);
  grid_ = {frame.plane, ct.geometry.bounds().center(), finest,
           std::max(1, static_cast<int>(std::lround(std::abs(extent.dot(axes.right)) / finest))),
           std::max(1, static_cast<int>(std::lround(std::abs(extent.dot(axes.up)) / finest)))};
  grid_.centre[normalAxis(frame.plane)] = frame.positionMm();
  const auto width = static_cast<std::size_t>(grid_.width);
  state_.resize(width * static_cast<std::size_t>(grid_.height));
  parallelFor(static_cast<std::size_t>(grid_.height), [&](std::size_t y) {
    for (std::size_t x = 0; x < width; ++x) {
      const std::optional<int> hu =
          huAt(ct, grid_.pointAt({static_cast<double>(x) + 0.5, static_cast<double>(y) + 0.5}));
      state_[y * width + x] = !hu || *hu <= PaddingHu               ? Nothing
                              : *hu >= band.low && *hu <= band.high ? InBand
                                                                    : Dense;
    }
  });
  flood();
}

void SliceHighlight::take(int x, int y) {
  if (x < 0 || y < 0 || x >= grid_.width || y >= grid_.height) return;
  const std::int32_t index = y * grid_.width + x;
  std::uint8_t& state = state_[static_cast<std::size_t>(index)];
  if (state != InBand && state != Nothing) return;
  state = Outside;
  queue_.push_back(index);
}

void SliceHighlight::flood() {
  for (int y = 0; y < grid_.height; ++y) {
    take(0, y);
    take(grid_.width - 1, y);
  }
  // Upwards and downwards the trachea and the lungs may leave the image themselves.
  for (int x = 0; grid_.plane == SlicePlane::Axial && x < grid_.width; ++x) {
    take(x, 0);
    take(x, grid_.height - 1);
  }
  while (!queue_.empty()) {
    const int x = queue_.back() % grid_.width;
    const int y = queue_.back() / grid_.width;
    queue_.pop_back();
    take(x - 1, y);
    take(x + 1, y);
    take(x, y - 1);
    take(x, y + 1);
  }
}

bool SliceHighlight::contains(const Vec3& point) const {
  const PicturePoint at = grid_.drawnAt(point);
  const int x = static_cast<int>(std::floor(at.x));
  const int y = static_cast<int>(std::floor(at.y));
  return x >= 0 && y >= 0 && x < grid_.width && y < grid_.height &&
         state_[static_cast<std::size_t>(y) * static_cast<std::size_t>(grid_.width) +
                static_cast<std::size_t>(x)] == InBand;
}

}  // namespace pneuma
