#pragma once

#include <span>
#include <vector>

namespace pneuma {

/// The indices 0 .. n - 1 so that parents come before their children: as they are if that holds
/// already, otherwise one way down after the other. Items that do not lead back to the root (they
/// form cycles) are left out.
/// @param parents index of every item's parent, -1 for exactly one root
std::vector<int> parentsFirst(std::span<const int> parents);

}  // namespace pneuma
