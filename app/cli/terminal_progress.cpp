#include "cli/terminal_progress.h"

#include <algorithm>
#include <iostream>

#include <unistd.h>

#include "cli/interrupt.h"
#include "cli/text.h"

namespace pneuma::cli {
namespace {

constexpr std::chrono::milliseconds Interval{100};
constexpr int BarWidth = 30;
constexpr const char* ClearLine = "\r\033[K";

}  // namespace

TerminalProgress::TerminalProgress(ProgressMode mode, Steps steps) : mode_(mode), steps_(steps) {
  if (mode_ == ProgressMode::Auto) {
    mode_ = isatty(STDERR_FILENO) != 0 ? ProgressMode::Bar : ProgressMode::None;
  }
}

TerminalProgress::~TerminalProgress() { clear(); }

void TerminalProgress::report(double fraction, std::string_view what) {
  if (mode_ == ProgressMode::None && steps_ == Steps::Silent) return;
  // A worker that finds another one drawing has nothing newer to say.
  const std::unique_lock lock(mutex_, std::try_to_lock);
  if (!lock.owns_lock()) return;
  if (steps_ == Steps::Named && what != step_) nameStep(what);
  if (fraction >= 1.0) return clear();
  const auto now = Clock::now();
  if (mode_ == ProgressMode::None || now - lastShown_ < Interval) return;
  lastShown_ = now;
  draw(fraction, what);
}

bool TerminalProgress::stopRequested() const { return receivedSignal() != 0; }

void TerminalProgress::nameStep(std::string_view what) {
  clear();
  step_ = what;
  const double seconds = std::chrono::duration<double>(Clock::now() - start_).count();
  std::cerr << "pneuma: after " + fixed(seconds, 2) + " s: " + step_ + "\n" << std::flush;
}

void TerminalProgress::draw(double fraction, std::string_view what) {
  if (mode_ == ProgressMode::Json) {
    std::cerr << Json({{"progress", fraction}, {"step", what}}).dump() + "\n" << std::flush;
    return;
  }
  const int full = std::clamp(static_cast<int>(fraction * BarWidth), 0, BarWidth);
  std::string line = ClearLine;
  line.append("[").append(static_cast<std::size_t>(full), '#');
  line.append(static_cast<std::size_t>(BarWidth - full), ' ').append("] ");
  line.append(std::to_string(static_cast<int>(100.0 * fraction))).append(" % ").append(what);
  std::cerr << line << std::flush;
  barIsShown_ = true;
}

void TerminalProgress::clear() {
  if (barIsShown_) std::cerr << ClearLine << std::flush;
  barIsShown_ = false;
}

}  // namespace pneuma::cli
