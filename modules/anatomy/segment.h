#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string_view>

#include "anatomy/lobe.h"

namespace pneuma {

/// A bronchopulmonary segment. Numbers are those of the `segment` arrays in files: 1 to 10 for RB1
/// to RB10, 10 + n for LBn on the left (LB1+2 is 11; there is no 12 and no 17).
struct Segment {
  std::uint8_t number = 0;
  std::string_view name;      ///< of its bronchus: "RB1" ... "LB10"
  std::string_view longName;  ///< "apical segment of the right upper lobe"
  Lobe lobe = Lobe::Whole;
};

/// All 18, right before left.
std::span<const Segment> segments();

/// "RB1" ... "LB10"; "" for a number that is none.
std::string_view segmentName(std::uint8_t number);

std::optional<std::uint8_t> segmentOfName(std::string_view name);

}  // namespace pneuma
