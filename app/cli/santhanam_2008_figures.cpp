#include <algorithm>
#include <array>
#include <cmath>

#include "cli/breath_picture.h"
#include "cli/paper_figure.h"
#include "pipeline/network_experiments.h"
#include "pipeline/santhanam_2008.h"
#include "render/chart.h"

namespace pneuma::cli {
namespace {

constexpr int MotionWidth = 640;
constexpr int MotionHeight = 520;
constexpr std::array<Rgb, 3> AxisColours = {rgbOfHex(0x1f6fc8), rgbOfHex(0xe0872a),
                                            rgbOfHex(0x2a9650)};

/// Fig. 2: breaths with noise, and the equation fitted to them.
Picture fittedBreaths(const Reproduction&, const Progress&) {
  std::vector<Picture> pictures;
  std::vector<std::string> captions;
  for (const Breathing breathing : {Breathing::Quiet, Breathing::Copd}) {
    const MeasuredBreath measured = measuredScenario(breathing, 0.01);
    pictures.push_back(breathPicture(fitBreath(measured).cycle, measured));
    captions.emplace_back(scenarioOf(breathing).title);
  }
  return contactSheet(pictures, 1, captions);
}

/// Fig. 4: the box around both lungs, and which share of it they fill, while
/// volume rises.
Picture boxes(const Reproduction&, const Progress& progress) {
  const InhaledVolumes lungs = inhaledVolumes(progress);
  Chart lengths{"The lungs' box", "volume breathed in, l", "length, mm", {}};
  constexpr std::array<const char*, 3> Names = {"width", "depth", "height"};
  for (std::size_t axis = 0; axis < Names.size(); ++axis) {
    lengths.curves.push_back({Names[axis], lungs.litres, lungs.boxMm[axis], AxisColours[axis]});
  }
  const Chart share{"Lungs by their box",
                    "volume breathed in, l",
                    "share of its volume",
                    {{"", lungs.litres, lungs.boxShare, AxisColours[0]}}};
  return chartRow({lengths, share}, MotionWidth, MotionHeight);
}

/// Fig. 7: how fast both methods come to rest.
Picture approaches(const Reproduction&, const Progress&) {
  const BentPlane bent = bentPlane();
  Chart chart{"Towards the rest state of a plane of 21 x 21",
              "rounds or steps",
              "log10 of the rms difference, %",
              {}};
  const auto add = [&](const char* name, const Approach& approach, const Rgb& colour) {
    ChartCurve curve{name, approach.steps, {}, colour};
    for (const double percent : approach.percent) curve.y.push_back(std::log10(percent));
    chart.curves.push_back(std::move(curve));
  };
  add("pitching", bent.pitching, AxisColours[0]);
  add("damped", bent.critical, AxisColours[1]);
  add("lightly damped", bent.light, AxisColours[2]);
  return chartPicture(chart, MotionWidth + MotionWidth / 4, MotionHeight);
}

/// Edges of a mesh as one line with gaps.
ChartCurve edgesOf(const TriangleMesh& mesh, const std::vector<Vec3>& points, const Rgb& colour) {
  ChartCurve curve{"", {}, {}, colour, ChartCurve::As::ThinLine};
  for (const auto& triangle : mesh.triangles) {
    for (const std::uint32_t corner : {triangle[0], triangle[1], triangle[2], triangle[0]}) {
      curve.x.push_back(points[corner].x());
      curve.y.push_back(points[corner].y());
    }
    curve.x.push_back(std::nan(""));
    curve.y.push_back(std::nan(""));
  }
  return curve;
}

/// Nothing to see, so that two charts have the same axes.
ChartCurve frameOf(double left, double right, double low, double high) {
  const double none = std::nan("");
  return {"", {left, right, none, none}, {none, none, low, high}, {}};
}

/// Fig. 8: the plane before and after, seen from the side and above.
Picture plane(const Reproduction&, const Progress&) {
  constexpr double AcrossMm = 25.0;  // shown for the largest displacement
  const BentPlane bent = bentPlane();
  const double most = *std::ranges::max_element(bent.forces);
  std::vector<Chart> charts;
  for (const double shown : {0.0, AcrossMm}) {
    std::vector<Vec3> seen;
    for (std::size_t n = 0; n < bent.mesh.points.size(); ++n) {
      const Vec3& p = bent.mesh.points[n];
      seen.emplace_back(p.x() + 0.5 * p.y(), 0.4 * p.y() + shown * bent.forces[n] / most, 0.0);
    }
    charts.push_back({shown > 0.0 ? "Bent" : "At rest",
                      "mm",
                      "mm",
                      {edgesOf(bent.mesh, seen, AxisColours[0]), frameOf(0.0, 60.0, -2.0, 36.0)}});
  }
  return chartRow(charts, MotionWidth, MotionHeight);
}

/// Fig. 9: the disc before and after, stiff masses 16 times as stiff.
Picture disc(const Reproduction&, const Progress&) {
  constexpr double OutwardsMm = 8.0;  // shown for the largest displacement
  const BlownDisc blown = blownDisc(16.0);
  const double most = *std::ranges::max_element(blown.moved);
  std::vector<Chart> charts;
  for (const double shown : {0.0, OutwardsMm}) {
    std::vector<Vec3> seen;
    ChartCurve soft{"soft", {}, {}, AxisColours[0], ChartCurve::As::Dots};
    ChartCurve stiff{"stiff", {}, {}, AxisColours[1], ChartCurve::As::Dots};
    for (std::size_t n = 0; n < blown.mesh.points.size(); ++n) {
      const Vec3& p = blown.mesh.points[n];
      const Vec3 outwards = p.isZero() ? Vec3(p) : Vec3(p.normalized());
      seen.push_back(p + shown * blown.moved[n] / most * outwards);
      ChartCurve& curve = blown.stiff[n] ? stiff : soft;
      curve.x.push_back(seen.back().x());
      curve.y.push_back(seen.back().y());
    }
    charts.push_back({shown > 0.0 ? "Blown up" : "At rest",
                      "mm",
                      "mm",
                      {edgesOf(blown.mesh, seen, rgbOfHex(0xc3c8d0)), soft, stiff,
                       frameOf(-30.0, 30.0, -30.0, 30.0)}});
  }
  return chartRow(charts, MotionHeight, MotionHeight);
}

constexpr std::array<PaperFigure, 5> Santhanam2008Pictures = {{{"fig2.png", fittedBreaths},
                                                               {"fig4.png", boxes},
                                                               {"fig7.png", approaches},
                                                               {"fig8.png", plane},
                                                               {"fig9.png", disc}}};

}  // namespace

std::span<const PaperFigure> santhanam2008Figures() { return Santhanam2008Pictures; }

}  // namespace pneuma::cli
