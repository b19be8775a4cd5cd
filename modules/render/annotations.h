#pragma once

#include "render/camera.h"
#include "render/legend.h"
#include "render/overlay.h"
#include "render/scene.h"

class vtkRenderer;

namespace pneuma {

/// Scale bar, orientation letters and legend, round the part of the picture left for the organ.
class Annotations {
 public:
  explicit Annotations(vtkRenderer* overlayRenderer) : overlay_(overlayRenderer) {}

  /// Says what will be drawn and how large the picture is. @param width, height logical pixels
  void arrange(int width, int height, const Legend& legend, const SceneOptions& options);

  /// Room that the annotations take, logical pixels.
  const Insets& insets() const { return insets_; }

  /// Draws for a camera. @param pixelsPerMm logical pixels per mm at the focus
  void draw(const ViewAxes& axes, double pixelsPerMm, double pixelRatio);

 private:
  void drawLetters(const ViewAxes& axes);
  void drawScaleBar(double pixelsPerMm);
  void drawChips();
  void drawRamp();
  void say(const std::string& text, const Overlay::Place& place);
  const std::string& label(const Legend::Chip& chip) const;

  Overlay overlay_;
  Legend legend_;
  Insets insets_;
  bool shown_ = false;
  bool shadow_ = false;
  Rgb ink_;
  double width_ = 0.0;
  double height_ = 0.0;
  double margin_ = 0.0;
  int font_ = 0;
};

}  // namespace pneuma
