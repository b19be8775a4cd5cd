#pragma once

#include <string>

namespace pneuma {

/// From now on VTK prints nothing of its own, such as what it could not allocate. For a program
/// whose errors are sentences.
void silenceVtk();

/// While it lives, VTK prints nothing: errors are kept for whoever asks, warnings are dropped.
/// One at a time, on the thread that renders.
class VtkMessages {
 public:
  VtkMessages();
  ~VtkMessages();
  VtkMessages(const VtkMessages&) = delete;
  VtkMessages& operator=(const VtkMessages&) = delete;

  /// The first error in one line, or "" if there was none.
  std::string firstError() const;
};

}  // namespace pneuma
