#include "render/surface_layer.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <memory>
#include <numeric>
#include <utility>

#include <vtkCamera.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPolyData.h>
#include <vtkPolyDataMapper.h>
#include <vtkPropCollection.h>
#include <vtkProperty.h>
#include <vtkRenderer.h>
#include <vtkShaderProperty.h>
#include <vtkUnsignedCharArray.h>

#include "render/breath_shader.h"
#include "render/colour_map.h"
#include "render/convert.h"
#include "render/ray.h"
#include "render/tube_mesh.h"

namespace pneuma {
namespace {

constexpr Rgb NeutralTissue = rgbOfHex(0x93a3b8);
constexpr double ValuedGain = 2.5;
constexpr double LightGroundGain = 0.34 / 0.26;  // light backgrounds swallow thin veils

// Opacity rises towards the rim, where one looks along the wall: clear silhouettes, and the
// airways stay readable in the middle.
constexpr const char* RimShader = R"(//VTK::Light::Impl
  float rim = 1.0 - abs(dot(normalVCVSOutput, normalize(vertexVC.xyz)));
  gl_FragData[0].a = min(1.0, opacity * mix(0.40, 2.8, rim * rim));
)";

// The same while lungs move, by the same lights without highlights: most of a frame's time goes
// into these pixels where there is no graphics card.
constexpr const char* MovingRimShader = R"(vec3 toEye = normalize(vertexVC.xyz);
  float rim = 1.0 - abs(dot(normalVCVSOutput, toEye));
  float light = 0.50 + 0.50 * abs(normalVCVSOutput.z);
  gl_FragData[0] = vec4(light * diffuseColor,
                        min(1.0, opacity * mix(0.40, 2.8, rim * rim)));
)";

/// True of a sheet such as a fissure, which has no inside: its faces, as arrows, do not cancel out.
bool isSheet(const TriangleMesh& mesh) {
  constexpr double LeastShare = 0.2;  // a lobe with a hole stays a lobe
  Vec3 sum = Vec3::Zero();
  double area = 0.0;
  for (const auto& triangle : mesh.triangles) {
    const Vec3& a = mesh.points[triangle[0]];
    const Vec3 twice = (mesh.points[triangle[1]] - a).cross(mesh.points[triangle[2]] - a);
    sum += twice;
    area += twice.norm();
  }
  return sum.norm() > LeastShare * area;
}

/// A veil that moves; with colours of its points in place of one for all.
vtkSmartPointer<vtkActor> breathingVeil(const TriangleMesh& mesh,
                                        const std::vector<Vec3>& displacement,
                                        const std::vector<double>& values, const Scale& scale,
                                        Background background, Side side) {
  vtkSmartPointer<vtkActor> actor = veilOf(mesh);
  auto* mapper = vtkPolyDataMapper::SafeDownCast(actor->GetMapper());
  vtkPolyData* data = mapper->GetInput();
  if (!values.empty()) {
    vtkNew<vtkUnsignedCharArray> scalars;
    scalars->SetNumberOfComponents(3);
    for (const double value : values) {
      const auto bytes = bytesOf(onBackground(scaleColour(scale.position(value)), background));
      scalars->InsertNextTypedTuple(bytes.data());
    }
    data->GetPointData()->SetScalars(scalars);
    mapper->ScalarVisibilityOn();
  }
  letBreathe(actor, data, breathAttributes(mesh, displacement, side));
  return actor;
}

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
  // A sheet is seen from both sides.
  const bool outwards = signedVolumeMm3(mesh) >= 0.0;
  const bool sheet = isSheet(mesh);
  property->SetBackfaceCulling(!sheet && outwards);
  property->SetFrontfaceCulling(!sheet && !outwards);
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
  surfaces_ = std::move(surfaces);
  for (SceneSurface& surface : surfaces_) {
    if (surface.mesh == nullptr) surface.mesh = std::make_shared<const TriangleMesh>();
  }
  breathing_.reset();
  rebuild(options);
}

