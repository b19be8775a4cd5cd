#include "document/lung_editor.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "document/text.h"

namespace pneuma {

namespace {

constexpr std::array<double, 12> BrushRadiiMm = {1.0,  2.0,  3.0,  4.0,  6.0,  8.0,
                                                 10.0, 15.0, 20.0, 30.0, 50.0, 100.0};
constexpr double LeastLimitHu = -1000.0;
constexpr double MostLimitHu = 1000.0;

BrushShape discOf(SlicePlane plane) {
  switch (plane) {
    case SlicePlane::Axial:
      return BrushShape::AxialDisc;
    case SlicePlane::Coronal:
      return BrushShape::CoronalDisc;
    case SlicePlane::Sagittal:
      break;
  }
  return BrushShape::SagittalDisc;
}

QString lungOf(Side side) {
  return side == Side::Right  ? QObject::tr("right lung")
         : side == Side::Left ? QObject::tr("left lung")
                              : QObject::tr("lung");
}

}  // namespace

LungEditor::LungEditor(Document& document, SliceViews& slices, QObject* parent)
    : QObject(parent), document_(document), slices_(slices) {
  connect(&document_, &Document::changed, this, &LungEditor::follow);
}

void LungEditor::setTool(Tool tool) {
  if (tool == tool_) return;
  abandon();
  tool_ = tool;
  emit changed();
}

void LungEditor::setRadius(double mm) {
  const double next = std::clamp(std::round(10.0 * mm) / 10.0, LeastBrushMm, MostBrushMm);
  if (next == radiusMm_) return;
  radiusMm_ = next;
  emit changed();
}

void LungEditor::stepRadius(int by) {
  if (by > 0) {
    const auto* larger = std::ranges::upper_bound(BrushRadiiMm, radiusMm_);
    setRadius(larger == BrushRadiiMm.end() ? MostBrushMm : *larger);
  } else {
    const auto* at = std::ranges::lower_bound(BrushRadiiMm, radiusMm_);
    setRadius(at == BrushRadiiMm.begin() ? LeastBrushMm : *(at - 1));
  }
}

void LungEditor::setChoice(Choice choice) {
  if (choice == choice_) return;
  choice_ = choice;
  emit changed();
}

void LungEditor::setDisc(bool disc) {
  if (disc == disc_) return;
  disc_ = disc;
  emit changed();
}

void LungEditor::setLimited(bool limited) {
  if (limited == limited_) return;
  limited_ = limited;
  emit changed();
}

void LungEditor::setLimit(double hu) {
  const double next = std::clamp(std::round(hu), LeastLimitHu, MostLimitHu);
  if (next == limitHu_) return;
  limitHu_ = next;
  emit changed();
}

std::optional<Side> LungEditor::sideAt(const Vec3& point) {
  if (choice_ == Choice::Right) return Side::Right;
  if (choice_ == Choice::Left) return Side::Left;
  if (tool_ == Tool::Eraser) return Side::None;
  const Side side = nearestLung(*document_.model().labels, point);
  if (side != Side::None) return side;
  emit said(tr("No lung is near: choose right or left under Lung."));
  return std::nullopt;
}

void LungEditor::press(SlicePlane plane, const Vec3& point) {
  if (tool_ == Tool::None) return;
  abandon();
  if (const QString obstacle = document_.correctionObstacle(); !obstacle.isEmpty()) {
    emit said(obstacle);
    return;
  }
  const auto& labels = document_.model().labels;
  LungEdit edit;
  edit.tool = tool_ == Tool::Brush    ? LungTool::Paint
              : tool_ == Tool::Eraser ? LungTool::Erase
                                      : LungTool::Seed;
  if (brushing()) edit.radiusMm = radiusMm_;
  if (brushing() && disc_) edit.shape = discOf(plane);
  if (limited_ || tool_ == Tool::Seed) edit.belowHu = limitHu_;
  edit.points = {point};
  edit.side = Side::Right;                                 // for the moment
  if (!problemOf(edit, labels->geometry).empty()) return;  // beside the image
  const std::optional<Side> side = sideAt(point);
  if (!side) return;
  edit.side = *side;
  if (tool_ == Tool::Seed) {
    document_.growSeed(edit, tr("grow %1 from a seed").arg(lungOf(edit.side)));
    return;
  }
  edit_ = std::move(edit);
  base_ = labels;
  draft_ = std::make_shared<LabelImage>(*base_);
  applyEdit(*document_.model().ct, edit_, *draft_);
  slices_.show(document_.model().ct, draft_);
}

void LungEditor::drag(const Vec3& point) {
  if (!draft_) return;
  LungEdit part = edit_;
  part.points = {edit_.points.back(), point};
  if (point == edit_.points.back() || !problemOf(part, draft_->geometry).empty()) return;
  edit_.points.push_back(point);
  applyEdit(*document_.model().ct, part, *draft_);
  slices_.refresh();
}

void LungEditor::release() {
  if (!draft_) return;
  const std::shared_ptr<const LabelImage> labels = std::exchange(draft_, nullptr);
  const bool same = labels->voxels == base_->voxels;
  base_ = nullptr;
  if (same) {
    // Nothing to undo.
    slices_.show(document_.model().ct, document_.model().labels);
    return;
  }
  const QString what = edit_.tool == LungTool::Paint ? tr("paint %1").arg(lungOf(edit_.side))
                                                     : tr("erase %1").arg(lungOf(edit_.side));
  document_.correctLungs(std::exchange(edit_, {}), labels, what);
}

void LungEditor::abandon() {
  if (!draft_) return;
  draft_ = nullptr;
  base_ = nullptr;
  slices_.show(document_.model().ct, document_.model().labels);
}

void LungEditor::follow() {
  if (draft_ && base_ != document_.model().labels) {
    draft_ = nullptr;
    base_ = nullptr;
  }
  if (tool_ != Tool::None && (!document_.model().ct || !document_.model().labels)) {
    tool_ = Tool::None;
  }
  emit changed();
}

}  // namespace pneuma
