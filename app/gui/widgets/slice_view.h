#pragma once

#include <QImage>
#include <QPoint>
#include <QWidget>
#include <optional>

#include "document/fissure_editor.h"
#include "document/lung_editor.h"
#include "document/slice_views.h"
#include "widgets/mouse_profile.h"
#include "widgets/view_keys.h"

class QPainter;

namespace pneuma {

/// One slice of the CT. A click moves the point that all views share; the wheel changes the slice
/// (Shift: five at once); Ctrl+wheel zooms; Shift+left drag moves the picture; W held + left drag
/// changes the window: across its width, down its level. What other drags do says the profile of
/// the mouse. With the keyboard: Up/Down, B/F and PageUp/PageDown change the slice, R shows
/// everything again. While fissures are edited, a left drag moves a mark of theirs and a right
/// click deletes a point; while points are set, a left click sets one, Backspace takes the last
/// back, Tab goes to the next fissure. While lungs are corrected, a left drag paints or erases
/// within the circle around the pointer, a click sets a seed.
class SliceView : public QWidget {
  Q_OBJECT

 public:
  SliceView(SliceViews& views, SlicePlane plane, QWidget* parent = nullptr);

  /// Takes part in editing fissures; null: no longer.
  void setEditor(FissureEditor* editor);

  /// Takes part in correcting lungs; null: no longer.
  void setLungEditor(LungEditor* editor);

  void setMouse(MouseProfile profile) { mouse_ = profile; }

  /// The pixel of this widget at which a point (LPS, mm) is drawn.
  QPoint positionOf(const Vec3& point) const;

  /// What the view shows, in device pixels.
  QImage picture() const;

 signals:
  /// The pointer is there; none once it has left.
  void hovered(std::optional<pneuma::Vec3> point);
  void doubleClicked(pneuma::SlicePlane plane);

 protected:
  void paintEvent(QPaintEvent* event) override;
  void mousePressEvent(QMouseEvent* event) override;
  void mouseMoveEvent(QMouseEvent* event) override;
  void mouseReleaseEvent(QMouseEvent* event) override;
  void mouseDoubleClickEvent(QMouseEvent* event) override;
  void wheelEvent(QWheelEvent* event) override;
  void keyPressEvent(QKeyEvent* event) override;
  void keyReleaseEvent(QKeyEvent* event) override;
  void leaveEvent(QEvent* event) override;
  /// Tab is for the fissures while points are set.
  bool focusNextPrevChild(bool next) override;

 private:
  enum class Drag { None, Point, Pan, Zoom, Window, Scroll, Mark, Stroke };

  SliceFrame frame() const;
  PicturePoint onPicture(const QPointF& position) const;
  void dragTo(const QPoint& position);
  /// What a button begins that is neither for fissures nor for lungs.
  Drag dragOf(const QMouseEvent& event) const;
  /// True if the press was for the fissures.
  bool pressFissure(const QMouseEvent& event);
  /// True if the press was for the lungs.
  bool pressLungs(const QMouseEvent& event);
  void drawBrush(QPainter& painter) const;
  void showCursor();
  bool act(SliceKey does);
  /// True if there is something to do.
  bool actOnFissures(SliceKey does);
  std::optional<FissureEditor::Mark> markAt(const QPoint& position) const;

  SliceViews& views_;
  SlicePlane plane_;
  Drag drag_ = Drag::None;
  MouseProfile mouse_ = MouseProfile::Usual;
  QPoint before_;                  ///< where the drag was last
  std::optional<QPoint> pressed_;  ///< where a drag began that is a click as long as it stays there
  int scrollRest_ = 0;             ///< dragged, but not yet a slice
  PicturePoint zoomedAbout_;       ///< where a zooming drag began
  bool windowKey_ = false;
  FissureEditor* editor_ = nullptr;
  FissureEditor::Mark mark_;  ///< that is dragged
  int wheelRest_ = 0;         ///< turned, but not yet a slice
  LungEditor* lungEditor_ = nullptr;
  std::optional<QPoint> pointer_;  ///< while it is here
  mutable QImage drawn_;           ///< what paintEvent() drew last; null: it has to be drawn anew
};

}  // namespace pneuma
