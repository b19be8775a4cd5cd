#include <string>

#include <vtkNew.h>
#include <vtkRenderWindow.h>
#include <vtkRenderer.h>
#include <vtkUnsignedCharArray.h>

#include "core/error.h"
#include "render/display.h"
#include "render/picture.h"
#include "render/vtk_messages.h"

namespace pneuma {
namespace {

constexpr int SmallestSide = 16;
constexpr int LargestSide = 8192;
constexpr int LogicalDpi = 72;

// Pictures up to this size are drawn at twice the size and averaged: airways thinner than a pixel
// then show as what they are, a faint line, and not as a row of dots.
constexpr int LargestSupersampled = 2'100'000;

/// Gives the scene back to the window that had it.
class Visit {
 public:
  Visit(Scene& scene, vtkRenderWindow* window)
      : scene_(scene), before_(scene.renderer()->GetRenderWindow()) {
    scene_.attachTo(window);
  }

  ~Visit() { scene_.attachTo(before_); }

  Visit(const Visit&) = delete;
  Visit& operator=(const Visit&) = delete;

 private:
  Scene& scene_;
  vtkRenderWindow* before_;
};

/// Averages blocks of factor x factor pixels; `pixels` has its rows from the bottom.
Picture reduced(const std::uint8_t* pixels, int width, int height, int factor) {
  Picture picture{width, height, {}};
  picture.rgb.resize(static_cast<std::size_t>(width) * static_cast<std::size_t>(height) * 3);
  const std::size_t stride = static_cast<std::size_t>(width) * static_cast<std::size_t>(factor) * 3;
  const unsigned area = static_cast<unsigned>(factor * factor);
  std::size_t out = 0;
  for (int row = 0; row < height; ++row) {
    const std::uint8_t* block =
        pixels + static_cast<std::size_t>((height - 1 - row) * factor) * stride;
    for (int column = 0; column < width; ++column) {
      for (std::size_t channel = 0; channel < 3; ++channel) {
        unsigned sum = area / 2;
        for (int j = 0; j < factor; ++j) {
          for (int i = 0; i < factor; ++i) {
            sum += block[static_cast<std::size_t>(j) * stride +
                         static_cast<std::size_t>(column * factor + i) * 3 + channel];
          }
        }
        picture.rgb[out++] = static_cast<std::uint8_t>(sum / area);
      }
    }
  }
  return picture;
}

}  // namespace

bool canRender() { return displayProblem().empty(); }

Picture renderPicture(Scene& scene, int width, int height) {
  if (width < SmallestSide || height < SmallestSide || width > LargestSide ||
      height > LargestSide) {
    throw InvalidOption("a picture of " + std::to_string(width) + "x" + std::to_string(height) +
                        " pixels cannot be made; each side may be 16 to 8192 pixels");
  }
  if (const std::string problem = displayProblem(); !problem.empty()) {
    throw NoRendering(problem + ", so no picture can be made; run it under xvfb-run -a");
  }
  const VtkMessages messages;
  const int factor = width * height <= LargestSupersampled ? 2 : 1;
  vtkNew<vtkRenderWindow> window;
  window->SetOffScreenRendering(1);
  window->SetDPI(LogicalDpi * factor);
  window->SetSize(width * factor, height * factor);
  const Visit visit(scene, window);
  scene.updateAnnotations();
  window->Render();
  vtkNew<vtkUnsignedCharArray> pixels;
  window->GetPixelData(0, 0, width * factor - 1, height * factor - 1, 0, pixels);
  const vtkIdType expected = static_cast<vtkIdType>(width) * height * factor * factor * 3;
  const std::string error = messages.firstError();
  if (!error.empty() || pixels->GetNumberOfValues() != expected) {
    throw NoRendering("OpenGL could not draw the picture (" +
                      (error.empty() ? std::string("no pixels came back") : error) +
                      "); try a smaller --size, or LIBGL_ALWAYS_SOFTWARE=1 under xvfb-run -a");
  }
  return reduced(pixels->GetPointer(0), width, height, factor);
}

}  // namespace pneuma
