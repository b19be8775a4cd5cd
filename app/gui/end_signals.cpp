#include "end_signals.h"

#include <QSocketNotifier>
#include <array>
#include <csignal>
#include <cstdlib>

#include <fcntl.h>
#include <unistd.h>

#include "io/unfinished_files.h"

namespace pneuma {
namespace {

std::array<int, 2> ends = {-1, -1};  ///< of the pipe through which a signal reaches the event loop

/// All that a handler may do.
void pass(int number) {
  const auto byte = static_cast<unsigned char>(number);
  [[maybe_unused]] const ssize_t written = ::write(ends[1], &byte, 1);
}

void endBySignal() {
  unsigned char number = 0;
  if (::read(ends[0], &number, 1) != 1) return;
  removeUnfinished();
  std::signal(number, SIG_DFL);
  std::raise(number);
}

}  // namespace

void tidyUpAtEndSignals(QObject* owner) {
  std::atexit([] { removeUnfinished(); });  // Qt ends so where the display goes away
  if (::pipe2(ends.data(), O_CLOEXEC | O_NONBLOCK) != 0) return;  // then they end it as before
  auto* notifier = new QSocketNotifier(ends[0], QSocketNotifier::Read, owner);
  QObject::connect(notifier, &QSocketNotifier::activated, notifier, endBySignal);
  for (const int number : {SIGTERM, SIGHUP, SIGINT}) std::signal(number, pass);
}

}  // namespace pneuma
