#pragma once

#include <cstddef>
#include <span>

#include "document/snapshot.h"

namespace pneuma {

/// About how many bytes snapshots hold that the one shown does not, every shared part counted once:
/// images, surfaces, lobes, trees and breaths; not what is small.
std::size_t heldBytes(const Snapshot& shown, std::span<const Snapshot* const> others);

/// How many snapshots can be kept, the first ones, so that they hold no more than `bytes` beside
/// the one shown. The very first can always: there is always something to undo.
std::size_t keptWithin(std::size_t bytes, const Snapshot& shown,
                       std::span<const Snapshot* const> others);

}  // namespace pneuma
