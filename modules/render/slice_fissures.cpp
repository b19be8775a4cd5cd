#include "render/slice_fissures.h"

#include <algorithm>
#include <cmath>

#include "anatomy/lobe.h"
#include "core/parallel.h"
#include "render/colour.h"
#include "render/drawing.h"

namespace pneuma {
namespace {

constexpr double GridMm = 3.0;
constexpr double LinePixels = 1.6;
constexpr double CurrentLinePixels = 2.4;
constexpr int DashPixels = 9;
constexpr int GapPixels = 6;
constexpr int DotPixels = 3;        ///< where no fissure shows, and as much between
constexpr double MarkRadius = 4.5;  // logical pixels
constexpr Rgb LineColour = rgbOfHex(0xffffff);
constexpr Rgb MarkColour = rgbOfHex(0xffffff);
constexpr Rgb CurrentColour = rgbOfHex(0x4aa8ff);
constexpr Rgb SuspectColour = rgbOfHex(0xf2b544);
constexpr Rgb MissingColour = rgbOfHex(0xff7033);  ///< like none of the lobes

Fissure obliqueOf(Side side) {
  return side == Side::Right ? Fissure::RightOblique : Fissure::LeftOblique;
}

}  // namespace

FissureOverlay::FissureOverlay(const SliceFissures& fissures, const SliceFrame& frame)
    : fissures_(fissures),
      frame_(frame),
      step_(std::max(1, static_cast<int>(std::lround(GridMm / frame.mmPerPixel)))) {
  for (const SliceFissures::Line& line : fissures.lines) {
    Heights heights{&line, frame.width / step_ + 2, {}};
    const int rows = frame.height / step_ + 2;
    heights.values.resize(static_cast<std::size_t>(heights.columns * rows));
    parallelFor(static_cast<std::size_t>(rows), [&](std::size_t row) {
      const double y = static_cast<double>(row) * step_ + 0.5;
      for (int column = 0; column < heights.columns; ++column) {
        const double x = static_cast<double>(column) * step_ + 0.5;
        heights.values[row * static_cast<std::size_t>(heights.columns) +
                       static_cast<std::size_t>(column)] =
            static_cast<float>(line.heightMm(frame.pointAt({x, y})));
      }
    });
    heights_.push_back(std::move(heights));
  }
}

const FissureOverlay::Heights* FissureOverlay::of(Fissure fissure) const {
  const auto found = std::ranges::find_if(
      heights_, [&](const Heights& heights) { return heights.line->fissure == fissure; });
  return found == heights_.end() ? nullptr : &*found;
}

float FissureOverlay::at(const Heights& heights, int x, int y) const {
  const int column = x / step_;
  const int row = y / step_;
  const float across = static_cast<float>(x % step_) / static_cast<float>(step_);
  const float down = static_cast<float>(y % step_) / static_cast<float>(step_);
  const float* v = heights.values.data() + row * heights.columns + column;
  const float upper = v[0] + (v[1] - v[0]) * across;
  v += heights.columns;
  const float lower = v[0] + (v[1] - v[0]) * across;
  return upper + (lower - upper) * down;
}

void FissureOverlay::split(std::vector<std::uint8_t>& labels) const {
  const Heights* left = of(Fissure::LeftOblique);
  const Heights* right = of(Fissure::RightOblique);
  const Heights* horizontal = of(Fissure::RightHorizontal);
  const auto lobeAt = [&](Lobe lung, int x, int y) {
    if (lung == Lobe::LeftLung && left != nullptr) {
      return at(*left, x, y) < 0.0F ? Lobe::LeftLower : Lobe::LeftUpper;
    }
    if (lung != Lobe::RightLung || right == nullptr || horizontal == nullptr) return lung;
    if (at(*right, x, y) < 0.0F) return Lobe::RightLower;
    return at(*horizontal, x, y) < 0.0F ? Lobe::RightMiddle : Lobe::RightUpper;
  };
  parallelFor(static_cast<std::size_t>(frame_.height), [&](std::size_t row) {
    std::uint8_t* label = labels.data() + row * static_cast<std::size_t>(frame_.width);
    for (int x = 0; x < frame_.width; ++x) {
      label[x] =
          static_cast<std::uint8_t>(lobeAt(static_cast<Lobe>(label[x]), x, static_cast<int>(row)));
    }
  });
}

void FissureOverlay::drawLines(Picture& picture, const std::vector<std::uint8_t>& labels,
                               double pixelRatio) const {
  const auto dash = static_cast<int>(std::lround(DashPixels * pixelRatio));
  const auto period = dash + static_cast<int>(std::lround(GapPixels * pixelRatio));
  const auto dot = std::max(1, static_cast<int>(std::lround(DotPixels * pixelRatio)));
  for (const Heights& heights : heights_) {
    const SliceFissures::Line& line = *heights.line;
    const Side of = side(line.fissure);
    const Heights* oblique =
        line.fissure == Fissure::RightHorizontal ? this->of(obliqueOf(of)) : nullptr;
    const double half = 0.5 * pixelRatio * (line.current ? CurrentLinePixels : LinePixels);
    parallelFor(static_cast<std::size_t>(frame_.height), [&](std::size_t row) {
      const int y = static_cast<int>(row);
      for (int x = 0; x < frame_.width; ++x) {
        const std::size_t pixelIndex =
            row * static_cast<std::size_t>(frame_.width) + static_cast<std::size_t>(x);
        if (side(static_cast<Lobe>(labels[pixelIndex])) != of) continue;
        const float height = at(heights, x, y);
        const float across = at(heights, std::min(x + 1, frame_.width - 1), y) - height;
        const float down = at(heights, x, std::min(y + 1, frame_.height - 1)) - height;
        const float steep = std::hypot(across, down);
        // To first order this many pixels from where it is zero.
        const double away = std::abs(height) / std::max(steep, 1e-6F);
        const double share = std::clamp(half + 0.5 - away, 0.0, 1.0);
        if (share == 0.0) continue;
        if (oblique != nullptr && at(*oblique, x, y) < 0.0F) continue;
        const int along = std::abs(across) > std::abs(down) ? y : x;
        const bool shows = !line.shows || line.shows(frame_.pointAt({x + 0.5, y + 0.5}));
        if (shows && line.proposed && along % period >= dash) continue;
        if (!shows && along % (2 * dot) >= dot) continue;
        const Rgb colour = !shows ? MissingColour : line.current ? CurrentColour : LineColour;
        setPixel(picture, x, y, mixed(pixel(picture, x, y), colour, share));
      }
    });
  }
}

void FissureOverlay::drawMarks(Picture& picture, double pixelRatio) const {
  const int normal = normalAxis(frame_.plane);
  for (const FissureMark& mark : fissures_.marks) {
    if (std::abs(mark.place[normal] - frame_.positionMm()) > fissures_.reachMm) continue;
    const PicturePoint at = frame_.drawnAt(mark.place);
    const Rgb colour = mark.suspect ? SuspectColour : mark.current ? CurrentColour : MarkColour;
    const double radius = MarkRadius * pixelRatio;
    drawRing(picture, at.x, at.y, radius, 4.0 * pixelRatio, {}, 0.7);
    drawRing(picture, at.x, at.y, radius, 2.0 * pixelRatio, colour);
    if (mark.handle) drawRing(picture, at.x, at.y, 0.5 * pixelRatio, 2.0 * pixelRatio, colour);
  }
}

}  // namespace pneuma
