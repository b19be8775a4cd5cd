#pragma once

#include <chrono>

namespace pneuma {

/// Wall time that has passed since `start`.
inline double secondsSince(std::chrono::steady_clock::time_point start) {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

}  // namespace pneuma
