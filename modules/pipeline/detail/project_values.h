#pragma once

#include <cmath>
#include <limits>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>

#include "anatomy/fissure.h"
#include "anatomy/lobe.h"
#include "core/options.h"
#include "core/triangle_mesh.h"
#include "io/exact_text.h"
#include "io/json.h"

// How values of all kinds stand in project.json.
namespace pneuma {

/// A struct of which describe(archive, value) lists the members once, for saving and opening.
template <class Archive, class T>
concept Described = requires(Archive& archive, T& value) {
  describe(archive, value);
};

/// That `T` is `Of`, or `Of` that is only read.
template <class T, class Of>
concept Is = std::is_same_v<std::remove_const_t<T>, Of>;

template <class T>
inline constexpr bool IsVector = false;
template <class T>
inline constexpr bool IsVector<std::vector<T>> = true;
template <class T>
inline constexpr bool IsArray = false;
template <class T, std::size_t N>
inline constexpr bool IsArray<std::array<T, N>> = true;
template <class T>
inline constexpr bool IsMap = false;
template <class K, class T>
inline constexpr bool IsMap<std::map<K, T>> = true;
template <class T>
inline constexpr bool IsOptional = false;
template <class T>
inline constexpr bool IsOptional<std::optional<T>> = true;
template <class T>
inline constexpr bool IsShared = false;
template <class T>
inline constexpr bool IsShared<std::shared_ptr<const T>> = true;
template <class T>
inline constexpr bool IsPair = false;
template <class A, class B>
inline constexpr bool IsPair<std::pair<A, B>> = true;

/// Vectors and matrices of fixed size: a list of their numbers.
template <class T>
concept FixedMatrix = requires {
  T::SizeAtCompileTime;
  T::RowsAtCompileTime;
}

&&std::is_same_v<typename T::Scalar, double>;

/// Of enums without choices().
inline std::string projectName(Lobe lobe) { return std::string(shortName(lobe)); }

inline std::string projectName(Side side) { return std::string(name(side)); }

inline std::string projectName(Fissure fissure) { return std::string(shortName(fissure)); }

template <class Enum>
std::string projectName(Enum value) {
  return textOf(value);
}

inline std::optional<Lobe> valueOfName(std::string_view text, Lobe) {
  return lobeOfShortName(text);
}

inline std::optional<Fissure> valueOfName(std::string_view text, Fissure) {
  return fissureOfShortName(text);
}

inline std::optional<Side> valueOfName(std::string_view text, Side) {
  for (const Side side : {Side::None, Side::Right, Side::Left}) {
    if (name(side) == text) return side;
  }
  return {};
}

template <class Enum>
std::optional<Enum> valueOfName(std::string_view text, Enum) {
  const auto names = choices(Enum{});
  for (std::size_t i = 0; i < names.size(); ++i) {
    if (names[i] == text) return static_cast<Enum>(i);
  }
  return {};
}

/// JSON has no word for numbers that are none, or without end.
inline Json jsonOf(double value) {
  if (std::isnan(value)) return "nan";
  if (std::isinf(value)) return value > 0.0 ? "inf" : "-inf";
  return value;
}

inline std::optional<double> numberOf(const Json& json) {
  if (json.is_number()) return json.get<double>();
  if (json == "nan") return std::numeric_limits<double>::quiet_NaN();
  if (json == "inf") return std::numeric_limits<double>::infinity();
  if (json == "-inf") return -std::numeric_limits<double>::infinity();
  return {};
}

}  // namespace pneuma
