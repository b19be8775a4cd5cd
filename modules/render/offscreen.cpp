#include <cmath>
#include <optional>
#include <string>

#include <vtkCamera.h>
#include <vtkNew.h>
#include <vtkRenderWindow.h>
#include <vtkRenderer.h>
#include <vtkUnsignedCharArray.h>

#include "core/error.h"
#include "core/math.h"
#include "core/units.h"
#include "render/display.h"
#include "render/picture.h"
#include "render/stereo.h"
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

/// A scene in a window that nobody sees, as long as this lives.
class Offscreen {
 public:
  Offscreen(Scene& scene, int width, int height)
      : width_(width), height_(height), factor_(width * height <= LargestSupersampled ? 2 : 1) {
    window_->SetOffScreenRendering(1);
    window_->SetDPI(LogicalDpi * factor_);
    window_->SetSize(width * factor_, height * factor_);
    visit_.emplace(scene, window_);
    scene.updateAnnotations();
  }

  /// What the scene's camera sees now.
  Picture draw() {
    window_->Render();
    vtkNew<vtkUnsignedCharArray> pixels;
    window_->GetPixelData(0, 0, width_ * factor_ - 1, height_ * factor_ - 1, 0, pixels);
    const vtkIdType expected = static_cast<vtkIdType>(width_) * height_ * factor_ * factor_ * 3;
    const std::string error = messages_.firstError();
    if (!error.empty() || pixels->GetNumberOfValues() != expected) {
      throw NoRendering("OpenGL could not draw the picture (" +
                        (error.empty() ? std::string("no pixels came back") : error) +
                        "); try a smaller --size, or LIBGL_ALWAYS_SOFTWARE=1 under xvfb-run -a");
    }
    return reduced(pixels->GetPointer(0), width_, height_, factor_);
  }

 private:
  const VtkMessages messages_;
  int width_;
  int height_;
  int factor_;
  vtkNew<vtkRenderWindow> window_;
  std::optional<Visit> visit_;
};

void requireDrawable(int width, int height) {
  if (width < SmallestSide || height < SmallestSide || width > LargestSide ||
      height > LargestSide) {
    throw InvalidOption("a picture of " + std::to_string(width) + "x" + std::to_string(height) +
                        " pixels cannot be made; each side may be 16 to 8192 pixels");
  }
  if (const std::string problem = displayProblem(); !problem.empty()) {
    throw NoRendering(problem + ", so no picture can be made; run it under xvfb-run -a");
  }
}

/// A camera that stands aside of another, looks the same way and has the other's focus in the same
/// place of its picture; put back in the end.
class Aside {
 public:
  /// @param mm to the camera's right
  Aside(vtkCamera& camera, double mm, double aspect) : camera_(camera) {
    camera.GetPosition(eye_.data());
    camera.GetFocalPoint(focus_.data());
    const Vec3 ahead = (focus_ - eye_).normalized();
    const Vec3 step = mm * ahead.cross(Vec3(camera.GetViewUp())).normalized();
    const double halfWidth =
        (focus_ - eye_).norm() * std::tan(radians(0.5 * camera.GetViewAngle())) * aspect;
    const Vec3 eye = eye_ + step;
    const Vec3 focus = focus_ + step;
    camera.SetPosition(eye.data());
    camera.SetFocalPoint(focus.data());
    camera.SetWindowCenter(-mm / halfWidth, 0.0);
  }

  ~Aside() {
    camera_.SetPosition(eye_.data());
    camera_.SetFocalPoint(focus_.data());
    camera_.SetWindowCenter(0.0, 0.0);
  }

  Aside(const Aside&) = delete;
  Aside& operator=(const Aside&) = delete;

 private:
  vtkCamera& camera_;
  Vec3 eye_;
  Vec3 focus_;
};

}  // namespace

bool canRender() { return displayProblem().empty(); }

Picture renderPicture(Scene& scene, int width, int height) {
  requireDrawable(width, height);
  return Offscreen(scene, width, height).draw();
}

Picture renderStereo(Scene& scene, int width, int height, const StereoOptions& options) {
  if (options.stereo == Stereo::None) return renderPicture(scene, width, height);
  if (!(options.eyeDistanceMm > 0.0)) {
    throw InvalidOption("the distance of the eyes must be above 0 mm");
  }
  const int each = options.stereo == Stereo::Anaglyph ? width : width / 2;
  requireDrawable(each, height);
  Offscreen offscreen(scene, each, height);
  vtkCamera& camera = *scene.renderer()->GetActiveCamera();
  const auto seenBy = [&](double mmToTheRight) {
    const Aside aside(camera, mmToTheRight, static_cast<double>(each) / height);
    return offscreen.draw();
  };
  const Picture left = seenBy(-0.5 * options.eyeDistanceMm);
  return stereoPicture(left, seenBy(0.5 * options.eyeDistanceMm), options.stereo);
}

}  // namespace pneuma
