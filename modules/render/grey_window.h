#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>

namespace pneuma {

/// Which Hounsfield units of a CT are shown between black and white.
struct GreyWindow {
  double widthHu = 1500.0;
  double levelHu = -600.0;  ///< the middle

  bool operator==(const GreyWindow&) const = default;

  /// 0 at and below level - width / 2, 255 at and above level + width / 2.
  std::uint8_t grey(double hu) const;
};

/// Widths that a window may have, and levels, HU.
inline constexpr double NarrowestWindowHu = 1.0;
inline constexpr double WidestWindowHu = 10000.0;

/// A window that radiologists know by name.
struct NamedWindow {
  std::string_view name;   ///< as typed: "lung-soft"
  std::string_view title;  ///< as shown: "Lung soft"
  GreyWindow window;
};

/// Lung (the default), lung soft, mediastinum, bone, emphysema.
std::span<const NamedWindow> greyWindows();

/// One of greyWindows() by name, or WIDTH/LEVEL in HU: "1500/-600". @throws InvalidOption
GreyWindow greyWindow(std::string_view text);

/// "Lung   W 1500   L -600"; without a name where it has none.
std::string textOf(const GreyWindow& window);

}  // namespace pneuma