void SurfaceLayer::setBreathing(std::shared_ptr<const BreathingScene> breathing,
                                const SceneOptions& options) {
  const auto fits = [&] {
    if (breathing->surfaces.size() != surfaces_.size()) return false;
    for (std::size_t i = 0; i < surfaces_.size(); ++i) {
      if (breathing->surfaces[i].displacement.size() != surfaces_[i].mesh->points.size()) {
        return false;
      }
    }
    return true;
  };
  if (breathing && !fits()) breathing.reset();
  if (breathing == breathing_) return;
  breathing_ = std::move(breathing);
  rebuild(options);
}

Scale SurfaceLayer::valueScale() const {
  double low = std::numeric_limits<double>::max();
  double high = std::numeric_limits<double>::lowest();
  for (std::size_t i = 0; breathing_ && i < breathing_->surfaces.size(); ++i) {
    for (const double value : breathing_->surfaces[i].values) {
      low = std::min(low, value);
      high = std::max(high, value);
    }
  }
  return low <= high ? Scale(Scale::Kind::Linear, low, high) : Scale(Scale::Kind::Linear, 0.0, 1.0);
}

Legend SurfaceLayer::legend(Background background) const {
  if (!breathing_ || breathing_->quantity.empty()) return {};
  return valueScale().legend(breathing_->quantity, background);
}

void SurfaceLayer::rebuild(const SceneOptions& options) {
  for (const auto* actors : {&actors_, &coarse_}) {
    for (const auto& actor : *actors) {
      if (actor != nullptr) renderer_->RemoveActor(actor);
    }
  }
  actors_.assign(surfaces_.size(), nullptr);
  coarse_.assign(surfaces_.size(), nullptr);
  centres_.clear();
  farthestMm_.assign(surfaces_.size(), 0.0);
  scale_ = {};
  options_ = options;
  neutral_ = false;
  const Scale scale = valueScale();
  for (std::size_t i = 0; i < surfaces_.size(); ++i) {
    const TriangleMesh& mesh = *surfaces_[i].mesh;
    centres_.push_back(mesh.points.empty() ? Vec3(Vec3::Zero()) : Vec3(bounds(mesh).center()));
    if (!breathing_) continue;
    const BreathingScene::Surface& moving = breathing_->surfaces[i];
    for (const Vec3& u : moving.displacement) farthestMm_[i] = std::max(farthestMm_[i], u.norm());
    if (!moving.coarse) continue;
    coarse_[i] = breathingVeil(*moving.coarse, moving.coarseDisplacement, moving.coarseValues,
                               scale, options.background, moving.side);
    coarse_[i]->GetShaderProperty()->AddFragmentShaderReplacement("//VTK::Light::Impl", true,
                                                                  MovingRimShader, false);
    colour(coarse_[i], i);
    renderer_->AddActor(coarse_[i]);
  }
  order_.resize(surfaces_.size());
  std::iota(order_.begin(), order_.end(), std::size_t{0});
  showActors();
}

vtkActor* SurfaceLayer::fine(std::size_t index) {
  vtkSmartPointer<vtkActor>& actor = actors_[index];
  if (actor != nullptr) return actor;
  const TriangleMesh& mesh = *surfaces_[index].mesh;
  if (breathing_) {
    const BreathingScene::Surface& moving = breathing_->surfaces[index];
    actor = breathingVeil(mesh, moving.displacement, moving.values, valueScale(),
                          options_.background, moving.side);
    pneuma::setBreath(actor, scale_);
  } else {
    actor = veilOf(mesh);
  }
  colour(actor, index);
  renderer_->AddActor(actor);
  order_.clear();  // it stands in front of all others now
  return actor;
}

void SurfaceLayer::setBreath(const BreathScale& scale) {
  if (!breathing_ || scale == scale_) return;
  scale_ = scale;
  for (const auto* actors : {&actors_, &coarse_}) {
    for (const auto& actor : *actors) {
      if (actor != nullptr) pneuma::setBreath(actor, scale_);
    }
  }
}

