#include <algorithm>
#include <array>
#include <mutex>
#include <optional>
#include <string>

#include <vtkCamera.h>
#include <vtkNew.h>
#include <vtkRenderWindow.h>
#include <vtkRenderer.h>
#include <vtkSmartPointer.h>
#include <vtkUnsignedCharArray.h>

#include "core/error.h"
#include "core/math.h"
#include "render/aside.h"
#include "render/camera.h"
#include "render/display.h"
#include "render/head_view.h"
#include "render/lighting.h"
#include "render/picture.h"
#include "render/steady_view.h"
#include "render/stereo.h"
#include "render/vtk_messages.h"

namespace pneuma {
namespace {

constexpr int SmallestSide = 16;
constexpr int LargestSide = 8192;
constexpr int LogicalDpi = 72;
constexpr double NearestFocusMm = 50.0;

// Pictures up to this size are drawn at twice the size and averaged: airways thinner than a pixel
// then show as what they are, a faint line, and not as a row of dots.
constexpr int LargestSupersampled = 2'100'000;

/// Gives the scene back to the window that had it, with new passes.
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
///
/// Threads draw in turns: Mesa's software rasterizer frees memory twice, once in some hundred
/// times, where one thread ends a context while another makes or ends one.
class Offscreen {
 public:
  /// @param factor draws so many times larger, and averages
  Offscreen(Scene& scene, int width, int height, int factor)
      : camera_(*scene.renderer()->GetActiveCamera()),
        width_(width),
        height_(height),
        factor_(factor) {
    window_->SetOffScreenRendering(1);
    window_->SetDPI(LogicalDpi * factor_);
    window_->SetSize(width * factor_, height * factor_);
    visit_.emplace(scene, window_);
    // Averaged pictures have smooth edges already; without a graphics card that pass takes a
    // quarter of a picture's time.
    if (factor_ > 1) setSmooth(scene.renderer(), scene.renderer()->GetPass(), false);
    scene.updateAnnotations();
  }

  ~Offscreen() {
    const std::lock_guard turn(turns());
    visit_.reset();
    window_ = nullptr;
  }

  Offscreen(const Offscreen&) = delete;
  Offscreen& operator=(const Offscreen&) = delete;

  /// What the scene's camera sees now.
  Picture draw() {
    vtkNew<vtkUnsignedCharArray> pixels;
    drawInto(*pixels);
    return reduced(pixels->GetPointer(0), width_, height_, factor_);
  }

  /// What one eye or both see from there, each in the size of the window.
  Picture drawFor(const StereoOptions& options) {
    if (options.stereo == Stereo::None) return draw();
    const auto seenBy = [&](double mmToTheRight) {
      const Aside aside(camera_, mmToTheRight, static_cast<double>(width_) / height_);
      return draw();
    };
    const Picture left = seenBy(-0.5 * options.eyeDistanceMm);
    return stereoPicture(left, seenBy(0.5 * options.eyeDistanceMm), options.stereo);
  }

 private:
  /// Contexts of OpenGL are made by the first draw() of a window and end with it.
  static std::mutex& turns() {
    static std::mutex mutex;
    return mutex;
  }

  void drawInto(vtkUnsignedCharArray& pixels) {
    const std::lock_guard turn(turns());
    VtkMessages messages;
    window_->Render();
    window_->GetPixelData(0, 0, width_ * factor_ - 1, height_ * factor_ - 1, 0, &pixels);
    const vtkIdType expected = static_cast<vtkIdType>(width_) * height_ * factor_ * factor_ * 3;
    const std::string error = messages.firstError();
    if (!error.empty() || pixels.GetNumberOfValues() != expected) {
      throw NoRendering("OpenGL could not draw the picture (" +
                        (error.empty() ? std::string("no pixels came back") : error) +
                        "); try a smaller --size, or LIBGL_ALWAYS_SOFTWARE=1 under xvfb-run -a");
    }
  }

  vtkCamera& camera_;
  int width_;
  int height_;
  int factor_;
  vtkSmartPointer<vtkRenderWindow> window_ = vtkSmartPointer<vtkRenderWindow>::New();
  std::optional<Visit> visit_;
};

int supersampling(int width, int height) { return width * height <= LargestSupersampled ? 2 : 1; }

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

/// How wide the picture of each eye is. @throws InvalidOption for eyes in one place
int widthOfEach(int width, const StereoOptions& options) {
  if (options.stereo != Stereo::None && !(options.eyeDistanceMm > 0.0)) {
    throw InvalidOption("the distance of the eyes must be above 0 mm");
  }
  const bool whole = options.stereo == Stereo::None || options.stereo == Stereo::Anaglyph;
  return whole ? width : width / 2;
}

}  // namespace

bool canRender() { return displayProblem().empty(); }

Picture renderPicture(Scene& scene, int width, int height) {
  requireDrawable(width, height);
  return Offscreen(scene, width, height, supersampling(width, height)).draw();
}

Picture renderStereo(Scene& scene, int width, int height, const StereoOptions& options) {
  if (options.stereo == Stereo::None) return renderPicture(scene, width, height);
  const int each = widthOfEach(width, options);
  requireDrawable(each, height);
  Offscreen offscreen(scene, each, height, supersampling(each, height));
  return offscreen.drawFor(options);
}

struct SteadyView::State {
  Scene& scene;
  Offscreen offscreen;
};

SteadyView::SteadyView(Scene& scene, int width, int height) {
  requireDrawable(width, height);
  state_.reset(new State{scene, {scene, width, height, supersampling(width, height)}});
}

SteadyView::~SteadyView() = default;

Picture SteadyView::draw() {
  state_->scene.updateAnnotations();
  return state_->offscreen.draw();
}

struct HeadView::State {
  Scene& scene;
  StereoOptions stereo;
  Offscreen offscreen;
};

HeadView::HeadView(Scene& scene, int width, int height, const StereoOptions& stereo) {
  const int each = widthOfEach(width, stereo);
  requireDrawable(each, height);
  state_.reset(new State{scene, stereo, {scene, each, height, 1}});
}

HeadView::~HeadView() = default;

Picture HeadView::from(const Vec3& position, const Eigen::Quaterniond& orientation) {
  Scene& scene = state_->scene;
  vtkRenderer* renderer = scene.renderer();
  const Vec3 ahead = orientation * -Vec3::UnitZ();
  const Vec3 up = orientation * Vec3::UnitY();
  double distance = NearestFocusMm;
  std::array<double, 6> box{};
  renderer->ComputeVisiblePropBounds(box.data());
  if (box[0] <= box[1]) {
    const Vec3 middle = 0.5 * Vec3(box[0] + box[1], box[2] + box[3], box[4] + box[5]);
    distance = std::max(distance, (middle - position).dot(ahead));
  }
  const Vec3 focus = position + distance * ahead;
  vtkCamera& camera = *renderer->GetActiveCamera();
  camera.SetViewAngle(ViewAngleDeg);
  camera.SetPosition(position.data());
  camera.SetFocalPoint(focus.data());
  camera.SetViewUp(up.data());
  scene.updateAnnotations();
  return state_->offscreen.drawFor(state_->stereo);
}

}  // namespace pneuma
