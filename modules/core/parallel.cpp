#include "core/parallel.h"

#include <algorithm>
#include <atomic>
#include <stdexcept>
#include <thread>
#include <vector>

#include <oneapi/tbb/global_control.h>
#include <oneapi/tbb/parallel_for.h>

#include "core/error.h"

namespace pneuma {
namespace {

/// How many of `wanted` threads the system lets run at once, this one among them. TBB takes it for
/// granted that it gets them.
unsigned possibleThreads(unsigned wanted) {
  std::atomic<bool> over{false};
  std::vector<std::thread> others;
  try {
    others.reserve(wanted);
    while (others.size() + 1 < wanted) others.emplace_back([&over] { over.wait(false); });
  } catch (const std::exception&) {  // no more than these: threads or memory are out
  }
  over = true;
  over.notify_all();
  for (std::thread& other : others) other.join();
  return static_cast<unsigned>(others.size()) + 1;
}

}  // namespace

struct ThreadLimit::Control {
  oneapi::tbb::global_control control;
};

ThreadLimit::ThreadLimit(unsigned threads) {
  const unsigned wanted = threads > 0 ? threads : std::max(1U, std::thread::hardware_concurrency());
  const unsigned possible = possibleThreads(wanted);
  if (threads > 0 || possible < wanted) {
    control_.reset(new Control{oneapi::tbb::global_control(
        oneapi::tbb::global_control::max_allowed_parallelism, possible)});
  }
}

ThreadLimit::~ThreadLimit() = default;

void parallelFor(std::size_t n, const std::function<void(std::size_t)>& body) {
  std::atomic<bool> bodyThrew{false};
  try {
    oneapi::tbb::parallel_for(std::size_t{0}, n, [&](std::size_t i) {
      try {
        body(i);
      } catch (...) {
        bodyThrew = true;
        throw;
      }
    });
  } catch (const std::runtime_error&) {
    if (bodyThrew) throw;
    throw Error(ExitCode::OutOfMemory,
                "the system starts no further thread; end other programs or add --threads 1");
  }
}

}  // namespace pneuma
