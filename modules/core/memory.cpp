#include "core/memory.h"

#include <algorithm>
#include <cstdlib>
#include <fstream>
#include <limits>
#include <sstream>
#include <string>

namespace pneuma {
namespace {

/// Bytes of the line "NAME:   12345678 kB"; 0 if there is none.
std::uint64_t bytesOf(const char* file, const std::string& name) {
  std::ifstream lines(file);
  std::string line;
  while (std::getline(lines, line)) {
    if (line.compare(0, name.size() + 1, name + ":") != 0) continue;
    return std::strtoull(line.c_str() + name.size() + 1, nullptr, 10) * 1024;
  }
  return 0;
}

/// What a limit on the process (--max-memory, ulimit) leaves of it.
/// @param limit as /proc/self/limits calls it: "Max data size    524288000    unlimited    bytes"
/// @param used  as /proc/self/status calls what counts
std::uint64_t leftOf(const std::string& limit, const std::string& used) {
  std::ifstream lines("/proc/self/limits");
  std::string line;
  while (std::getline(lines, line)) {
    if (line.compare(0, limit.size(), limit) != 0) continue;
    std::istringstream values(line.substr(limit.size()));
    std::uint64_t bytes = 0;
    if (!(values >> bytes)) break;  // "unlimited"
    const std::uint64_t taken = bytesOf("/proc/self/status", used);
    return bytes > taken ? bytes - taken : 1;
  }
  return std::numeric_limits<std::uint64_t>::max();
}

}  // namespace

std::uint64_t availableMemoryBytes() {
  const std::uint64_t free = bytesOf("/proc/meminfo", "MemAvailable");
  if (free == 0) return 0;
  return std::min({free, leftOf("Max data size", "VmData"), leftOf("Max address space", "VmSize")});
}

}  // namespace pneuma
