#include "render/grey_window.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <cstdio>
#include <optional>
#include <vector>

#include "core/options.h"

namespace pneuma {
namespace {

constexpr std::array<NamedWindow, 5> Windows = {{{"lung", "Lung", {1500.0, -600.0}},
                                                 {"lung-soft", "Lung soft", {1400.0, -500.0}},
                                                 {"mediastinum", "Mediastinum", {350.0, 40.0}},
                                                 {"bone", "Bone", {2000.0, 300.0}},
                                                 {"emphysema", "Emphysema", {500.0, -850.0}}}};

std::optional<double> numberOf(std::string_view text) {
  double number = 0.0;
  const char* const end = text.data() + text.size();
  const auto [rest, error] = std::from_chars(text.data(), end, number);
  if (error != std::errc{} || rest != end || !std::isfinite(number)) return std::nullopt;
  return number;
}

}  // namespace

std::uint8_t GreyWindow::grey(double hu) const {
  const double share = (hu - levelHu) / widthHu + 0.5;
  return static_cast<std::uint8_t>(std::clamp(share, 0.0, 1.0) * 255.0 + 0.5);
}

std::span<const NamedWindow> greyWindows() { return Windows; }

GreyWindow greyWindow(std::string_view text) {
  std::vector<std::string_view> names;
  for (const NamedWindow& named : Windows) {
    if (named.name == text) return named.window;
    names.push_back(named.name);
  }
  const std::size_t slash = text.find('/');
  if (slash == std::string_view::npos) {
    std::string sentence = "window '" + std::string(text) + "' is unknown";
    if (const auto nearest = nearestWord(text, names); !nearest.empty()) {
      sentence += "; did you mean '" + std::string(nearest) + "'?";
    }
    throw InvalidOption(sentence +
                        " It is lung, lung-soft, mediastinum, bone, emphysema, or WIDTH/LEVEL in "
                        "HU, such as 1500/-600");
  }
  const auto width = numberOf(text.substr(0, slash));
  const auto level = numberOf(text.substr(slash + 1));
  if (!width || !level || *width < NarrowestWindowHu || *width > WidestWindowHu ||
      std::abs(*level) > WidestWindowHu) {
    throw InvalidOption("window '" + std::string(text) +
                        "' must be WIDTH/LEVEL in HU, such as 1500/-600; the width from 1 to "
                        "10000, the level from -10000 to 10000");
  }
  return {*width, *level};
}

std::string textOf(const GreyWindow& window) {
  std::string text;
  for (const NamedWindow& named : Windows) {
    if (named.window == window) text = std::string(named.title) + "   ";
  }
  std::array<char, 64> numbers{};
  std::snprintf(numbers.data(), numbers.size(), "W %.0f   L %.0f", window.widthHu, window.levelHu);
  return text + numbers.data();
}

}  // namespace pneuma
