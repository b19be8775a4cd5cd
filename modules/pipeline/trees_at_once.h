#pragma once

#include <cstddef>

namespace pneuma {

/// How many trees of `branches` branches may be grown or measured at the same time: one per core,
/// in at most half of the memory that is free; at least one.
std::size_t treesAtOnce(std::size_t branches);

}  // namespace pneuma
