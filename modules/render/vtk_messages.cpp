#include "render/vtk_messages.h"

#include <atomic>
#include <mutex>
#include <string>

#include <vtkLogger.h>
#include <vtkObjectFactory.h>
#include <vtkOutputWindow.h>
#include <vtkSmartPointer.h>

namespace pneuma {
namespace {

/// The youngest of this thread.
thread_local VtkMessages* youngest = nullptr;

/// VTK counts without a lock who is about to print, so that its own silence cannot be relied on.
std::atomic<bool> silent = false;

bool isSaid() { return youngest == nullptr && !silent; }

}  // namespace

/// Keeps the errors of threads that ask for them; what others say is treated as VTK always does.
class VtkMessageSieve final : public vtkOutputWindow {
 public:
  static VtkMessageSieve* New();
  vtkTypeMacro(VtkMessageSieve, vtkOutputWindow);

  /// Once for the whole process: VTK does not say what becomes of a window that is replaced while
  /// another thread writes to it.
  static void install() {
    const auto sieve = vtkSmartPointer<VtkMessageSieve>::New();
    sieve->SetDisplayMode(vtkOutputWindow::GetInstance()->GetDisplayMode());
    vtkOutputWindow::SetInstance(sieve);
  }

  void DisplayErrorText(const char* text) override {
    if (isSaid()) Superclass::DisplayErrorText(text);
    if (youngest != nullptr && youngest->firstError_.empty()) youngest->firstError_ = text;
  }

  void DisplayText(const char* text) override {
    if (isSaid()) Superclass::DisplayText(text);
  }

  void DisplayWarningText(const char* text) override {
    if (isSaid()) Superclass::DisplayWarningText(text);
  }

  void DisplayGenericWarningText(const char* text) override {
    if (isSaid()) Superclass::DisplayGenericWarningText(text);
  }

  void DisplayDebugText(const char* text) override {
    if (isSaid()) Superclass::DisplayDebugText(text);
  }
};

vtkStandardNewMacro(VtkMessageSieve);

namespace {

/// VTK's "ERROR: In file.cxx, line 1\nvtkClass (0x1): what happened\n\n" without all but the last.
std::string sentence(const std::string& text) {
  const std::size_t start = text.find("): ");
  std::string result = start == std::string::npos ? text : text.substr(start + 3);
  for (char& c : result) c = c == '\n' ? ' ' : c;
  const std::size_t last = result.find_last_not_of(' ');
  return last == std::string::npos ? std::string() : result.substr(0, last + 1);
}

/// VTK's logger prints errors besides; it is one for all threads.
class Logger {
 public:
  void quiet() {
    const std::lock_guard lock(mutex_);
    ++living_;
    vtkLogger::SetStderrVerbosity(vtkLogger::VERBOSITY_OFF);
  }

  void asBefore() {
    const std::lock_guard lock(mutex_);
    if (--living_ == 0) vtkLogger::SetStderrVerbosity(vtkLogger::VERBOSITY_INFO);  // its default
  }

 private:
  std::mutex mutex_;
  int living_ = 0;
};

Logger logger;

}  // namespace

void silenceVtk() {
  silent = true;
  logger.quiet();
}

VtkMessages::VtkMessages() : older_(youngest) {
  static std::once_flag installed;
  std::call_once(installed, &VtkMessageSieve::install);
  logger.quiet();
  youngest = this;
}

VtkMessages::~VtkMessages() {
  VtkMessages** link = &youngest;
  while (*link != nullptr && *link != this) link = &(*link)->older_;
  if (*link == this) *link = older_;
  logger.asBefore();
}

std::string VtkMessages::firstError() const { return sentence(firstError_); }

}  // namespace pneuma
