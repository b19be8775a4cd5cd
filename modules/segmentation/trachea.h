#pragma once

#include <vector>

#include "segmentation/inner_air.h"

namespace pneuma {

/// The trachea in one slice.
struct TracheaSection {
  int slice = 0;
  std::uint32_t part = 0;      ///< in InnerAir::inSlices
  Vec3 centre = Vec3::Zero();  ///< voxels
  double areaMm2 = 0.0;
  double fill = 0.0;  ///< of its box; pi / 4 for an ellipse
};

/// The trachea, top to bottom; above its root lie larynx and pharynx.
struct Trachea {
  std::vector<TracheaSection> sections;
  std::size_t root = 0;  ///< the section from which the airways are followed

  bool found() const { return !sections.empty(); }

  double lengthMm(const ImageGeometry& geometry) const {
    return static_cast<double>(sections.size()) * geometry.spacing.z();
  }
};

/// The longest chain of round spots of air, each under the one above, near the body's middle in the
/// upper part of the CT. Empty if there is none of at least 20 mm.
Trachea findTrachea(const CtImage& ct, const InnerAir& air);

}  // namespace pneuma
