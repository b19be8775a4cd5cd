#pragma once

#include <array>
#include <concepts>
#include <cstdint>
#include <string>
#include <string_view>
#include <tuple>
#include <type_traits>
#include <vector>

#include "core/error.h"

/// Options structs describe themselves once, in `static constexpr auto fields()`: a tuple of Field.
/// That one list feeds range checks, `--set key=value`, `--help`, JSON and the forms of the window.
namespace pneuma {

/// Closed interval of allowed values, in the field's unit.
struct Range {
  double low = 0.0;
  double high = 0.0;
};

/// One member of an options struct: how it is called, measured, limited and explained.
/// An enum member needs `constexpr auto choices(Enum)` beside the enum, returning an array of
/// names in the order of the values 0, 1, 2 ...
template <class Options, class Value>
struct Field {
  std::string_view name;  ///< as typed: lower case, words joined by '-'
  Value Options::*member;
  std::string_view unit;  ///< "mm", "deg", "" ...
  Range range;            ///< ignored for enums
  std::string_view help;  ///< one sentence

  using value_type = Value;
};

template <class T>
concept HasFields = requires {
  T::fields();
};

/// Calls `f(field)` for every field of `Options`.
template <HasFields Options, class F>
constexpr void forEachField(F&& f) {
  std::apply([&](const auto&... field) { (f(field), ...); }, Options::fields());
}

namespace detail {
double parseNumber(std::string_view key, std::string_view text, std::string_view unit);
[[noreturn]] void throwOutOfRange(std::string_view name, Range range, std::string_view unit,
                                  const std::string& value);
[[noreturn]] void throwUnknownChoice(std::string_view name, std::string_view text,
                                     const std::vector<std::string_view>& choices);
[[noreturn]] void throwUnknownKey(std::string_view key, const std::vector<std::string_view>& keys);
std::string numberText(double value);
}  // namespace detail

/// The value as people read and type it, without its unit.
template <class Value>
std::string textOf(const Value& value) {
  if constexpr (std::is_enum_v<Value>) {
    return std::string(choices(Value{})[static_cast<std::size_t>(value)]);
  } else if constexpr (std::is_floating_point_v<Value>) {
    return detail::numberText(value);
  } else {
    return std::to_string(value);
  }
}

/// @throws InvalidOption naming the first field that is out of range, its range and unit
template <HasFields Options>
void requireValid(const Options& options) {
  forEachField<Options>([&](const auto& field) {
    using Value = typename std::remove_cvref_t<decltype(field)>::value_type;
    if constexpr (!std::is_enum_v<Value>) {
      const double value = static_cast<double>(options.*(field.member));
      if (!(value >= field.range.low && value <= field.range.high)) {
        detail::throwOutOfRange(field.name, field.range, field.unit,
                                textOf(options.*(field.member)));
      }
    }
  });
}

/// Sets the field called `key` from text such as "0.41" or "1.2mm".
/// @throws InvalidOption for an unknown key (the nearest is suggested), no number, wrong unit,
/// range
template <HasFields Options>
void setOption(Options& options, std::string_view key, std::string_view text) {
  bool found = false;
  std::vector<std::string_view> keys;
  forEachField<Options>([&](const auto& field) {
    keys.push_back(field.name);
    if (field.name != key) return;
    found = true;
    using Value = typename std::remove_cvref_t<decltype(field)>::value_type;
    if constexpr (std::is_enum_v<Value>) {
      const auto names = choices(Value{});
      for (std::size_t i = 0; i < names.size(); ++i) {
        if (names[i] == text) {
          options.*(field.member) = static_cast<Value>(i);
          return;
        }
      }
      detail::throwUnknownChoice(key, text, {names.begin(), names.end()});
    } else {
      const double number = detail::parseNumber(key, text, field.unit);
      const bool inRange = number >= field.range.low && number <= field.range.high;
      // The range keeps the cast to an integer defined.
      const bool whole =
          std::is_floating_point_v<Value> ||
          (inRange && number == static_cast<double>(static_cast<std::int64_t>(number)));
      if (!inRange || !whole) {
        detail::throwOutOfRange(field.name, field.range, field.unit, std::string(text));
      }
      options.*(field.member) = static_cast<Value>(number);
    }
  });
  if (!found) detail::throwUnknownKey(key, keys);
}

/// The one of `words` that is most like `word` (edit distance), or "" if none is close.
std::string_view nearestWord(std::string_view word, const std::vector<std::string_view>& words);

}  // namespace pneuma
