#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "core/triangle_mesh.h"

namespace pneuma {

/// The points that share an edge with each point of a surface: what both papers of Santhanam call
/// its clique, the point itself left out.
class VertexNeighbours {
 public:
  explicit VertexNeighbours(const TriangleMesh& surface);

  std::size_t size() const { return first_.size() - 1; }

  /// In rising order, each once.
  std::span<const std::uint32_t> of(std::size_t vertex) const {
    return {all_.data() + first_[vertex], first_[vertex + 1] - first_[vertex]};
  }

 private:
  std::vector<std::size_t> first_;
  std::vector<std::uint32_t> all_;
};

/// One third of the area vectors of the triangles around each point, mm^2: by how much the enclosed
/// volume changes for a small step of it.
std::vector<Vec3> vertexAreaVectors(const TriangleMesh& surface);

}  // namespace pneuma
