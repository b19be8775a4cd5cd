#include "core/memory.h"

#include <algorithm>
#include <cstdlib>
#include <fstream>
#include <limits>
#include <string>

#include <sys/resource.h>

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
std::uint64_t leftOf(int resource, const std::string& used) {
  struct rlimit limit = {};
  if (getrlimit(resource, &limit) != 0 || limit.rlim_cur == RLIM_INFINITY) {
    return std::numeric_limits<std::uint64_t>::max();
  }
  const std::uint64_t taken = bytesOf("/proc/self/status", used);
  return limit.rlim_cur > taken ? limit.rlim_cur - taken : 1;
}

}  // namespace

std::uint64_t availableMemoryBytes() {
  const std::uint64_t free = bytesOf("/proc/meminfo", "MemAvailable");
  if (free == 0) return 0;
  return std::min({free, leftOf(RLIMIT_DATA, "VmData"), leftOf(RLIMIT_AS, "VmSize")});
}

}  // namespace pneuma
