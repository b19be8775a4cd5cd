#pragma once

#include <QWidget>
#include <array>
#include <optional>

#include "document/slice_views.h"
#include "widgets/mouse_profile.h"

class QGridLayout;
class QSlider;

namespace pneuma {

class SliceView;
struct Actions;

/// The slices of a CT beside the 3-D view: axial and 3-D above, coronal and sagittal below. Without
/// a CT the 3-D view has all the room. A double click gives it to one view, and back.
class CtViews : public QWidget {
  Q_OBJECT

 public:
  /// @param scene the 3-D view; taken over
  CtViews(SliceViews& views, QWidget* scene, const Actions& actions, QWidget* parent = nullptr);

  void setMouse(MouseProfile profile);

  SliceView& slice(SlicePlane plane) const { return *slices_[static_cast<std::size_t>(plane)]; }

 signals:
  /// The pointer is on a slice; none once it has left.
  void hovered(std::optional<pneuma::Vec3> point);

 private:
  QWidget* makePane(SlicePlane plane);
  void connectActions(const Actions& actions);
  void follow();
  /// @param only the widget that has all the room; null for all views
  void arrange(QWidget* only);

  SliceViews& views_;
  QWidget* scene_;
  QGridLayout* grid_;
  std::array<SliceView*, 3> slices_{};
  std::array<QSlider*, 3> bars_{};
  std::array<QWidget*, 3> panes_{};
  QWidget* only_ = nullptr;
  bool shown_ = false;  ///< there is a CT
};

}  // namespace pneuma
