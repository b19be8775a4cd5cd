#include "cli/interrupt.h"

#include <algorithm>
#include <atomic>
#include <csignal>

#include <sys/resource.h>

namespace pneuma::cli {
namespace {

std::atomic<int> firstSignal{0};
std::atomic<bool> closedPipe{false};
static_assert(std::atomic<int>::is_always_lock_free);  // or a signal handler may not touch it
static_assert(std::atomic<bool>::is_always_lock_free);

extern "C" void remember(int signal) {
  if (signal == SIGPIPE) closedPipe = true;
  int none = 0;
  firstSignal.compare_exchange_strong(none, signal);
}

/// Where the system ends the process and tells it in the same second (`ulimit -t`), it is told a
/// little before.
void leaveTimeToTidyUp() {
  rlimit time{};
  if (::getrlimit(RLIMIT_CPU, &time) != 0 || time.rlim_max == RLIM_INFINITY) return;
  const rlim_t needed = std::clamp<rlim_t>(time.rlim_max / 10, 1, 10);
  if (time.rlim_max <= needed) return;
  time.rlim_cur = std::min(time.rlim_cur, time.rlim_max - needed);
  ::setrlimit(RLIMIT_CPU, &time);
}

}  // namespace

void rememberSignals() {
  struct sigaction action = {};
  action.sa_handler = remember;
  action.sa_flags = SA_RESTART;
  sigemptyset(&action.sa_mask);
  for (const int number : {SIGINT, SIGTERM, SIGALRM, SIGXCPU}) sigaction(number, &action, nullptr);
  for (const int number : {SIGHUP, SIGPIPE}) {
    struct sigaction before = {};
    sigaction(number, nullptr, &before);
    if (before.sa_handler != SIG_IGN) sigaction(number, &action, nullptr);
  }
  std::signal(SIGXFSZ, SIG_IGN);
  leaveTimeToTidyUp();
}

int receivedSignal() { return firstSignal; }

bool nobodyReads() { return closedPipe; }

}  // namespace pneuma::cli
