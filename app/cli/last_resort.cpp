#include "cli/last_resort.h"

#include <algorithm>
#include <cerrno>
#include <exception>
#include <new>
#include <string>
#include <string_view>

#include <fcntl.h>
#include <sys/resource.h>
#include <unistd.h>

#include "core/error.h"
#include "core/memory_watch.h"
#include "io/unfinished_files.h"
#include "render/vtk_messages.h"

namespace pneuma::cli {
namespace {

std::terminate_handler before = nullptr;

bool isOutOfMemory() noexcept {
  if (memoryRanOut()) return true;
  const std::exception_ptr current = std::current_exception();
  if (!current) return false;
  try {
    std::rethrow_exception(current);
  } catch (const std::bad_alloc&) {
    return true;
  } catch (...) {
    return false;
  }
}

[[noreturn]] void endAtOnce() {
  removeUnfinished();
  if (isOutOfMemory()) {
    constexpr std::string_view Message =
        "pneuma: there is not enough memory; use a smaller input or a machine with more\n";
    [[maybe_unused]] const ssize_t ignored = ::write(STDERR_FILENO, Message.data(), Message.size());
    ::_exit(static_cast<int>(ExitCode::OutOfMemory));
  }
  before();
  ::_exit(static_cast<int>(ExitCode::Internal));  // not reached: it aborts
}

}  // namespace

void openStandardFiles() {
  // The lowest free number is taken, so that the order matters.
  for (int number = STDIN_FILENO; number <= STDERR_FILENO; ++number) {
    if (::fcntl(number, F_GETFD) >= 0 || errno != EBADF) continue;
    // For reading only: printing a result that nobody gets is an error, complaining is none.
    const int flags = number == STDERR_FILENO ? O_WRONLY : O_RDONLY;
    [[maybe_unused]] const int ignored = ::open("/dev/null", flags);
  }
}

void requireStack() {
  constexpr rlim_t Usual = rlim_t{8} << 20;
  constexpr rlim_t Least = rlim_t{512} << 10;  // growing needs more than half of it
  rlimit limit{};
  if (::getrlimit(RLIMIT_STACK, &limit) != 0 || limit.rlim_cur >= Usual) return;
  limit.rlim_cur = std::min(limit.rlim_max, Usual);
  ::setrlimit(RLIMIT_STACK, &limit);
  if (limit.rlim_cur >= Least) return;
  throw Error(ExitCode::OutOfMemory,
              "the stack is limited to " + std::to_string(limit.rlim_cur >> 10) +
                  " kB, which is too little; start from a shell without 'ulimit -s'");
}

void handleLastResort() {
  watchMemory();
  silenceVtk();
  before = std::set_terminate(endAtOnce);
}

}  // namespace pneuma::cli
