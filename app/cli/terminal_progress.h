#pragma once

#include <chrono>
#include <mutex>
#include <string>

#include "cli/arguments.h"
#include "core/progress.h"

namespace pneuma::cli {

/// Progress as a bar or as JSON lines on standard error; stops on Ctrl-C and SIGTERM. The bar goes
/// away at 1: commands report that before they print anything.
class TerminalProgress : public ProgressSink {
 public:
  enum class Steps { Silent, Named };

  /// @param steps Named: also one line for every step that begins, with the time since the start
  TerminalProgress(ProgressMode mode, Steps steps);
  ~TerminalProgress() override;

  void report(double fraction, std::string_view what) override;
  bool stopRequested() const override;

 private:
  using Clock = std::chrono::steady_clock;

  void nameStep(std::string_view what);
  void draw(double fraction, std::string_view what);
  void clear();

  ProgressMode mode_;  ///< never Auto
  Steps steps_;
  std::mutex mutex_;
  Clock::time_point start_ = Clock::now();
  Clock::time_point lastShown_ = start_;
  std::string step_;
  bool barIsShown_ = false;
};

}  // namespace pneuma::cli
