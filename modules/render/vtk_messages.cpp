#include "render/vtk_messages.h"

#include <string>

#include <vtkLogger.h>
#include <vtkObjectFactory.h>
#include <vtkOutputWindow.h>
#include <vtkSmartPointer.h>

namespace pneuma {
namespace {

class SilentOutputWindow : public vtkOutputWindow {
 public:
  static SilentOutputWindow* New();
  vtkTypeMacro(SilentOutputWindow, vtkOutputWindow);

  void DisplayText(const char*) override {}

  void DisplayErrorText(const char* text) override {
    if (firstError_.empty()) firstError_ = text;
  }

  void DisplayWarningText(const char*) override {}

  void DisplayGenericWarningText(const char*) override {}

  void DisplayDebugText(const char*) override {}

  const std::string& firstError() const { return firstError_; }

 private:
  std::string firstError_;
};

vtkStandardNewMacro(SilentOutputWindow);

/// VTK's "ERROR: In file.cxx, line 1\nvtkClass (0x1): what happened\n\n" without all but the last.
std::string sentence(const std::string& text) {
  const std::size_t start = text.find("): ");
  std::string result = start == std::string::npos ? text : text.substr(start + 3);
  for (char& c : result) c = c == '\n' ? ' ' : c;
  const std::size_t last = result.find_last_not_of(' ');
  return last == std::string::npos ? std::string() : result.substr(0, last + 1);
}

vtkSmartPointer<vtkOutputWindow>& before() {
  static vtkSmartPointer<vtkOutputWindow> window;
  return window;
}

bool silent = false;

}  // namespace

void silenceVtk() {
  silent = true;
  vtkLogger::SetStderrVerbosity(vtkLogger::VERBOSITY_OFF);
}

VtkMessages::VtkMessages() {
  before() = vtkOutputWindow::GetInstance();
  vtkLogger::SetStderrVerbosity(vtkLogger::VERBOSITY_OFF);  // it prints errors besides
  vtkOutputWindow::SetInstance(vtkSmartPointer<SilentOutputWindow>::New());
}

VtkMessages::~VtkMessages() {
  vtkOutputWindow::SetInstance(before());
  before() = nullptr;
  if (!silent) vtkLogger::SetStderrVerbosity(vtkLogger::VERBOSITY_INFO);  // VTK's default
}

std::string VtkMessages::firstError() const {
  const auto* window = SilentOutputWindow::SafeDownCast(vtkOutputWindow::GetInstance());
  return window == nullptr ? std::string() : sentence(window->firstError());
}

}  // namespace pneuma