void SurfaceLayer::setInteractive(bool interactive) {
  interactive_ = interactive;
  showActors();
}

double SurfaceLayer::reachMm() const {
  double reach = 0.0;
  for (std::size_t i = 0; breathing_ && i < surfaces_.size(); ++i) {
    const double s = scale_.of(breathing_->surfaces[i].side);
    reach = std::max(reach, std::abs(s) * farthestMm_[i]);
  }
  return reach;
}

std::optional<SurfaceHit> SurfaceLayer::firstHit(const Vec3& from, const Vec3& to) const {
  std::optional<SurfaceHit> first;
  double least = 1.0;
  for (std::size_t i = 0; i < surfaces_.size(); ++i) {
    if (!surfaces_[i].visible || !shown_) continue;
    const std::vector<Vec3>& rest = surfaces_[i].mesh->points;
    std::vector<Vec3> moved = rest;
    if (breathing_) {
      const BreathingScene::Surface& moving = breathing_->surfaces[i];
      const double s = scale_.of(moving.side);
      for (std::size_t n = 0; n < moved.size(); ++n) moved[n] += s * moving.displacement[n];
    }
    for (const auto& [a, b, c] : surfaces_[i].mesh->triangles) {
      const std::optional<RayHit> met = hit(from, to - from, moved[a], moved[b], moved[c]);
      if (!met || met->share > least) continue;
      least = met->share;
      const double ofA = 1.0 - met->b - met->c;
      first = SurfaceHit{i, ofA * rest[a] + met->b * rest[b] + met->c * rest[c]};
    }
  }
  return first;
}

void SurfaceLayer::setVisible(std::size_t index, bool visible) {
  if (index >= surfaces_.size()) return;
  surfaces_[index].visible = visible;
  showActors();
}

void SurfaceLayer::setDensity(std::size_t index, double density) {
  if (index >= surfaces_.size() || surfaces_[index].density == density) return;
  surfaces_[index].density = density;
  for (vtkActor* actor : {actors_[index].Get(), coarse_[index].Get()}) {
    if (actor != nullptr) colour(actor, index);
  }
}

void SurfaceLayer::setShown(bool shown) {
  shown_ = shown;
  showActors();
}

void SurfaceLayer::showActors() {
  for (std::size_t i = 0; i < actors_.size(); ++i) {
    const bool visible = surfaces_[i].visible && shown_;
    const bool fewer = interactive_ && coarse_[i] != nullptr;
    if (visible && !fewer) {
      fine(i)->VisibilityOn();
    } else if (actors_[i] != nullptr) {
      actors_[i]->VisibilityOff();
    }
    if (coarse_[i] != nullptr) coarse_[i]->SetVisibility(visible && fewer);
  }
}

void SurfaceLayer::setOptions(const SceneOptions& options, bool neutral) {
  options_ = options;
  neutral_ = neutral;
  for (std::size_t i = 0; i < actors_.size(); ++i) {
    for (vtkActor* actor : {actors_[i].Get(), coarse_[i].Get()}) {
      if (actor != nullptr) colour(actor, i);
    }
  }
}

void SurfaceLayer::colour(vtkActor* actor, std::size_t index) const {
  const Rgb colour = neutral_ ? NeutralTissue : lobeColour(surfaces_[index].lobe, options_.palette);
  actor->GetProperty()->SetColor(colour.r, colour.g, colour.b);
  // Colours that mean a number must be readable through the veil.
  const bool valued = breathing_ && !breathing_->quantity.empty();
  actor->GetProperty()->SetOpacity(std::min(
      1.0, (valued ? ValuedGain : 1.0) * surfaces_[index].density * veilOpacity(options_)));
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
    for (vtkActor* actor : {actors_[i].Get(), coarse_[i].Get()}) {
      if (actor == nullptr) continue;
      props->RemoveItem(actor);
      props->AddItem(actor);
    }
  }
}

}  // namespace pneuma
