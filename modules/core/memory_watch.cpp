#include "core/memory_watch.h"

#include <atomic>
#include <new>

namespace pneuma {
namespace {

std::atomic<bool> ranOut{false};

[[noreturn]] void rememberAndThrow() {
  ranOut = true;
  throw std::bad_alloc();
}

}  // namespace

void watchMemory() { std::set_new_handler(rememberAndThrow); }

bool memoryRanOut() { return ranOut; }

}  // namespace pneuma
