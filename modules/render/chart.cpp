#include "render/chart.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <limits>

#include "render/drawing.h"
#include "render/overlay.h"

namespace pneuma {
namespace {

constexpr Rgb Paper = rgbOfHex(0xffffff);
constexpr Rgb Ink = rgbOfHex(0x23272e);
constexpr Rgb Grid = rgbOfHex(0xe3e6ea);
constexpr int MostSteps = 8;

struct AxisRange {
  double low = 0.0;
  double high = 1.0;
};

std::string numberLabel(double value) {
  std::array<char, 32> text{};
  std::snprintf(text.data(), text.size(), "%.6g", value);
  return text.data();
}

/// The least and the largest value of all curves.
AxisRange rangeOf(const Chart& chart, std::vector<double> ChartCurve::*values) {
  AxisRange range{std::numeric_limits<double>::infinity(),
                  -std::numeric_limits<double>::infinity()};
  for (const ChartCurve& curve : chart.curves) {
    for (const double value : curve.*values) {
      if (!std::isfinite(value)) continue;
      range.low = std::min(range.low, value);
      range.high = std::max(range.high, value);
    }
  }
  return range.low <= range.high ? range : AxisRange{};
}

/// Where values stand in the picture.
class Axes {
 public:
  Axes(const Chart& chart, int width, int height)
      : font_(std::max(11, height / 32)),
        xTicks_(ticksOf(chart, &ChartCurve::x)),
        yTicks_(ticksOf(chart, &ChartCurve::y)),
        left_(5.0 * font_),
        top_((chart.title.empty() ? 3.0 : 5.0) * font_),
        right_(width - 2.0 * font_),
        bottom_(height - 4.5 * font_) {}

  int font() const { return font_; }

  double left() const { return left_; }

  double top() const { return top_; }

  double right() const { return right_; }

  double bottom() const { return bottom_; }

  const std::vector<double>& xTicks() const { return xTicks_; }

  const std::vector<double>& yTicks() const { return yTicks_; }

  double x(double value) const {
    return left_ +
           (value - xTicks_.front()) / (xTicks_.back() - xTicks_.front()) * (right_ - left_);
  }

  double y(double value) const {
    return bottom_ -
           (value - yTicks_.front()) / (yTicks_.back() - yTicks_.front()) * (bottom_ - top_);
  }

 private:
  static std::vector<double> ticksOf(const Chart& chart, std::vector<double> ChartCurve::*values) {
    const AxisRange range = rangeOf(chart, values);
    return chartTicks(range.low, range.high);
  }

