#include "breathing/strain_directions.h"

#include <string>

#include "core/error.h"
#include "core/parallel.h"

namespace pneuma {
namespace {

constexpr double LeastShare = 1e-3;  // of the mean squared change, against division by zero

Vec3 directionOf(const VertexNeighbours& neighbours, std::span<const double> shot,
                 std::span<const Vec3> normals, std::size_t i) {
  const auto changeTo = [&](std::uint32_t j) {
    return (shot[i] * normals[i] - shot[j] * normals[j]).squaredNorm();
  };
  const std::span<const std::uint32_t> clique = neighbours.of(i);
  double sum = 0.0;
  for (const std::uint32_t j : clique) sum += changeTo(j);
  if (!(sum > 0.0)) return normals[i];  // all move alike
  const double least = LeastShare * sum / static_cast<double>(clique.size());
  Vec3 direction = Vec3::Zero();
  for (const std::uint32_t j : clique) {
    const double own = changeTo(j);
    direction += (sum - own + least) / (own + least) * normals[j];
  }
  const double length = direction.norm();
  return length > 0.0 ? Vec3(direction / length) : normals[i];
}

}  // namespace

std::vector<Vec3> strainDirections(const VertexNeighbours& neighbours, std::span<const double> shot,
                                   std::span<const Vec3> normals) {
  std::vector<Vec3> directions(normals.size());
  parallelFor(directions.size(),
              [&](std::size_t i) { directions[i] = directionOf(neighbours, shot, normals, i); });
  return directions;
}

VolumeSteps::VolumeSteps(const TriangleMesh& surface, std::span<const double> shot,
                         std::span<const Vec3> directions)
    : surface_(surface) {
  const std::size_t count = surface.points.size();
  if (shot.size() != count || directions.size() != count) {
    throw InvalidInput("there are " + std::to_string(shot.size()) + " strains and " +
                       std::to_string(directions.size()) + " directions for " +
                       std::to_string(count) + " points");
  }
  const std::vector<Vec3> areas = vertexAreaVectors(surface);
  displacement_.reserve(count);
  for (std::size_t n = 0; n < count; ++n) {
    displacement_.push_back(shot[n] * directions[n]);
    gain_ += displacement_.back().dot(areas[n]);
  }
  if (!(gain_ > 0.0)) {
    throw InvalidInput(
        "the surface does not get larger in its directions; is it inside out? Repair it with "
        "'pneuma repair'");
  }
}

void VolumeSteps::step(double volumeMm3) {
  const double scale = scaleFor(volumeMm3);
  for (std::size_t n = 0; n < displacement_.size(); ++n) {
    surface_.points[n] += scale * displacement_[n];
  }
}

}  // namespace pneuma
