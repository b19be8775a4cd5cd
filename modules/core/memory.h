#pragma once

#include <cstdint>

namespace pneuma {

/// Memory that this process could still take without swapping, bytes; 0 where the system does not
/// tell (anywhere but on Linux).
std::uint64_t availableMemoryBytes();

}  // namespace pneuma
