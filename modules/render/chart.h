#pragma once

#include <string>
#include <vector>

#include "render/colour.h"
#include "render/picture.h"

namespace pneuma {

/// A row of points of a chart.
struct ChartCurve {
  enum class As { Line, ThinLine, Dots };

  std::string name;  ///< in the key; empty: not there
  std::vector<double> x;
  std::vector<double> y;  ///< as many
  Rgb colour;
  As as = As::Line;
};

/// Curves over two axes, which go from the least to the largest value in round steps.
struct Chart {
  std::string title;
  std::string xLabel;  ///< with its unit
  std::string yLabel;
  std::vector<ChartCurve> curves;
};

/// Round numbers from at or below `low` to at or above `high`, at most nine.
std::vector<double> chartTicks(double low, double high);

/// Draws a chart, dark on white; needs no display. Values that are no numbers are left out.
Picture chartPicture(const Chart& chart, int width, int height);

/// Charts of one size side by side.
Picture chartRow(const std::vector<Chart>& charts, int width, int height);

}  // namespace pneuma
