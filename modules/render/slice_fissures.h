#pragma once

#include <cstdint>
#include <vector>

#include "render/fissure_scene.h"
#include "render/picture.h"
#include "render/slice_frame.h"

namespace pneuma {

/// Fissures over one slice: whose label is what lobe, lines where they run, marks.
class FissureOverlay {
 public:
  FissureOverlay(const SliceFissures& fissures, const SliceFrame& frame);

  /// Turns labels of whole lungs into those of the lobes.
  /// @param labels of every pixel of the frame
  void split(std::vector<std::uint8_t>& labels) const;

  /// Draws the fissures where a lung's labels are.
  /// @param labels of every pixel; those that split() gave, or whole lungs
  void drawLines(Picture& picture, const std::vector<std::uint8_t>& labels,
                 double pixelRatio) const;

  void drawMarks(Picture& picture, double pixelRatio) const;

 private:
  /// Heights on a coarse grid of pixels: a fissure bends little within some millimetres.
  struct Heights {
    const SliceFissures::Line* line = nullptr;
    int columns = 0;
    std::vector<float> values;
  };

  const Heights* of(Fissure fissure) const;
  float at(const Heights& heights, int x, int y) const;

  const SliceFissures& fissures_;
  SliceFrame frame_;
  int step_ = 1;  ///< pixels
  std::vector<Heights> heights_;
};

}  // namespace pneuma
