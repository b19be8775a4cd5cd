#pragma once

#include <cstdint>
#include <vector>

#include "render/slice_picture.h"

namespace pneuma {

/// The voxels of a slice whose radiodensity lies in a band, without the air round the patient:
/// what hangs together with the sides of the image, front and back, right and left, is left out.
class SliceHighlight {
 public:
  SliceHighlight(const CtImage& ct, const SliceFrame& frame, const HuBand& band);

  /// @param point of the slice
  bool contains(const Vec3& point) const;

 private:
  void flood();
  void take(int x, int y);

  SliceFrame grid_;  ///< all of the slice, a pixel to a voxel
  std::vector<std::uint8_t> state_;
  std::vector<std::int32_t> queue_;
};

}  // namespace pneuma
