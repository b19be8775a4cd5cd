#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <string_view>

#include "core/domain.h"

namespace pneuma {

/// A region of the lungs. The values are those of label images and of the `lobe` arrays in files.
enum class Lobe : std::uint8_t {
  Whole = 0,  ///< an organ that is not split, or unknown
  RightUpper = 1,
  RightMiddle = 2,
  RightLower = 3,
  LeftUpper = 4,
  LeftLower = 5,
  Central = 6,  ///< trachea and bronchi before they enter a lobe
  RightLung = 10,
  LeftLung = 20,
};

enum class Side : std::uint8_t { None = 0, Right = 1, Left = 2 };

/// The five lobes, right before left, upper before lower.
inline constexpr std::array<Lobe, 5> FiveLobes = {
    Lobe::RightUpper, Lobe::RightMiddle, Lobe::RightLower, Lobe::LeftUpper, Lobe::LeftLower};

Side side(Lobe lobe);

/// "RUL", "RML", "RLL", "LUL", "LLL", "central", "right", "left", "whole".
std::string_view shortName(Lobe lobe);

/// "right upper lobe", ...
std::string_view longName(Lobe lobe);

std::string_view name(Side side);  ///< "none", "right", "left"

/// The lobe with this short name, in any case.
std::optional<Lobe> lobeOfShortName(std::string_view text);

/// The lobe or lung that a file name speaks of: `rul`, `rml`, `rll`, `lul`, `lll` in any case,
/// anywhere in the stem as a word of its own ("Case_1-RUL.stl"), else `right`, `left`.
std::optional<Lobe> lobeOfFileName(std::string_view fileName);

/// A lobe and the region it takes.
struct LobeRegion {
  Lobe lobe = Lobe::Whole;
  std::shared_ptr<const Domain> domain;
};

}  // namespace pneuma
