#include "render/surface_layer.h"

#include <algorithm>
#include <memory>
#include <numeric>
#include <utility>

#include <vtkCamera.h>
#include <vtkNew.h>
#include <vtkPolyData.h>
#include <vtkPolyDataMapper.h>
#include <vtkPropCollection.h>
#include <vtkProperty.h>
#include <vtkRenderer.h>
#include <vtkShaderProperty.h>

#include "render/colour_map.h"
#include "render/convert.h"

namespace pneuma {
namespace {

constexpr Rgb NeutralTissue = rgbOfHex(0x93a3b8);
constexpr double LightGroundGain = 0.34 / 0.26;  // light backgrounds swallow thin veils

// Opacity rises towards the rim, where one looks along the wall: clear silhouettes, and the
// airways stay readable in the middle.
constexpr const char* RimShader = R"(//VTK::Light::Impl
  float rim = 1.0 - abs(dot(normalVCVSOutput, normalize(vertexVC.xyz)));
  gl_FragData[0].a = min(1.0, opacity * mix(0.40, 2.8, rim * rim));
)";

}  // namespace

vtkSmartPointer<vtkActor> veilOf(const TriangleMesh& mesh) {
  vtkNew<vtkPolyDataMapper> mapper;
  mapper->SetInputData(polyDataOf(mesh));
  mapper->ScalarVisibilityOff();
  mapper->StaticOn();
  auto actor = vtkSmartPointer<vtkActor>::New();
  actor->SetMapper(mapper);
  actor->PickableOff();
  actor->ForceTranslucentOn();
  vtkProperty* property = actor->GetProperty();
  // The side that faces away is left out; an inside-out surface shows it in place of the other.
  const bool outwards = signedVolumeMm3(mesh) >= 0.0;
  property->SetBackfaceCulling(outwards);
  property->SetFrontfaceCulling(!outwards);
  property->SetAmbient(0.12);
  property->SetDiffuse(0.88);
  property->SetSpecular(0.4);
  property->SetSpecularPower(36.0);
  property->SetInterpolationToPhong();
  actor->GetShaderProperty()->AddFragmentShaderReplacement("//VTK::Light::Impl", true, RimShader,
                                                           false);
  return actor;
}

double veilOpacity(const SceneOptions& options) {
  const double gain = options.background == Background::Dark ? 1.0 : LightGroundGain;
  return std::min(1.0, options.lobeOpacity * gain);
}

void SurfaceLayer::setSurfaces(std::vector<SceneSurface> surfaces, const SceneOptions& options) {
  for (const auto& actor : actors_) renderer_->RemoveActor(actor);
  actors_.clear();
  centres_.clear();
  surfaces_ = std::move(surfaces);
  for (SceneSurface& surface : surfaces_) {
    if (surface.mesh == nullptr) surface.mesh = std::make_shared<const TriangleMesh>();
    actors_.push_back(veilOf(*surface.mesh));
    actors_.back()->SetVisibility(surface.visible && shown_);
    centres_.push_back(surface.mesh->points.empty() ? Vec3(Vec3::Zero())
                                                    : Vec3(bounds(*surface.mesh).center()));
    renderer_->AddActor(actors_.back());
  }
  order_.resize(actors_.size());
  std::iota(order_.begin(), order_.end(), std::size_t{0});
  setOptions(options, false);
}

void SurfaceLayer::setVisible(std::size_t index, bool visible) {
  if (index >= surfaces_.size()) return;
  surfaces_[index].visible = visible;
  actors_[index]->SetVisibility(visible && shown_);
}

void SurfaceLayer::setShown(bool shown) {
  shown_ = shown;
  for (std::size_t i = 0; i < actors_.size(); ++i) {
    actors_[i]->SetVisibility(surfaces_[i].visible && shown_);
  }
}

void SurfaceLayer::setOptions(const SceneOptions& options, bool neutral) {
  for (std::size_t i = 0; i < actors_.size(); ++i) {
    const Rgb colour = neutral ? NeutralTissue : lobeColour(surfaces_[i].lobe, options.palette);
    vtkProperty* property = actors_[i]->GetProperty();
    property->SetColor(colour.r, colour.g, colour.b);
    property->SetOpacity(veilOpacity(options));
  }
}

void SurfaceLayer::sortBackToFront() {
  Vec3 eye;
  Vec3 ahead;
  renderer_->GetActiveCamera()->GetPosition(eye.data());
  renderer_->GetActiveCamera()->GetDirectionOfProjection(ahead.data());
  std::vector<std::size_t> order(actors_.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
    return (centres_[a] - eye).dot(ahead) > (centres_[b] - eye).dot(ahead);
  });
  if (order == order_) return;
  order_ = std::move(order);
  // In the collection itself: removing an actor from the renderer would drop its buffers.
  vtkPropCollection* props = renderer_->GetViewProps();
  for (const std::size_t i : order_) {
    props->RemoveItem(actors_[i]);
    props->AddItem(actors_[i]);
  }
}

}  // namespace pneuma