  int font_;
  std::vector<double> xTicks_;
  std::vector<double> yTicks_;
  double left_;
  double top_;
  double right_;
  double bottom_;
};

void drawLine(Picture& picture, double ax, double ay, double bx, double by, const Rgb& colour) {
  const std::array<std::array<double, 2>, 2> ends = {{{ax, ay}, {bx, by}}};
  drawPolyline(picture, ends, 1.0, colour);
}

void drawAxes(Picture& picture, const Chart& chart, const Axes& axes) {
  const int small = axes.font();
  for (const double tick : axes.xTicks()) {
    const double x = std::floor(axes.x(tick)) + 0.5;
    drawLine(picture, x, axes.top(), x, axes.bottom(), Grid);
    drawText(picture, numberLabel(tick), {x, axes.bottom() + 0.7 * small, Align::Middle}, small,
             Ink);
  }
  for (const double tick : axes.yTicks()) {
    const double y = std::floor(axes.y(tick)) + 0.5;
    drawLine(picture, axes.left(), y, axes.right(), y, Grid);
    drawText(picture, numberLabel(tick), {axes.left() - 0.6 * small, y, Align::High, Align::Middle},
             small, Ink);
  }
  drawLine(picture, axes.left(), axes.bottom(), axes.right(), axes.bottom(), Ink);
  drawLine(picture, axes.left(), axes.top(), axes.left(), axes.bottom(), Ink);
  drawText(picture, chart.xLabel,
           {0.5 * (axes.left() + axes.right()), axes.bottom() + 2.5 * small, Align::Middle}, small,
           Ink);
  drawText(picture, chart.yLabel,
           {axes.left() - 4.0 * small, axes.top() - 1.0 * small, Align::Low, Align::High}, small,
           Ink);
  drawText(picture, chart.title, {axes.left(), 1.2 * small}, small * 5 / 4, Ink);
}

void drawCurve(Picture& picture, const ChartCurve& curve, const Axes& axes) {
  const bool thin = curve.as == ChartCurve::As::ThinLine;
  const double thickness = thin ? 1.0 : std::max(2.0, axes.font() / 6.0);
  std::vector<std::array<double, 2>> points;
  const auto drawPart = [&] {
    drawPolyline(picture, points, thickness, curve.colour);
    points.clear();
  };
  for (std::size_t n = 0; n < curve.x.size(); ++n) {
    if (!std::isfinite(curve.x[n]) || !std::isfinite(curve.y[n])) {
      drawPart();
      continue;
    }
    const double x = axes.x(curve.x[n]);
    const double y = axes.y(curve.y[n]);
    if (curve.as != ChartCurve::As::Dots) {
      points.push_back({x, y});
    } else {
      drawRing(picture, x, y, 0.0, 2.0 * thickness, curve.colour);
    }
  }
  drawPart();
}

/// How much room a curve's line or dot takes beside its name.
double signWidth(const ChartCurve& curve, int font) {
  return (curve.as != ChartCurve::As::Dots ? 3.0 : 2.3) * font;
}

double keyWidth(const Chart& chart, int font) {
  double width = 0.0;
  for (const ChartCurve& curve : chart.curves) {
    if (!curve.name.empty()) width += Overlay::textWidth(curve.name, font) + signWidth(curve, font);
  }
  return width;
}

/// Names of the curves in the upper right corner, beside the title, or below one that is too long.
void drawKey(Picture& picture, const Chart& chart, const Axes& axes) {
  const int font = axes.font();
  double x = axes.right();
  const double title = Overlay::textWidth(chart.title, font * 5 / 4);
  const bool beside = axes.left() + title + 2.0 * font < axes.right() - keyWidth(chart, font);
  const double y = (chart.title.empty() ? 1.0 : beside ? 1.8 : 3.8) * font;
  for (auto curve = chart.curves.rbegin(); curve != chart.curves.rend(); ++curve) {
    if (curve->name.empty()) continue;
    drawText(picture, curve->name, {x, y, Align::High, Align::Middle}, font, Ink);
    x -= Overlay::textWidth(curve->name, font) + 0.5 * font;
    if (curve->as != ChartCurve::As::Dots) {
      const std::array<std::array<double, 2>, 2> ends = {{{x - 1.5 * font, y}, {x, y}}};
      drawPolyline(picture, ends, std::max(2.0, font / 6.0), curve->colour);
    } else {
      drawRing(picture, x - 0.5 * font, y, 0.0, 0.5 * font, curve->colour);
    }
    x -= signWidth(*curve, font) - 0.5 * font;
  }
}

}  // namespace

std::vector<double> chartTicks(double low, double high) {
  if (!(high > low)) {
    const double around = low == 0.0 ? 1.0 : 0.1 * std::abs(low);
    low -= around;
    high += around;
  }
  double step = std::pow(10.0, std::floor(std::log10((high - low) / MostSteps)));
  const double least = step;
  for (const double factor : {1.0, 2.0, 5.0, 10.0, 20.0}) {
    step = factor * least;
    if (std::ceil(high / step - 1e-9) - std::floor(low / step + 1e-9) <= MostSteps) break;
  }
  std::vector<double> ticks;
  const double first = std::floor(low / step + 1e-9);
  const double last = std::ceil(high / step - 1e-9);
  for (double n = first; n <= last; n += 1.0) ticks.push_back(n == 0.0 ? 0.0 : n * step);
  return ticks;
}

Picture chartPicture(const Chart& chart, int width, int height) {
  Picture picture = blank(width, height, Paper);
  const Axes axes(chart, width, height);
  drawAxes(picture, chart, axes);
  for (const ChartCurve& curve : chart.curves) drawCurve(picture, curve, axes);
  drawKey(picture, chart, axes);
  return picture;
}

Picture chartRow(const std::vector<Chart>& charts, int width, int height) {
  Picture row = blank(width * static_cast<int>(charts.size()), height, Paper);
  for (std::size_t n = 0; n < charts.size(); ++n) {
    put(chartPicture(charts[n], width, height), static_cast<int>(n) * width, 0, row);
  }
  return row;
}

}  // namespace pneuma
