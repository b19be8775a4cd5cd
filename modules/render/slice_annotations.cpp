#include "render/slice_annotations.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <cstdio>

#include "render/drawing.h"
#include "render/legend.h"
#include "render/overlay.h"

namespace pneuma {
namespace {

constexpr Rgb Ink = rgbOfHex(0xf2f5fa);
constexpr Rgb DimInk = rgbOfHex(0xc9d2df);
constexpr Rgb CrosshairColour = rgbOfHex(0x4aa8ff);
constexpr Rgb MarkerColour = rgbOfHex(0xf2b544);
constexpr double CrosshairShare = 0.65;
constexpr double CrosshairGap = 9.0;      // logical pixels left free round the point
constexpr double MarkerRadius = 5.0;      // logical pixels
constexpr double LongestScaleBar = 0.22;  // of the picture's width

const ImageGeometry* geometryOf(const SliceContents& contents) {
  if (contents.ct != nullptr) return &contents.ct->geometry;
  return contents.labels == nullptr ? nullptr : &contents.labels->geometry;
}

std::string capitalised(std::string_view word) {
  std::string text(word);
  text[0] = static_cast<char>(std::toupper(static_cast<unsigned char>(text[0])));
  return text;
}

/// Everything written round one picture.
class Writing {
 public:
  Writing(Picture& picture, double pixelRatio) : picture_(picture), ratio_(pixelRatio) {
    const double side = std::min(picture.width, picture.height) / ratio_;
    font_ = static_cast<int>(std::lround(ratio_ * std::clamp(0.024 * side, 12.0, 24.0)));
    margin_ = std::round(0.8 * font_);
    halo_ = std::max(1, static_cast<int>(std::lround(ratio_)));
  }

  void letters(const ViewAxes& axes) {
    const double middleX = 0.5 * picture_.width;
    const double middleY = 0.5 * picture_.height;
    say(orientationLetters(-axes.right), {margin_, middleY, Align::Low, Align::Middle});
    say(orientationLetters(axes.right), {right(), middleY, Align::High, Align::Middle});
    say(orientationLetters(axes.up), {middleX, margin_, Align::Middle, Align::Low});
    say(orientationLetters(-axes.up), {middleX, bottom(), Align::Middle, Align::High});
  }

  /// Lines from the upper left corner down, the first one brighter.
  void corner(const std::vector<std::string>& lines) {
    double y = margin_;
    for (std::size_t i = 0; i < lines.size(); ++i) {
      if (!fits(lines[i])) break;
      say(lines[i], {margin_, y, Align::Low, Align::Low}, i == 0 ? Ink : DimInk);
      y += std::round(1.45 * font_);
    }
  }

  /// The first of the texts that fits into the lower right corner.
  void lowerRight(const std::vector<std::string>& texts) {
    for (const std::string& text : texts) {
      if (!fits(text)) continue;
      say(text, {right(), bottom(), Align::High, Align::High}, DimInk);
      return;
    }
  }

  void scaleBar(double mmPerPixel) {
    const double lengthMm = scaleBarMm(1.0 / mmPerPixel, LongestScaleBar * picture_.width);
    if (lengthMm <= 0.0) return;
    std::array<char, 32> text{};
    std::snprintf(text.data(), text.size(), "%g mm", lengthMm);
    const double length = std::round(lengthMm / mmPerPixel);
    if (length + font_ + Overlay::textWidth(text.data(), font_) > 0.5 * picture_.width - margin_) {
      return;
    }
    const double line = std::max(1.0, std::round(1.4 * ratio_));
    const double tick = std::round(0.28 * font_);
    const double y = bottom() - std::round(0.36 * font_);
    // A dark seat first, so that it is seen over bone and table too.
    fillBox(picture_, margin_ - line, y - tick - line, margin_ + length + line, y + tick + line, {},
            0.35);
    fillBox(picture_, margin_, y - 0.5 * line, margin_ + length, y + 0.5 * line, Ink);
    fillBox(picture_, margin_, y - tick, margin_ + line, y + tick, Ink);
    fillBox(picture_, margin_ + length - line, y - tick, margin_ + length, y + tick, Ink);
    say(text.data(),
        {margin_ + length + std::round(0.6 * font_), bottom(), Align::Low, Align::High}, DimInk);
  }

