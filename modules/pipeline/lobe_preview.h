#pragma once

#include <map>
#include <memory>
#include <vector>

#include "pipeline/lung_shape.h"

namespace pneuma {

/// A line upon a lung's surface; its end is its beginning again where it is closed.
using SurfaceLine = std::vector<Vec3>;

/// The lobes of one lung while its fissures move: by the signs of the fissures' heights, with
/// nothing cut, in milliseconds where splitLobes() takes a second. A point of the lung is in the
/// lobe that splitLobes() puts it in. Only a fissure that is set is worked out anew.
class LobePreview {
 public:
  /// @param fissures all of its side
  LobePreview(std::shared_ptr<const LungShape> lung, const FissureSurfaces& fissures);

  const LungShape& lung() const { return *lung_; }

  Side side() const { return lung_->side; }

  /// @param fissure of this side
  void set(Fissure fissure, const HeightSurface& surface);

  const HeightSurface& surface(Fissure fissure) const { return fissures_.at(fissure).surface; }

  /// Moves the fissures along their normals so that the lobes have these shares, as near as the
  /// grid inside the lung tells. @pre shares are positive and sum up to 1
  void moveTo(const LobeShares& shares);

  /// How far each point of the lung's surface lies above a fissure, mm; negative below. Shared, so
  /// that a view can tell by the pointer whether they are others.
  std::shared_ptr<const std::vector<float>> heights(Fissure fissure) const {
    return fissures_.at(fissure).ofPoints;
  }

  Lobe lobeAt(const Vec3& p) const;

  /// The lobe of every point of the lung's surface.
  std::vector<Lobe> lobes() const;

  /// Where a fissure comes out upon the lung; the horizontal one above the oblique one alone.
  std::vector<SurfaceLine> contour(Fissure fissure) const;

  /// The fissure inside the lung; the horizontal one above the oblique one alone. Empty where it
  /// does not cross, or folds so that it meets itself seen along its normal.
  TriangleMesh patch(Fissure fissure, double spacingMm) const;

  /// As near as the grid inside the lung tells: to half a percent of the lung.
  std::map<Lobe, double> volumesMm3() const;

 private:
  struct Heights {
    HeightSurface surface;
    std::shared_ptr<const std::vector<float>> ofPoints;
    std::vector<float> inside;  ///< of the grid's points
  };

  Lobe lobeOf(float oblique, float horizontal) const;
  void shift(Fissure fissure, double byMm);

  std::shared_ptr<const LungShape> lung_;
  Fissure oblique_;
  bool hasHorizontal_;
  std::map<Fissure, Heights> fissures_;
};

}  // namespace pneuma
