#include "widgets/linked_cameras.h"

#include <algorithm>
#include <utility>

#include <vtkCamera.h>
#include <vtkRenderer.h>

#include "core/math.h"
#include "widgets/scene_view.h"

namespace pneuma {

namespace {

constexpr int StillMs = 250;  ///< without a movement the followers become fine again

bool samePose(vtkCamera& a, vtkCamera& b) {
  constexpr double Mm = 1e-9;
  return (Vec3(a.GetPosition()) - Vec3(b.GetPosition())).norm() < Mm &&
         (Vec3(a.GetFocalPoint()) - Vec3(b.GetFocalPoint())).norm() < Mm &&
         (Vec3(a.GetViewUp()) - Vec3(b.GetViewUp())).norm() < Mm;
}

void copyPose(vtkCamera& from, vtkCamera& to) {
  to.SetPosition(from.GetPosition());
  to.SetFocalPoint(from.GetFocalPoint());
  to.SetViewUp(from.GetViewUp());
}

}  // namespace

void SceneView::setPeers(std::vector<std::shared_ptr<const AirwayTree>> peers) {
  scene_->setPeers(std::move(peers));
  renderSoon();
}

void SceneView::follow(bool coarse) {
  dragging(coarse);
  renderSoon();
}

vtkCamera* SceneView::camera() const { return scene_->renderer()->GetActiveCamera(); }

LinkedCameras::LinkedCameras(std::vector<SceneView*> views, QObject* parent)
    : QObject(parent), views_(std::move(views)) {
  observer_->SetClientData(this);
  observer_->SetCallback([](vtkObject* camera, unsigned long, void* self, void*) {
    auto* linked = static_cast<LinkedCameras*>(self);
    for (SceneView* view : linked->views_) {
      if (view->camera() == camera) linked->copyFrom(*view);
    }
  });
  for (SceneView* view : views_) view->camera()->AddObserver(vtkCommand::ModifiedEvent, observer_);
  settle_.setSingleShot(true);
  settle_.setInterval(StillMs);
  connect(&settle_, &QTimer::timeout, this, [this] {
    for (SceneView* view : views_) view->follow(false);
  });
}

LinkedCameras::~LinkedCameras() {
  for (SceneView* view : views_) view->camera()->RemoveObserver(observer_);
}

void LinkedCameras::copyFrom(SceneView& moved) {
  if (std::exchange(copying_, true)) return;
  bool any = false;
  for (SceneView* view : views_) {
    if (view == &moved || samePose(*moved.camera(), *view->camera())) continue;
    copyPose(*moved.camera(), *view->camera());
    view->follow(true);
    any = true;
  }
  copying_ = false;
  if (any) settle_.start();
}

}  // namespace pneuma
