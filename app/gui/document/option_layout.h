#pragma once

#include <QString>
#include <optional>
#include <string>
#include <vector>

#include "growth/growth.h"

namespace pneuma {

/// Options that belong together, in the order in which they are shown.
struct OptionGroup {
  QString title;  ///< empty if it is the only group
  std::vector<std::string> names;
};

/// How the window arranges the options of a method. Every option is in one place.
struct OptionLayout {
  std::vector<std::string> usual;   ///< shown at once
  std::vector<OptionGroup> groups;  ///< under "Advanced"
};

/// A method without an arrangement of its own shows terminals, containment and seed at once. An
/// option that no group names comes into a last one, so that none is ever hidden.
OptionLayout optionLayout(const GrowthMethod& method);

/// The options that reproduce the method's paper, where its defaults go beyond.
std::optional<GrowthOptions> paperOptions(const GrowthMethod& method);

}  // namespace pneuma
