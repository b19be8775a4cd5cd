#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "anatomy/morphometry.h"
#include "io/json.h"

/// What tables of the figures of trees are made of, for people and as CSV.
namespace pneuma {

/// Figures that are known, by their keys in the report, levels joined by dots: "strahler.Rb".
using Figures = std::vector<std::pair<std::string, double>>;

/// Every number in the "morphometry" object of the report, in its order. Items of a list go by
/// their place, 1, 2, ...
Figures figuresOf(const Morphometry& morphometry);

/// Text as a field of a CSV file.
std::string csvQuoted(std::string_view text);

/// The ends of a figure's band and its source as three fields of a CSV file, empty where `bands`
/// have none for `quantity`.
std::string csvBand(std::span<const PublishedBand> bands, std::string_view quantity);

/// A line of a table. `key` is the figure's place in the JSON report, levels joined by slashes.
struct FigureLine {
  std::string_view key;
  std::string_view label;
  int decimals = 2;
  bool byLobe = true;  ///< also shown for every lobe
};

/// The lines that a table of morphometry has, with keys in its "morphometry" object.
std::span<const FigureLine> morphometryLines();

/// The figure at a line's key; null if there is none.
Json figureAt(const Json& report, std::string_view key);

/// A figure, or the mean of a summary; nothing if it is not known.
std::optional<double> meanOf(const Json& figure);

/// The published band of a figure or of its mean, if there is one.
std::optional<PublishedBand> bandOf(const FigureLine& line);

/// The same as texts, the band and its source; empty if there is none.
std::vector<std::string> bandText(const FigureLine& line);

/// `value` with `decimals` behind the point.
std::string fixed(double value, int decimals);

/// Columns two spaces apart, flush left.
std::string textTable(const std::vector<std::vector<std::string>>& rows);

}  // namespace pneuma
