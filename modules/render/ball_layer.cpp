#include "render/ball_layer.h"

#include <cmath>
#include <numbers>
#include <utility>

#include <vtkProperty.h>
#include <vtkRenderer.h>

#include "render/colour.h"
#include "render/surface_layer.h"

namespace pneuma {
namespace {

constexpr Rgb StiffColour = rgbOfHex(0xff6f4e);
constexpr Rgb SoftColour = rgbOfHex(0x58d3c4);
constexpr double Opacity = 0.30;
constexpr double ChosenOpacity = 0.55;

/// A ball of radius 1 by rings from pole to pole.
TriangleMesh unitBall() {
  constexpr std::uint32_t Rings = 16;
  constexpr std::uint32_t Around = 28;
  TriangleMesh mesh;
  for (std::uint32_t ring = 0; ring <= Rings; ++ring) {
    const double down = std::numbers::pi * ring / Rings;
    for (std::uint32_t k = 0; k < Around; ++k) {
      const double turn = 2.0 * std::numbers::pi * k / Around;
      mesh.points.emplace_back(std::sin(down) * std::cos(turn), std::sin(down) * std::sin(turn),
                               std::cos(down));
    }
  }
  for (std::uint32_t ring = 0; ring < Rings; ++ring) {
    for (std::uint32_t k = 0; k < Around; ++k) {
      const std::uint32_t a = ring * Around + k;
      const std::uint32_t b = ring * Around + (k + 1) % Around;
      mesh.triangles.push_back({a, a + Around, b + Around});
      mesh.triangles.push_back({a, b + Around, b});
    }
  }
  return mesh;
}

}  // namespace

void BallLayer::setBalls(std::vector<SceneBall> balls) {
  if (balls == balls_) return;
  balls_ = std::move(balls);
  for (const auto& actor : actors_) renderer_->RemoveActor(actor);
  actors_.clear();
  for (std::size_t i = 0; i < balls_.size(); ++i) {
    actors_.push_back(veilOf(unitBall()));
    vtkProperty* property = actors_.back()->GetProperty();
    const Rgb& colour = balls_[i].stiff ? StiffColour : SoftColour;
    property->SetColor(colour.r, colour.g, colour.b);
    property->SetOpacity(balls_[i].chosen ? ChosenOpacity : Opacity);
    actors_.back()->SetScale(balls_[i].radiusMm);
    place(i);
    renderer_->AddActor(actors_.back());
  }
}

void BallLayer::setBreath(const BreathScale& scale) {
  scale_ = scale;
  for (std::size_t i = 0; i < actors_.size(); ++i) place(i);
}

void BallLayer::place(std::size_t index) {
  const SceneBall& ball = balls_[index];
  const Vec3 at = ball.centre + scale_.of(ball.side) * ball.displacement;
  actors_[index]->SetPosition(at.x(), at.y(), at.z());
}

}  // namespace pneuma
