#pragma once

#include <QAction>
#include <array>

class QMenu;

namespace pneuma {

/// What the slice views can be told to do. Single letters act while one of the views has the focus.
struct SliceActions {
  std::array<QAction*, 5> windows{};  ///< in the order of greyWindows()
  QAction* overlay = nullptr;         ///< checkable
  QAction* outlines = nullptr;        ///< checkable
  QAction* denser = nullptr;
  QAction* fainter = nullptr;
  QAction* annotations = nullptr;  ///< checkable
  QAction* crosshair = nullptr;    ///< checkable
  QAction* fourViews = nullptr;
  QAction* sceneAlone = nullptr;

  QList<QAction*> all() const;
};

SliceActions makeSliceActions(QObject* owner);

void fillSliceMenu(QMenu& menu, const SliceActions& actions);

}  // namespace pneuma
