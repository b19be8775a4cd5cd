#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "anatomy/airway_tree.h"

namespace pneuma {

/// A branching, length or diameter ratio: exp of the absolute slope of ln(number or mean) against
/// order by least squares, and how well the line fits. Ratio 0 where fewer than two orders occur.
struct OrderRatio {
  double ratio = 0.0;
  double r2 = 0.0;
};

struct OrderRatios {
  OrderRatio branching;             ///< Rb, from the number of elements by order
  OrderRatio length;                ///< Rl, from mean lengths
  OrderRatio diameter;              ///< Rd, from mean diameters
  std::vector<std::size_t> counts;  ///< elements of order 1, 2, ...
};

/// Ratios over the `branches` of `tree`, `orders` being Horsfield's or Strahler's order of every
/// branch of the whole tree.
///
/// What is counted are elements: branches of one order that follow each other count as one, with
/// their lengths added and their diameters averaged by length (Horsfield, Relea & Cumming 1976).
OrderRatios orderRatios(const AirwayTree& tree, std::span<const int> orders,
                        std::span<const std::size_t> branches);

}  // namespace pneuma
