#include "cli/interrupt.h"

#include <atomic>
#include <csignal>

namespace pneuma::cli {
namespace {

std::atomic<int> lastSignal{0};
static_assert(std::atomic<int>::is_always_lock_free);  // or a signal handler may not touch it

extern "C" void remember(int signal) { lastSignal = signal; }

}  // namespace

void rememberSignals() {
  struct sigaction action = {};
  action.sa_handler = remember;
  action.sa_flags = SA_RESTART;
  sigemptyset(&action.sa_mask);
  sigaction(SIGINT, &action, nullptr);
  sigaction(SIGTERM, &action, nullptr);
  sigaction(SIGALRM, &action, nullptr);
  std::signal(SIGXFSZ, SIG_IGN);
}

int receivedSignal() { return lastSignal; }

}  // namespace pneuma::cli
