#include "end_signals.h"

#include <array>
#include <csignal>
#include <cstdlib>
#include <system_error>
#include <thread>

#include <fcntl.h>
#include <unistd.h>

#include "io/unfinished_files.h"

namespace pneuma {
namespace {

std::array<int, 2> ends = {-1, -1};  ///< of the pipe through which a signal reaches a thread

/// All that a handler may do.
void pass(int number) {
  const auto byte = static_cast<unsigned char>(number);
  [[maybe_unused]] const ssize_t written = ::write(ends[1], &byte, 1);
}

/// Waits for a signal, whatever the window is doing.
void endBySignal() {
  unsigned char number = 0;
  if (::read(ends[0], &number, 1) != 1) return;
  removeUnfinished();
  ::kill(::getpid(), number);  // whose action is the usual one again
}

}  // namespace

void tidyUpAtEndSignals() {
  std::atexit([] { removeUnfinished(); });           // Qt ends so where the display goes away
  if (::pipe2(ends.data(), O_CLOEXEC) != 0) return;  // then they end it as before
  try {
    std::thread(endBySignal).detach();
  } catch (const std::system_error&) {
    return;
  }

  struct sigaction action {};

  action.sa_handler = pass;
  action.sa_flags = SA_RESTART | SA_RESETHAND;
  for (const int number : {SIGTERM, SIGHUP, SIGINT}) {
    struct sigaction before {};

    ::sigaction(number, nullptr, &before);
    if (before.sa_handler != SIG_IGN) ::sigaction(number, &action, nullptr);
  }
}

}  // namespace pneuma
