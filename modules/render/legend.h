#pragma once

#include <set>
#include <string>
#include <vector>

#include "anatomy/lobe.h"
#include "render/colour.h"
#include "render/scene.h"

namespace pneuma {

/// What the colours of a picture mean: chips for kinds, a ramp with ticks for a continuous
/// quantity.
struct Legend {
  struct Chip {
    std::string label;
    std::string brief;  ///< for small pictures
    Rgb colour;
  };

  struct Tick {
    double position = 0.0;  ///< along the ramp, 0 .. 1
    std::string label;
  };

  std::string title;  ///< quantity and unit; empty for lobes, which say it themselves
  std::vector<Chip> chips;
  std::vector<Rgb> ramp;  ///< from low to high
  std::vector<Tick> ticks;

  bool empty() const { return chips.empty() && ramp.empty(); }
};

/// The lobes that are shown, as surfaces or airways.
Legend lobeLegend(const std::set<Lobe>& lobes, Palette palette, Background background);

/// A continuous or counted quantity on the scale of colour_map.h.
class Scale {
 public:
  enum class Kind { Count, Linear, LogarithmicMm, LogarithmicShare };

  /// @pre low <= high, and low > 0 for logarithmic kinds
  Scale(Kind kind, double low, double high);

  /// Position of a value along the scale, 0 .. 1.
  double position(double value) const;

  Legend legend(const std::string& title, Background background) const;

 private:
  Kind kind_;
  double low_;
  double high_;
};

/// The longest round length (1, 2, 5 x 10^n mm) that takes at most `maxPixels`; 0 if there is none
/// between 0.01 mm and 1 m.
double scaleBarMm(double pixelsPerMm, double maxPixels);

}  // namespace pneuma
