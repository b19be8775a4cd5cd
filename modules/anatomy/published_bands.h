#pragma once

#include <span>
#include <string_view>

namespace pneuma {

/// What the literature says about one figure of an adult's lungs, both of them, from the trachea to
/// the terminal bronchioles. A band whose ends are equal is a single published value.
struct PublishedBand {
  std::string_view
      quantity;  ///< key in the report, levels joined by dots: "gap_mean", "strahler.Rb"
  double low = 0.0;
  double high = 0.0;
  std::string_view source;  ///< "(recalled)": from memory, not checked against the paper
};

/// All bands, in the order of the report.
std::span<const PublishedBand> publishedBands();

}  // namespace pneuma
