#include "anatomy/fissure.h"

#include <algorithm>

namespace pneuma {
namespace {

struct Names {
  std::string_view shortName;
  std::string_view longName;
};

constexpr std::array<Names, 3> All = {{{"right-oblique", "right oblique fissure"},
                                       {"right-horizontal", "right horizontal fissure"},
                                       {"left-oblique", "left oblique fissure"}}};

}  // namespace

std::string_view shortName(Fissure fissure) {
  return All[static_cast<std::size_t>(fissure)].shortName;
}

std::string_view longName(Fissure fissure) {
  return All[static_cast<std::size_t>(fissure)].longName;
}

std::optional<Fissure> fissureOfShortName(std::string_view text) {
  const auto found = std::ranges::find(All, text, &Names::shortName);
  if (found == All.end()) return std::nullopt;
  return static_cast<Fissure>(found - All.begin());
}

Side side(Fissure fissure) { return fissure == Fissure::LeftOblique ? Side::Left : Side::Right; }

}  // namespace pneuma
