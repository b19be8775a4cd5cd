#include "document/slice_views.h"

#include <algorithm>
#include <utility>

#include "anatomy/lobe.h"
#include "document/text.h"

namespace pneuma {

namespace {

constexpr double MostZoom = 40.0;
constexpr double LeastZoom = 0.25;

}  // namespace

void SliceViews::show(std::shared_ptr<const CtImage> ct, std::shared_ptr<const LabelImage> labels) {
  if (ct == ct_ && labels == labels_) return;
  const bool other = ct != ct_;
  ct_ = std::move(ct);
  labels_ = std::move(labels);
  if (other && ct_) {
    zooms_ = {};
    const bool before = blockSignals(true);
    moveTo(ct_->geometry.bounds().center());
    blockSignals(before);
  }
  emit changed();
}

void SliceViews::setFissures(std::shared_ptr<const SliceFissures> fissures) {
  if (fissures == fissures_) return;
  fissures_ = std::move(fissures);
  emit changed();
}

void SliceViews::moveTo(const Vec3& point) {
  Vec3 next;
  for (const SlicePlane plane : SlicePlanes) {
    const SliceStack slices = stack(plane);
    const int axis = normalAxis(plane);
    next[axis] = slices.positionMm(slices.nearest(point[axis]));
  }
  if (next == point_) return;
  point_ = next;
  emit changed();
}

int SliceViews::slice(SlicePlane plane) const {
  return stack(plane).nearest(point_[normalAxis(plane)]);
}

void SliceViews::setSlice(SlicePlane plane, int slice) {
  const SliceStack slices = stack(plane);
  Vec3 point = point_;
  point[normalAxis(plane)] = slices.positionMm(std::clamp(slice, 0, slices.count - 1));
  moveTo(point);
}

SliceFrame SliceViews::frame(SlicePlane plane, int width, int height) const {
  const Zoom& zoom = zooms_[static_cast<std::size_t>(plane)];
  const int normal = normalAxis(plane);
  SliceFrame frame = framedSlice(ct_->geometry, plane, point_[normal], width, height);
  frame.centre += zoom.offset;
  frame.centre[normal] = point_[normal];
  frame.mmPerPixel /= zoom.factor;
  return frame;
}

void SliceViews::setFrame(const SliceFrame& frame) {
  const SliceFrame whole =
      framedSlice(ct_->geometry, frame.plane, frame.positionMm(), frame.width, frame.height);
  Zoom& zoom = zoomOf(frame.plane);
  zoom.factor = std::clamp(whole.mmPerPixel / frame.mmPerPixel, LeastZoom, MostZoom);
  // Some of the image stays in sight.
  const Vec3 reach = 0.5 * ct_->geometry.bounds().sizes();
  zoom.offset = (frame.centre - whole.centre).cwiseMax(-reach).cwiseMin(reach);
  emit changed();
}

void SliceViews::resetFrame(SlicePlane plane) {
  zoomOf(plane) = {};
  emit changed();
}

void SliceViews::setLook(const SliceLook& look) {
  if (look == look_) return;
  look_ = look;
  emit changed();
}

void SliceViews::showCrosshair(bool shown) {
  crosshair_ = shown;
  emit changed();
}

Picture SliceViews::picture(SlicePlane plane, int width, int height, double pixelRatio) const {
  SliceContents contents{ct_.get(), labels_.get()};
  if (crosshair_) contents.crosshair = point_;
  contents.fissures = fissures_.get();
  SliceLook look = look_;
  look.pixelRatio = pixelRatio;
  return slicePicture(contents, frame(plane, width, height), look);
}

QString SliceViews::probe(const Vec3& point) const {
  QStringList places;
  for (int axis = 0; axis < 3; ++axis) {
    QString place = qtText(positionText(axis, point[axis]));
    if (axis < 2) place.chop(3);  // the unit once, behind the last
    places << place;
  }
  const QString between = QStringLiteral("   |   ");
  QString text = places.join(QStringLiteral("   "));
  const std::optional<int> hu = huAt(*ct_, point);
  if (!hu) return text + between + tr("outside the CT");
  text += between + (*hu <= PaddingHu ? tr("not measured") : QStringLiteral("%1 HU").arg(*hu));
  if (labels_) {
    const std::uint8_t label = labelAt(*labels_, point).value_or(0);
    if (label != 0) text += between + qtText(longName(static_cast<Lobe>(label)));
  }
  return text;
}

}  // namespace pneuma
