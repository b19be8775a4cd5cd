#pragma once

#include <string>

namespace pneuma {

/// While one lives, what libraries print to `stderr` (libjpeg does) and std::cerr (GDCM does) on
/// the same thread is kept instead. Other threads print on as before; but theirs to the C `stderr`
/// is lost meanwhile. Any number may live at a time, one on each thread.
class QuietStderr {
 public:
  QuietStderr();
  ~QuietStderr();
  QuietStderr(const QuietStderr&) = delete;
  QuietStderr& operator=(const QuietStderr&) = delete;

  /// What this thread has printed since this was made.
  const std::string& text() const;
};

}  // namespace pneuma
