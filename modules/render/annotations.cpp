#include "render/annotations.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>

namespace pneuma {
namespace {

constexpr int SmallestWidth = 200;  // logical pixels; smaller pictures have no room for text
constexpr int SmallestHeight = 150;
constexpr int LongNamesFrom = 640;
constexpr double ChipGap = 0.55;  // in font heights, between a chip and its label
constexpr double RampWidth = 0.9;
constexpr double LongestScaleBar = 0.2;  // of the picture's width

}  // namespace

void Annotations::arrange(int width, int height, const Legend& legend,
                          const SceneOptions& options) {
  width_ = width;
  height_ = height;
  legend_ = legend;
  shown_ = options.annotations && width >= SmallestWidth && height >= SmallestHeight;
  shadow_ = options.background == Background::Dark;
  ink_ = rgbOfHex(options.background == Background::Dark ? 0xdfe5ee : 0x1b2330);
  font_ = std::max(11, static_cast<int>(std::lround(0.019 * height)));
  margin_ = 0.9 * font_;
  if (!shown_) {
    const double edge = 0.03 * std::min(width, height);
    insets_ = {edge, edge, edge, edge};
    return;
  }
  const double band = margin_ + 1.7 * font_;
  insets_ = {band, band, band, band};
  double text = 0.0;
  for (const Legend::Chip& chip : legend_.chips) {
    text = std::max(text, Overlay::textWidth(label(chip), font_));
  }
  for (const Legend::Tick& tick : legend_.ticks) {
    text = std::max(text, Overlay::textWidth(tick.label, font_));
  }
  if (!legend_.empty()) {
    const double column =
        std::max((RampWidth + ChipGap) * font_ + text, Overlay::textWidth(legend_.title, font_));
    insets_.right += column + margin_;
  }
}

const std::string& Annotations::label(const Legend::Chip& chip) const {
  return width_ >= LongNamesFrom ? chip.label : chip.brief;
}

void Annotations::draw(const ViewAxes& axes, double pixelsPerMm, double pixelRatio) {
  overlay_.begin(pixelRatio);
  if (shown_) {
    drawLetters(axes);
    drawScaleBar(pixelsPerMm);
    if (!legend_.chips.empty()) drawChips();
    if (!legend_.ramp.empty()) drawRamp();
  }
  overlay_.end();
}

void Annotations::say(const std::string& text, const Overlay::Place& place) {
  overlay_.text(text, place, font_, ink_, shadow_);
}

void Annotations::drawLetters(const ViewAxes& axes) {
  using Anchor = Overlay::Anchor;
  const double legendWidth = insets_.right - insets_.left;
  const double right = width_ - legendWidth - margin_;
  const double middleX = 0.5 * (insets_.left + width_ - insets_.right);
  const double middleY = 0.5 * height_;
  const Vec3 down = -axes.up;
  const Vec3 left = -axes.right;
  say(orientationLetters(left), {margin_, middleY, Anchor::Low, Anchor::Middle});
  say(orientationLetters(axes.right), {right, middleY, Anchor::High, Anchor::Middle});
  say(orientationLetters(axes.up), {middleX, height_ - margin_, Anchor::Middle, Anchor::High});
  say(orientationLetters(down), {middleX, margin_, Anchor::Middle, Anchor::Low});
}

void Annotations::drawScaleBar(double pixelsPerMm) {
  const double middleX = 0.5 * (insets_.left + width_ - insets_.right);
  const double widestText = Overlay::textWidth("1000 mm", font_);
  const double room = middleX - 2.5 * margin_ - 1.5 * font_ - widestText;
  const double lengthMm = scaleBarMm(pixelsPerMm, std::min(room, LongestScaleBar * width_));
  if (lengthMm <= 0.0) return;
  const double length = lengthMm * pixelsPerMm;
  const double y = margin_ + 0.45 * font_;
  const double thickness = std::max(1.0, std::round(font_ / 9.0));
  const double tick = 0.3 * font_;
  overlay_.box(margin_, y - 0.5 * thickness, margin_ + length, y + 0.5 * thickness, ink_);
  overlay_.box(margin_, y - tick, margin_ + thickness, y + tick, ink_);
  overlay_.box(margin_ + length - thickness, y - tick, margin_ + length, y + tick, ink_);
  std::array<char, 32> text{};
  std::snprintf(text.data(), text.size(), "%g mm", lengthMm);
  say(text.data(),
      {margin_ + length + 0.5 * font_, y, Overlay::Anchor::Low, Overlay::Anchor::Middle});
}

void Annotations::drawChips() {
  const double titleRows = legend_.title.empty() ? 0.0 : 1.2;
  const double rows = static_cast<double>(legend_.chips.size()) + titleRows;
  const double row = std::min(1.6 * font_, (height_ - 2.0 * margin_) / rows);
  const double left = width_ - (insets_.right - insets_.left);
  double y = 0.5 * (height_ + row * rows) - 0.5 * row;
  if (!legend_.title.empty()) {
    say(legend_.title, {left, y, Overlay::Anchor::Low, Overlay::Anchor::Middle});
    y -= 1.2 * row;
  }
  const double chip = std::min(RampWidth * font_, 0.8 * row);
  for (const Legend::Chip& entry : legend_.chips) {
    overlay_.box(left, y - 0.5 * chip, left + chip, y + 0.5 * chip, entry.colour);
    say(label(entry),
        {left + (RampWidth + ChipGap) * font_, y, Overlay::Anchor::Low, Overlay::Anchor::Middle});
    y -= row;
  }
}

void Annotations::drawRamp() {
  const double left = width_ - (insets_.right - insets_.left);
  const double bottom = 0.22 * height_;
  const double top = 0.74 * height_;
  say(legend_.title, {left, top + 1.3 * font_, Overlay::Anchor::Low, Overlay::Anchor::Low});
  const double step = (top - bottom) / static_cast<double>(legend_.ramp.size());
  const double width = RampWidth * font_;
  for (std::size_t i = 0; i < legend_.ramp.size(); ++i) {
    const double y = bottom + step * static_cast<double>(i);
    overlay_.box(left, y, left + width, y + step, legend_.ramp[i]);
  }
  for (const Legend::Tick& tick : legend_.ticks) {
    const double y = bottom + tick.position * (top - bottom);
    overlay_.box(left + width, y - 0.5, left + width + 0.25 * font_, y + 0.5, ink_);
    say(tick.label,
        {left + width + ChipGap * font_, y, Overlay::Anchor::Low, Overlay::Anchor::Middle});
  }
}

}  // namespace pneuma
