#pragma once

#include <cstdint>
#include <string>

namespace pneuma {

/// Memory that this process could still take without swapping, bytes; 0 where the system does not
/// tell (anywhere but on Linux). Least of what the machine has, of what limits on the process leave
/// (--max-memory, ulimit), and of what the control group leaves in which it runs (a job of Slurm, a
/// container).
std::uint64_t availableMemoryBytes();

/// What the control groups of this process leave of their limits, bytes: its own and those above,
/// of version 1 or 2; the greatest number there is where none limits it. Pages of files, which the
/// kernel would give up, count as free.
/// @param root the folder in which proc/self/cgroup and sys/fs/cgroup stand
std::uint64_t memoryLeftInGroups(const std::string& root = "");

/// What a person can do where availableMemoryBytes() is too little, by what limits it: "close other
/// programs, or use a machine with more memory".
std::string adviceForMemory();

/// The same by what they leave, bytes.
std::string adviceForMemory(std::uint64_t machine, std::uint64_t process, std::uint64_t group);

}  // namespace pneuma
