#include "core/parallel.h"

#include <algorithm>
#include <atomic>
#include <stdexcept>
#include <thread>
#include <vector>

#include <oneapi/tbb/global_control.h>
#include <oneapi/tbb/parallel_for.h>

#include "core/error.h"

#ifdef PNEUMA_TELL_TSAN  // of the sanitizer's own interface
extern "C" void __tsan_acquire(void* address);
extern "C" void __tsan_release(void* address);
#endif

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

/// A loop, as long as it lives. The thread sanitizer does not see into TBB and is told what TBB
/// promises: what stands before a loop happens before its bodies, and these before what follows.
/// Nothing is said of one body and another.
class Loop {
 public:
#ifdef PNEUMA_TELL_TSAN
  Loop() { __tsan_release(&start_); }

  ~Loop() { __tsan_acquire(&end_); }

  class Body {
   public:
    explicit Body(Loop& loop) : loop_(loop) { __tsan_acquire(&loop_.start_); }

    ~Body() { __tsan_release(&loop_.end_); }

    Body(const Body&) = delete;
    Body& operator=(const Body&) = delete;

   private:
    Loop& loop_;
  };

  Loop(const Loop&) = delete;
  Loop& operator=(const Loop&) = delete;

 private:
  char start_ = 0;
  char end_ = 0;
#else
  struct Body {
    explicit Body(const Loop& /*loop*/) {}
  };
#endif
};

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
  Loop loop;
  try {
    oneapi::tbb::parallel_for(std::size_t{0}, n, [&](std::size_t i) {
      const Loop::Body within(loop);
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
