#pragma once

#include <array>
#include <string_view>

namespace pneuma {

/// What may leave its lobe.
enum class Containment {
  None,      ///< anything, as in the papers
  Ends,      ///< branch ends stay inside
  Branches,  ///< branches stay inside from end to end
};

constexpr std::array<std::string_view, 3> choices(Containment) {
  return {"none", "ends", "branches"};
}

}  // namespace pneuma
