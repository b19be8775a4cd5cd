#include "render/vtk_globals.h"

#include <mutex>

#include <vtkMathTextFreeTypeTextRenderer.h>
#include <vtkObjectFactory.h>
#include <vtkStdString.h>
#include <vtkTimerLog.h>

namespace pneuma {
namespace {

/// One text at a time. VTK's callers come in by strings of UTF-8; its deprecated ways in by
/// vtkUnicodeString are left as they are.
class OneTextAtATime final : public vtkMathTextFreeTypeTextRenderer {
 public:
  static OneTextAtATime* New();
  vtkTypeMacro(OneTextAtATime, vtkMathTextFreeTypeTextRenderer);
  using Superclass::DetectBackend;

  static void install() {
    OneTextAtATime* made = New();
    SetInstance(made);
    made->Delete();  // VTK keeps it
  }

  int DetectBackend(const vtkStdString& text) override {
    const std::lock_guard lock(mutex_);
    return Superclass::DetectBackend(text);
  }

 protected:
  using Superclass::GetBoundingBoxInternal;
  using Superclass::GetConstrainedFontSizeInternal;
  using Superclass::GetMetricsInternal;
  using Superclass::RenderStringInternal;
  using Superclass::StringToPathInternal;

  bool GetBoundingBoxInternal(vtkTextProperty* property, const vtkStdString& text, int box[4],
                              int dpi, int backend) override {
    const std::lock_guard lock(mutex_);
    return Superclass::GetBoundingBoxInternal(property, text, box, dpi, backend);
  }

  bool GetMetricsInternal(vtkTextProperty* property, const vtkStdString& text, Metrics& metrics,
                          int dpi, int backend) override {
    const std::lock_guard lock(mutex_);
    return Superclass::GetMetricsInternal(property, text, metrics, dpi, backend);
  }

  bool RenderStringInternal(vtkTextProperty* property, const vtkStdString& text, vtkImageData* data,
                            int size[2], int dpi, int backend) override {
    const std::lock_guard lock(mutex_);
    return Superclass::RenderStringInternal(property, text, data, size, dpi, backend);
  }

  int GetConstrainedFontSizeInternal(const vtkStdString& text, vtkTextProperty* property, int width,
                                     int height, int dpi, int backend) override {
    const std::lock_guard lock(mutex_);
    return Superclass::GetConstrainedFontSizeInternal(text, property, width, height, dpi, backend);
  }

  bool StringToPathInternal(vtkTextProperty* property, const vtkStdString& text, vtkPath* path,
                            int dpi, int backend) override {
    const std::lock_guard lock(mutex_);
    return Superclass::StringToPathInternal(property, text, path, dpi, backend);
  }

  void SetScaleToPowerOfTwoInternal(bool scale) override {
    const std::lock_guard lock(mutex_);
    Superclass::SetScaleToPowerOfTwoInternal(scale);
  }

 private:
  std::recursive_mutex mutex_;  // some of VTK's functions ask for the backend again
};

vtkStandardNewMacro(OneTextAtATime);

}  // namespace

void prepareVtk() {
  static std::once_flag prepared;
  std::call_once(prepared, [] {
    OneTextAtATime::install();
    vtkTimerLog::LoggingOff();  // every drawing writes to it, and nobody reads it
  });
}

}  // namespace pneuma
