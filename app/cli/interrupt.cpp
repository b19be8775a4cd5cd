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
  sigaction(SIGALRM, &action, nullptr);
  for (const int number : {SIGINT, SIGTERM, SIGHUP, SIGPIPE, SIGXCPU}) {
    struct sigaction before = {};
    sigaction(number, nullptr, &before);
    if (before.sa_handler != SIG_IGN) sigaction(number, &action, nullptr);  // as nohup asks
  }
  std::signal(SIGXFSZ, SIG_IGN);
}

int receivedSignal() { return lastSignal; }

bool nobodyReads() { return lastSignal == SIGPIPE; }

}  // namespace pneuma::cli
