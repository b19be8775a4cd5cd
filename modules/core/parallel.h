#pragma once

#include <cstddef>
#include <functional>
#include <memory>

namespace pneuma {

/// Calls `body(i)` for i = 0 .. n - 1 on all threads. The body writes to its own index only, so
/// that the result does not depend on the number of threads. The first exception is passed on.
void parallelFor(std::size_t n, const std::function<void(std::size_t)>& body);

/// While it lives, parallelFor uses at most `threads` threads (0: all the machine has).
class ThreadLimit {
 public:
  explicit ThreadLimit(unsigned threads);
  ~ThreadLimit();
  ThreadLimit(const ThreadLimit&) = delete;
  ThreadLimit& operator=(const ThreadLimit&) = delete;

 private:
  struct Control;
  std::unique_ptr<Control> control_;
};

}  // namespace pneuma
