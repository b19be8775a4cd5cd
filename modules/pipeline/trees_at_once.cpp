#include "pipeline/trees_at_once.h"

#include <algorithm>
#include <thread>

#include "core/memory.h"

namespace pneuma {
namespace {

constexpr double BytesPerBranch = 600.0;  // a tree with what is computed from it, at its peak

}  // namespace

std::size_t treesAtOnce(std::size_t branches) {
  const std::size_t cores = std::max(1U, std::thread::hardware_concurrency());
  const auto freeBytes = static_cast<double>(availableMemoryBytes());
  const double trees = freeBytes / 2.0 / (BytesPerBranch * static_cast<double>(branches));
  if (trees >= static_cast<double>(cores)) return cores;
  return std::max<std::size_t>(1, static_cast<std::size_t>(trees));
}

}  // namespace pneuma
