#include "core/parallel.h"

#include <oneapi/tbb/global_control.h>
#include <oneapi/tbb/parallel_for.h>

namespace pneuma {

struct ThreadLimit::Control {
  oneapi::tbb::global_control control;
};

ThreadLimit::ThreadLimit(unsigned threads) {
  if (threads > 0) {
    control_.reset(new Control{oneapi::tbb::global_control(
        oneapi::tbb::global_control::max_allowed_parallelism, threads)});
  }
}

ThreadLimit::~ThreadLimit() = default;

void parallelFor(std::size_t n, const std::function<void(std::size_t)>& body) {
  oneapi::tbb::parallel_for(std::size_t{0}, n, [&](std::size_t i) { body(i); });
}

}  // namespace pneuma
