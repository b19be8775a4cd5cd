#pragma once

#include <QObject>
#include <QString>
#include <array>
#include <memory>
#include <optional>

#include "core/image.h"
#include "render/slice_picture.h"

namespace pneuma {

/// What the three slice views show: one point that they share, where each of them is zoomed to, and
/// one look. Needs no display.
class SliceViews : public QObject {
  Q_OBJECT

 public:
  using QObject::QObject;

  /// Shows other images. Another CT is shown whole, from its middle; new labels of the same one
  /// change nothing else.
  void show(std::shared_ptr<const CtImage> ct, std::shared_ptr<const LabelImage> labels);

  /// Shows the labels again, of which some voxels were changed.
  void refresh() { emit changed(); }

  /// Shows fissures over the slices; null: none.
  void setFissures(std::shared_ptr<const SliceFissures> fissures);

  /// True if no CT is shown; nothing else may be asked then but look().
  bool empty() const { return ct_ == nullptr; }

  /// The point that all views go through, in the middle of a voxel where the CT is not oblique.
  const Vec3& point() const { return point_; }

  void moveTo(const Vec3& point);

  SliceStack stack(SlicePlane plane) const { return sliceStack(ct_->geometry, plane); }

  int slice(SlicePlane plane) const;
  void setSlice(SlicePlane plane, int slice);

  /// So many slices up, back or left.
  void step(SlicePlane plane, int slices) { setSlice(plane, slice(plane) + slices); }

  /// What a view of this size shows. @param width, height pixels, positive
  SliceFrame frame(SlicePlane plane, int width, int height) const;

  /// Shows what `frame` does; its position along the normal does not matter.
  void setFrame(const SliceFrame& frame);

  /// Shows the whole slice again.
  void resetFrame(SlicePlane plane);

  const SliceLook& look() const { return look_; }

  void setLook(const SliceLook& look);

  bool crosshairShown() const { return crosshair_; }

  void showCrosshair(bool shown);

  /// @param pixelRatio pixels to a logical pixel
  Picture picture(SlicePlane plane, int width, int height, double pixelRatio) const;

  /// "L 12.3   P 45.0   S 210.5 mm   |   -871 HU   |   right lung"
  QString probe(const Vec3& point) const;

 signals:
  /// The views look different now, whatever the reason.
  void changed();

 private:
  /// How a view differs from showing everything.
  struct Zoom {
    double factor = 1.0;
    Vec3 offset = Vec3::Zero();  ///< of the middle, mm
  };

  Zoom& zoomOf(SlicePlane plane) { return zooms_[static_cast<std::size_t>(plane)]; }

  std::shared_ptr<const CtImage> ct_;
  std::shared_ptr<const LabelImage> labels_;
  Vec3 point_ = Vec3::Zero();
  std::array<Zoom, 3> zooms_;
  SliceLook look_;
  std::shared_ptr<const SliceFissures> fissures_;
  bool crosshair_ = true;
};

}  // namespace pneuma
