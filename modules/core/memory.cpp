#include "core/memory.h"

#include <algorithm>
#include <array>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <limits>
#include <sstream>
#include <string>
#include <string_view>

namespace pneuma {
namespace {

namespace fs = std::filesystem;

constexpr std::uint64_t NoLimit = std::numeric_limits<std::uint64_t>::max();

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
  return NoLimit;
}

std::uint64_t leftOfProcess() {
  return std::min(leftOf("Max data size", "VmData"), leftOf("Max address space", "VmSize"));
}

/// Files that tell of one control group.
struct GroupFiles {
  const char* limit;
  const char* used;
  std::array<std::string_view, 3> reclaimable;  ///< their names in memory.stat
};

constexpr GroupFiles Version1 = {"memory.limit_in_bytes",
                                 "memory.usage_in_bytes",
                                 {"total_inactive_file", "total_active_file", ""}};
constexpr GroupFiles Version2 = {
    "memory.max", "memory.current", {"inactive_file", "active_file", "slab_reclaimable"}};

/// What one group leaves of its limit.
std::uint64_t leftOfGroup(const fs::path& folder, const GroupFiles& files) {
  std::uint64_t limit = 0;
  std::uint64_t used = 0;
  if (!(std::ifstream(folder / files.limit) >> limit)) return NoLimit;  // "max", or no such group
  if (!(std::ifstream(folder / files.used) >> used)) return NoLimit;
  std::ifstream stat(folder / "memory.stat");
  std::string name;
  std::uint64_t value = 0;
  while (stat >> name >> value) {
    if (std::ranges::find(files.reclaimable, name) != files.reclaimable.end()) {
      used -= std::min(used, value);
    }
  }
  return limit > used ? limit - used : 1;
}

/// What a group and those above it leave; a container may name its group by the path that it has
/// outside, and then has its own limits in `top`.
std::uint64_t leftOfGroups(const fs::path& top, const std::string& group, const GroupFiles& files) {
  std::uint64_t left = leftOfGroup(top, files);
  fs::path folder = top;
  for (const fs::path& part : fs::path(group).relative_path()) {
    folder /= part;
    left = std::min(left, leftOfGroup(folder, files));
  }
  return left;
}

}  // namespace

std::uint64_t memoryLeftInGroups(const std::string& root) {
  const fs::path groups = root + "/sys/fs/cgroup";
  std::ifstream lines(root + "/proc/self/cgroup");
  std::uint64_t left = NoLimit;
  std::string line;
  while (std::getline(lines, line)) {  // number:controllers:path
    const std::size_t first = line.find(':');
    const std::size_t second = first == std::string::npos ? first : line.find(':', first + 1);
    if (second == std::string::npos) continue;
    const std::string controllers = "," + line.substr(first + 1, second - first - 1) + ",";
    const std::string path = line.substr(second + 1);
    if (controllers == ",,") left = std::min(left, leftOfGroups(groups, path, Version2));
    if (controllers.find(",memory,") != std::string::npos) {
      left = std::min(left, leftOfGroups(groups / "memory", path, Version1));
    }
  }
  return left;
}

std::uint64_t availableMemoryBytes() {
  const std::uint64_t free = bytesOf("/proc/meminfo", "MemAvailable");
  return free == 0 ? 0 : std::min({free, leftOfProcess(), memoryLeftInGroups()});
}

std::string adviceForMemory() {
  return adviceForMemory(bytesOf("/proc/meminfo", "MemAvailable"), leftOfProcess(),
                         memoryLeftInGroups());
}

std::string adviceForMemory(std::uint64_t machine, std::uint64_t process, std::uint64_t group) {
  if (group < std::min(machine, process)) return "give the job or the container more memory";
  if (process < machine) return "allow more memory with --max-memory (or ulimit)";
  return "close other programs, or use a machine with more memory";
}

}  // namespace pneuma
