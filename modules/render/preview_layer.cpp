#include "render/preview_layer.h"

#include <algorithm>
#include <utility>

#include <vtkActor.h>
#include <vtkCamera.h>
#include <vtkCellArray.h>
#include <vtkFloatArray.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkPolyDataMapper.h>
#include <vtkProperty.h>
#include <vtkRenderer.h>
#include <vtkUniforms.h>

#include "render/colour_map.h"

namespace pneuma {
namespace {

constexpr std::size_t DotsPerChunk = 10'000;  // what a frame hands over anew at most, about
constexpr std::size_t MostChunks = 20;        // even, so that half of them are whole ones
constexpr double DotPixels = 1.6;
constexpr double FadePerChunk = 0.15;  // into the background, so that what is new stands out
constexpr double MostFade = 0.45;

// Far dots fade into the background: unlit and all of one colour, they would show no depth.
constexpr const char* DepthShader = R"(//VTK::Light::Impl
  float depth = clamp((1.0 / gl_FragCoord.w - nearestMm) / (farthestMm - nearestMm), 0.0, 1.0);
  gl_FragData[0].rgb = mix(gl_FragData[0].rgb, ground, 0.75 * depth);
)";

/// The colour of the nearest and newest dots, and of the background in the middle.
struct Look {
  Rgb dot;
  Rgb ground;
};

Look lookOn(Background background) {
  const Rgb ivory = lobeColour(Lobe::Central, Palette::Pneuma);
  if (background == Background::Dark) return {ivory, rgbOfHex(0x14171c)};
  Lab lab = labOf(ivory);
  lab.l *= 0.35;
  return {rgbOf(lab), background == Background::Light ? rgbOfHex(0xf0f2f5) : rgbOfHex(0xffffff)};
}

}  // namespace

/// Dots in one actor of their own: VTK hands an actor's points over again when one is added.
class PreviewLayer::Chunk {
 public:
  Chunk(vtkRenderer* renderer, vtkShaderProperty* shader) : renderer_(renderer) {
    vtkNew<vtkPoints> points;
    positions_->SetNumberOfComponents(3);
    points->SetData(positions_);
    data_->SetPoints(points);
    data_->SetVerts(vertices_);
    vtkNew<vtkPolyDataMapper> mapper;
    mapper->SetInputData(data_);
    actor_->SetMapper(mapper);
    actor_->SetShaderProperty(shader);
    actor_->PickableOff();
    actor_->GetProperty()->LightingOff();
    renderer_->AddActor(actor_);
  }

  ~Chunk() { renderer_->RemoveActor(actor_); }

  Chunk(const Chunk&) = delete;
  Chunk& operator=(const Chunk&) = delete;

  void append(const float* position) {
    const vtkIdType id = positions_->InsertNextTypedTuple(position);
    vertices_->InsertNextCell(1, &id);
  }

  /// Tells VTK that dots were appended.
  void changed() {
    data_->GetPoints()->Modified();
    vertices_->Modified();
    data_->Modified();
  }

  void setLook(const Rgb& colour, double pixels) {
    actor_->GetProperty()->SetColor(colour.r, colour.g, colour.b);
    actor_->GetProperty()->SetPointSize(static_cast<float>(pixels));
  }

  std::size_t size() const { return static_cast<std::size_t>(positions_->GetNumberOfTuples()); }

  const float* position(std::size_t i) const {
    return positions_->GetPointer(3 * static_cast<vtkIdType>(i));
  }

 private:
  vtkRenderer* renderer_;
  vtkNew<vtkFloatArray> positions_;
  vtkNew<vtkCellArray> vertices_;
  vtkNew<vtkPolyData> data_;
  vtkNew<vtkActor> actor_;
};

PreviewLayer::PreviewLayer(vtkRenderer* renderer) : renderer_(renderer) {
  shader_->AddFragmentShaderReplacement("//VTK::Light::Impl", true, DepthShader, false);
}

PreviewLayer::~PreviewLayer() = default;

void PreviewLayer::add(std::span<const Vec3> points) {
  for (const Vec3& point : points) {
    box_.extend(point);
    if (points_++ % stride_ != 0) continue;
    if (dots() == MostChunks * DotsPerChunk) halve();
    const Eigen::Vector3f position = point.cast<float>();
    append(position.data());
  }
  if (!chunks_.empty()) chunks_.back()->changed();
}

void PreviewLayer::clear() {
  chunks_.clear();
  points_ = 0;
  stride_ = 1;
  box_.setEmpty();
}

void PreviewLayer::setOptions(const SceneOptions& options) {
  background_ = options.background;
  updateLook();
}

void PreviewLayer::followCamera(double pixelRatio) {
  if (chunks_.empty()) return;
  Vec3 eye;
  Vec3 ahead;
  renderer_->GetActiveCamera()->GetPosition(eye.data());
  renderer_->GetActiveCamera()->GetDirectionOfProjection(ahead.data());
  const double middle = (box_.center() - eye).dot(ahead);
  const double reach = 0.5 * box_.sizes().dot(ahead.cwiseAbs()) + 1.0;  // of one point, too
  vtkUniforms* uniforms = shader_->GetFragmentCustomUniforms();
  uniforms->SetUniformf("nearestMm", static_cast<float>(middle - reach));
  uniforms->SetUniformf("farthestMm", static_cast<float>(middle + reach));
  if (pixelRatio == pixelRatio_) return;
  pixelRatio_ = pixelRatio;
  updateLook();
}

std::size_t PreviewLayer::dots() const {
  return chunks_.empty() ? 0 : (chunks_.size() - 1) * DotsPerChunk + chunks_.back()->size();
}

void PreviewLayer::append(const float* position) {
  if (chunks_.empty() || chunks_.back()->size() == DotsPerChunk) {
    if (!chunks_.empty()) chunks_.back()->changed();
    chunks_.push_back(std::make_unique<Chunk>(renderer_, shader_));
    updateLook();
  }
  chunks_.back()->append(position);
}

/// Keeps every second dot.
void PreviewLayer::halve() {
  stride_ *= 2;
  const auto before = std::exchange(chunks_, {});
  for (const auto& chunk : before) {
    for (std::size_t i = 0; i < DotsPerChunk; i += 2) append(chunk->position(i));
  }
}

void PreviewLayer::updateLook() {
  const Look look = lookOn(background_);
  const Eigen::Vector3f ground = Vec3(look.ground.r, look.ground.g, look.ground.b).cast<float>();
  shader_->GetFragmentCustomUniforms()->SetUniform3f("ground", ground.data());
  for (std::size_t i = 0; i < chunks_.size(); ++i) {
    // Only the newest few change when one more comes: VTK hands an actor over whose look changes.
    const double fade = FadePerChunk * static_cast<double>(chunks_.size() - 1 - i);
    chunks_[i]->setLook(mixed(look.dot, look.ground, std::min(fade, MostFade)),
                        DotPixels * pixelRatio_);
  }
}

}  // namespace pneuma
