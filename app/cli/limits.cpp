#include "cli/limits.h"

#include <cmath>
#include <csignal>

#include <sys/resource.h>
#include <sys/time.h>

#include "cli/interrupt.h"
#include "core/memory.h"
#include "core/options.h"
#include "io/piece_files.h"

namespace pneuma::cli {
namespace {

constexpr double Kilo = 1024.0;
constexpr std::uint64_t LeastBytes = 64ULL << 20U;  ///< libraries and one thread take this much
/// VTK, OpenGL in software and its compiler of shaders, with a tree of 40,000 branches: 520 MB
/// measured.
constexpr std::uint64_t DrawingBytes = 600ULL << 20U;
/// What of it is used and not only set aside, which is what counts for a group: 434 to 524 MB
/// measured, with what the program has already.
constexpr std::uint64_t DrawingInGroupBytes = 400ULL << 20U;
constexpr double MostBytes = 1e18;

double factorOf(char suffix) {
  switch (suffix) {
    case 'k':
    case 'K':
      return Kilo;
    case 'm':
    case 'M':
      return Kilo * Kilo;
    case 'g':
    case 'G':
      return Kilo * Kilo * Kilo;
    case 't':
    case 'T':
      return Kilo * Kilo * Kilo * Kilo;
    default:
      return 1.0;
  }
}

}  // namespace

std::uint64_t parseBytes(std::string_view option, std::string_view text) {
  std::string_view number = text;
  double factor = 1.0;
  if (!number.empty()) factor = factorOf(number.back());
  if (factor > 1.0) number.remove_suffix(1);
  const double bytes = factor * detail::parseNumber(option, number, "");
  if (!(bytes == 0.0 || (bytes >= 1.0 && bytes <= MostBytes))) {
    throw InvalidOption(std::string(option) + " is a number of bytes, but '" + std::string(text) +
                        "' was given; write it as 500M or 8G");
  }
  return static_cast<std::uint64_t>(bytes);
}

std::uint64_t largestFileBytes(const std::string& text) {
  if (text.empty()) return LargestFileBytes;
  const std::uint64_t bytes = parseBytes("--largest-file", text);
  if (bytes >= LeastFileBytes) return bytes;
  throw InvalidOption("--largest-file is 64K or more, but '" + text + "' was given");
}

std::uint64_t parseMemorySize(std::string_view text) {
  const std::uint64_t bytes = parseBytes("--max-memory", text);
  if (bytes != 0 && bytes < LeastBytes) {
    throw InvalidOption("--max-memory is 0 (no limit) or at least 64M, but '" + std::string(text) +
                        "' was given; write it as 500M or 8G");
  }
  return bytes;
}

void limitMemory(std::uint64_t bytes) {
  if (bytes == 0) return;
  struct rlimit limit = {};
  getrlimit(RLIMIT_DATA, &limit);
  if (limit.rlim_cur != RLIM_INFINITY && limit.rlim_cur <= bytes) return;  // stricter already
  limit.rlim_cur = bytes;
  if (setrlimit(RLIMIT_DATA, &limit) != 0) {
    throw InvalidOption("--max-memory cannot be set on this system; leave it out");
  }
}

void requireMemoryForDrawing() {
  // A machine that has too little swaps, and draws.
  struct rlimit limit = {};
  const bool limited = getrlimit(RLIMIT_DATA, &limit) == 0 && limit.rlim_cur != RLIM_INFINITY;
  const auto require = [](std::uint64_t needed, std::uint64_t left, const std::string& advice) {
    if (left >= needed) return;
    throw Error(ExitCode::OutOfMemory, "drawing takes " + std::to_string(needed >> 20U) +
                                           " MB of memory and " + std::to_string(left >> 20U) +
                                           " MB are left; " + advice + ", or make no pictures");
  };
  if (limited) require(DrawingBytes, availableMemoryBytes(), adviceForMemory());
  require(DrawingInGroupBytes, memoryLeftInGroups(), "give the job or the container more memory");
}

void limitTime(double seconds) {
  if (seconds <= 0.0) return;
  struct itimerval timer = {};
  const double whole = std::floor(seconds);
  timer.it_value.tv_sec = static_cast<time_t>(whole);
  timer.it_value.tv_usec = static_cast<suseconds_t>((seconds - whole) * 1e6);
  if (timer.it_value.tv_sec == 0 && timer.it_value.tv_usec == 0) timer.it_value.tv_usec = 1;
  setitimer(ITIMER_REAL, &timer, nullptr);
}

bool timeIsOver() { return receivedSignal() == SIGALRM; }

}  // namespace pneuma::cli
