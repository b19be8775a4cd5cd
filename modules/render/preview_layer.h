#pragma once

#include <cstddef>
#include <memory>
#include <span>
#include <vector>

#include <vtkNew.h>
#include <vtkShaderProperty.h>

#include "core/math.h"
#include "render/scene.h"

class vtkRenderer;

namespace pneuma {

/// The points that a running growth has placed, as dots. Of many only every second, fourth ... is
/// kept, in the order they came, so that a frame costs the same however many there are; a frame
/// after add() hands only the newest dots to the graphics card.
class PreviewLayer {
 public:
  explicit PreviewLayer(vtkRenderer* renderer);
  ~PreviewLayer();
  PreviewLayer(const PreviewLayer&) = delete;
  PreviewLayer& operator=(const PreviewLayer&) = delete;

  void add(std::span<const Vec3> points);
  void clear();

  /// The background decides on the colour.
  void setOptions(const SceneOptions& options);

  /// Call before each frame: dots fade with their distance from the eye.
  /// @param pixelRatio device pixels per logical one
  void followCamera(double pixelRatio);

  /// How many points came since clear().
  std::size_t points() const { return points_; }

  /// How many of them are drawn.
  std::size_t dots() const;

  /// Of all points that came; empty if there are none.
  const Box3& box() const { return box_; }

 private:
  class Chunk;

  void append(const float* position);
  void halve();
  void updateLook();

  vtkRenderer* renderer_;
  vtkNew<vtkShaderProperty> shader_;            ///< of all chunks
  std::vector<std::unique_ptr<Chunk>> chunks_;  ///< all full but the last
  std::size_t points_ = 0;
  std::size_t stride_ = 1;  ///< of the points that are dots
  Box3 box_;
  Background background_ = Background::Dark;
  double pixelRatio_ = 1.0;
};

}  // namespace pneuma
