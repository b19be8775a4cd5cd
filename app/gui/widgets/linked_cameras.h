#pragma once

#include <QObject>
#include <QTimer>
#include <vector>

#include <vtkCallbackCommand.h>
#include <vtkNew.h>

namespace pneuma {

class SceneView;

/// Lets 3-D views look from the same place: whichever is moved, the others follow.
class LinkedCameras : public QObject {
  Q_OBJECT

 public:
  /// @param views none null; they outlive this
  explicit LinkedCameras(std::vector<SceneView*> views, QObject* parent = nullptr);
  ~LinkedCameras() override;

 private:
  /// @param moved the view whose camera others take over
  void copyFrom(SceneView& moved);

  std::vector<SceneView*> views_;
  vtkNew<vtkCallbackCommand> observer_;
  QTimer settle_;
  bool copying_ = false;
};

}  // namespace pneuma
