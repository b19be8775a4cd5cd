#include "core/options.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <numeric>

namespace pneuma {
namespace {

std::size_t editDistance(std::string_view a, std::string_view b) {
  std::vector<std::size_t> row(b.size() + 1);
  std::iota(row.begin(), row.end(), std::size_t{0});
  for (std::size_t i = 1; i <= a.size(); ++i) {
    std::size_t diagonal = row[0];
    row[0] = i;
    for (std::size_t j = 1; j <= b.size(); ++j) {
      const std::size_t above = row[j];
      row[j] = std::min({row[j] + 1, row[j - 1] + 1, diagonal + (a[i - 1] == b[j - 1] ? 0U : 1U)});
      diagonal = above;
    }
  }
  return row.back();
}

std::string listed(const std::vector<std::string_view>& words) {
  std::string text;
  for (const std::string_view word : words) {
    if (!text.empty()) text += ", ";
    text += word;
  }
  return text;
}

}  // namespace

std::string_view nearestWord(std::string_view word, const std::vector<std::string_view>& words) {
  std::string_view best;
  std::size_t bestDistance = std::max<std::size_t>(2, word.size() / 3) + 1;
  for (const std::string_view candidate : words) {
    const std::size_t distance = editDistance(word, candidate);
    if (distance < bestDistance) {
      bestDistance = distance;
      best = candidate;
    }
  }
  return best;
}

namespace detail {

std::string numberText(double value) {
  std::array<char, 32> buffer{};
  const auto result = std::to_chars(buffer.data(), buffer.data() + buffer.size(), value);
  return {buffer.data(), result.ptr};
}

double parseNumber(std::string_view key, std::string_view text, std::string_view unit) {
  double number = 0.0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  std::string_view rest(end, static_cast<std::size_t>(text.data() + text.size() - end));
  while (!rest.empty() && rest.front() == ' ') rest.remove_prefix(1);
  if (error != std::errc{} || !std::isfinite(number)) {
    throw InvalidOption(std::string(key) + " needs a number, but '" + std::string(text) +
                        "' is none");
  }
  if (!rest.empty() && rest != unit) {
    throw InvalidOption(std::string(key) + (unit.empty() ? " has no unit" : " is measured in ") +
                        std::string(unit) + ", but '" + std::string(text) + "' was given");
  }
  return number;
}

void throwOutOfRange(std::string_view name, Range range, std::string_view unit,
                     const std::string& value) {
  throw InvalidOption(std::string(name) + " must lie in [" + numberText(range.low) + ", " +
                      numberText(range.high) + "]" + (unit.empty() ? "" : " ") + std::string(unit) +
                      ", but is " + value);
}

void throwUnknownChoice(std::string_view name, std::string_view text,
                        const std::vector<std::string_view>& choices) {
  throw InvalidOption(std::string(name) + " is one of " + listed(choices) + ", but '" +
                      std::string(text) + "' was given");
}

void throwUnknownKey(std::string_view key, const std::vector<std::string_view>& keys) {
  const std::string_view nearest = nearestWord(key, keys);
  throw InvalidOption("there is no option '" + std::string(key) + "'" +
                      (nearest.empty() ? "; there are: " + listed(keys)
                                       : "; did you mean '" + std::string(nearest) + "'?"));
}

}  // namespace detail
}  // namespace pneuma
