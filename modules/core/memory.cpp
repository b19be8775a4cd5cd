#include "core/memory.h"

#include <fstream>
#include <string>

namespace pneuma {

std::uint64_t availableMemoryBytes() {
  std::ifstream meminfo("/proc/meminfo");  // "MemAvailable:   12345678 kB"
  std::string name;
  std::uint64_t kilobytes = 0;
  std::string unit;
  while (meminfo >> name >> kilobytes) {
    std::getline(meminfo, unit);
    if (name == "MemAvailable:") return kilobytes * 1024;
  }
  return 0;
}

}  // namespace pneuma