  void crosshair(const PicturePoint& at) {
    const double thin = std::max(1.0, std::round(ratio_));
    const double gap = CrosshairGap * ratio_;
    const double x = std::floor(at.x) - std::floor(0.5 * thin);
    const double y = std::floor(at.y) - std::floor(0.5 * thin);
    const auto line = [&](double left, double top, double right, double bottom) {
      fillBox(picture_, left, top, right, bottom, CrosshairColour, CrosshairShare);
    };
    // The letters at the ends stay free.
    const double edge = margin_ + 1.5 * font_;
    line(edge, y, x - gap, y + thin);
    line(x + thin + gap, y, picture_.width - edge, y + thin);
    line(x, edge, x + thin, y - gap);
    line(x, y + thin + gap, x + thin, picture_.height - edge);
  }

  void marker(const PicturePoint& at) {
    drawRing(picture_, at.x, at.y, MarkerRadius * ratio_, 3.2 * ratio_, {}, 0.6);
    drawRing(picture_, at.x, at.y, MarkerRadius * ratio_, 1.6 * ratio_, MarkerColour);
  }

 private:
  double right() const { return picture_.width - margin_; }

  double bottom() const { return picture_.height - margin_; }

  /// Between a corner and the letter in the middle of the side.
  bool fits(const std::string& text) const {
    return Overlay::textWidth(text, font_) < 0.5 * picture_.width - margin_ - font_;
  }

  void say(const std::string& text, const TextPlace& place, const Rgb& ink = Ink) {
    drawText(picture_, text, place, font_, ink, halo_);
  }

  Picture& picture_;
  double ratio_;
  int font_;
  double margin_;
  int halo_;
};

std::vector<std::string> titleOf(const ImageGeometry& geometry, const SliceFrame& frame) {
  const SliceStack stack = sliceStack(geometry, frame.plane);
  const std::string_view plane = choices(SlicePlane{})[static_cast<std::size_t>(frame.plane)];
  std::vector<std::string> lines = {capitalised(plane) + "   " +
                                    positionText(normalAxis(frame.plane), frame.positionMm())};
  lines.push_back("slice " + std::to_string(stack.nearest(frame.positionMm()) + 1) + " of " +
                  std::to_string(stack.count));
  if (const double turn = obliqueDeg(geometry); turn > ObliqueFromDeg) {
    std::array<char, 64> text{};
    std::snprintf(text.data(), text.size(), "resampled, turned by %.1f deg", turn);
    lines.emplace_back(text.data());
  }
  return lines;
}

}  // namespace

void annotate(Picture& picture, const SliceContents& contents, const SliceFrame& frame,
              const SliceLook& look) {
  const ImageGeometry* geometry = geometryOf(contents);
  Writing writing(picture, look.pixelRatio);
  const int normal = normalAxis(frame.plane);
  const double reach =
      geometry == nullptr ? 0.5 : 0.5 * sliceStack(*geometry, frame.plane).stepMm + 1e-6;
  if (contents.crosshair) writing.crosshair(frame.drawnAt(*contents.crosshair));
  for (const Vec3& marker : contents.markers) {
    if (std::abs(marker[normal] - frame.positionMm()) <= reach) {
      writing.marker(frame.drawnAt(marker));
    }
  }
  if (!look.annotations) return;
  writing.letters(axesOf(frame.plane));
  writing.scaleBar(frame.mmPerPixel);
  if (geometry == nullptr) return;
  writing.corner(titleOf(*geometry, frame));
  if (contents.ct == nullptr) return;
  const std::string window = textOf(look.window);
  writing.lowerRight({window, window.substr(window.find("W "))});
}

}  // namespace pneuma
