#pragma once

#include <QObject>
#include <QString>
#include <memory>
#include <optional>

#include "document/document.h"
#include "document/slice_views.h"

namespace pneuma {

/// The lungs while they are corrected by hand: the brush, and what a stroke that is not over makes
/// of the labels, seen in the slices at once. The document gets a stroke when it is done. Needs no
/// display.
class LungEditor : public QObject {
  Q_OBJECT

 public:
  enum class Tool { None, Brush, Eraser, Seed };

  /// Which lung: the one under the stroke or nearest to it, or always the same.
  enum class Choice { Nearest, Right, Left };

  LungEditor(Document& document, SliceViews& slices, QObject* parent = nullptr);

  Tool tool() const { return tool_; }

  void setTool(Tool tool);

  /// True if a circle shows what a stroke would cover.
  bool brushing() const { return tool_ == Tool::Brush || tool_ == Tool::Eraser; }

  double radiusMm() const { return radiusMm_; }

  /// To a tenth of a millimetre, within LeastBrushMm and MostBrushMm.
  void setRadius(double mm);

  /// The next larger radius of a fixed row, or the next smaller one for -1.
  void stepRadius(int by);

  Choice choice() const { return choice_; }

  void setChoice(Choice choice);

  /// True if the brush is a disc in the slice that is drawn in, else a ball.
  bool disc() const { return disc_; }

  void setDisc(bool disc);

  /// True if only voxels less dense than limitHu() are painted or erased. A seed is limited anyway.
  bool limited() const { return limited_; }

  void setLimited(bool limited);

  double limitHu() const { return limitHu_; }

  void setLimit(double hu);

  /// True from press() until release() of a stroke.
  bool stroking() const { return draft_ != nullptr; }

  /// The labels with the stroke that is not over; null if there is none.
  std::shared_ptr<const LabelImage> draft() const { return draft_; }

  /// Begins a stroke, or sets a seed, at a point of a slice (LPS, mm). Says why where it cannot.
  void press(SlicePlane plane, const Vec3& point);

  /// The stroke goes on.
  void drag(const Vec3& point);

  /// The stroke is done, and becomes an edit.
  void release();

  /// Gives the stroke up.
  void abandon();

 signals:
  /// Anything that the functions above tell, but for the draft.
  void changed();

  /// One sentence for the status bar.
  void said(const QString& sentence);

 private:
  std::optional<Side> sideAt(const Vec3& point);
  void follow();

  Document& document_;
  SliceViews& slices_;
  Tool tool_ = Tool::None;
  Choice choice_ = Choice::Nearest;
  double radiusMm_ = 6.0;
  bool disc_ = false;
  bool limited_ = false;
  double limitHu_ = SeedBelowHu;
  LungEdit edit_;                           ///< the stroke that is not over
  std::shared_ptr<LabelImage> draft_;       ///< with it; null: there is none
  std::shared_ptr<const LabelImage> base_;  ///< what it was begun on
};

}  // namespace pneuma
