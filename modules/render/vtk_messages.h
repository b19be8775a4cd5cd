#pragma once

#include <string>

namespace pneuma {

/// From now on VTK prints nothing of its own, such as what it could not allocate. For a program
/// whose errors are sentences.
void silenceVtk();

/// While it lives, what VTK says on the same thread is not printed: errors are kept for whoever
/// asks, warnings are dropped. What other threads say meanwhile may not be printed either. Any
/// number may live at a time; the youngest of a thread keeps its errors. It ends on the thread that
/// made it.
class VtkMessages {
 public:
  VtkMessages();
  ~VtkMessages();
  VtkMessages(const VtkMessages&) = delete;
  VtkMessages& operator=(const VtkMessages&) = delete;

  /// The first error in one line, or "" if there was none.
  std::string firstError() const;

 private:
  friend class VtkMessageSieve;

  std::string firstError_;
  VtkMessages* older_;
};

}  // namespace pneuma
