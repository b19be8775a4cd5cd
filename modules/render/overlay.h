#pragma once

#include <array>
#include <string>
#include <vector>

#include <vtkActor2D.h>
#include <vtkNew.h>
#include <vtkPolyData.h>
#include <vtkSmartPointer.h>
#include <vtkTextActor.h>

#include "render/colour.h"

class vtkRenderer;

namespace pneuma {

/// Text and boxes over a picture, in logical pixels (window pixels at 72 dots per inch) from the
/// lower left. Everything is said anew for each frame between begin() and end().
class Overlay {
 public:
  enum class Anchor { Low, Middle, High };

  struct Place {
    double x = 0.0;
    double y = 0.0;
    Anchor horizontal = Anchor::Low;
    Anchor vertical = Anchor::Low;
  };

  explicit Overlay(vtkRenderer* renderer);

  /// @param pixelRatio window pixels per logical pixel
  void begin(double pixelRatio);

  void text(const std::string& text, const Place& place, int fontPixels, const Rgb& colour,
            bool shadow);

  void box(double left, double bottom, double right, double top, const Rgb& colour);

  void end();

  /// Width of a line of text, logical pixels.
  static double textWidth(const std::string& text, int fontPixels);

 private:
  struct Box {
    std::array<double, 4> sides;
    Rgb colour;
  };

  vtkRenderer* renderer_;
  double pixelRatio_ = 1.0;
  std::vector<vtkSmartPointer<vtkTextActor>> texts_;
  std::size_t usedTexts_ = 0;
  std::vector<Box> boxes_;
  vtkNew<vtkPolyData> boxData_;
  vtkNew<vtkActor2D> boxActor_;
};

}  // namespace pneuma
