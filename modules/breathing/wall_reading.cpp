#include "breathing/wall_reading.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <string>

#include "breathing/surface_points.h"
#include "core/error.h"
#include "core/parallel.h"
#include "geometry/nearest_triangle.h"

namespace pneuma {
namespace {

constexpr double MostDistanceMm = 30.0;
constexpr double LeastAgreement = 0.3;  // cosine of the wall's normal and the later surface's

Vec3 normalOf(const TriangleMesh& mesh, std::size_t triangle) {
  const auto& [a, b, c] = mesh.triangles[triangle];
  return (mesh.points[b] - mesh.points[a]).cross(mesh.points[c] - mesh.points[a]).normalized();
}

double strainBetween(Side side, double restMm3, double laterMm3) {
  if (!(restMm3 > 0.0 && restMm3 < laterMm3)) {
    throw InvalidInput("the surfaces of the " + std::string(name(side)) + " lung hold " +
                       std::to_string(std::lround(restMm3 / 1000.0)) + " and later " +
                       std::to_string(std::lround(laterMm3 / 1000.0)) +
                       " ml; the later one has to be the larger one");
  }
  return std::cbrt(laterMm3 / restMm3) - 1.0;
}

}  // namespace

struct WallReading::Walls {
  StrainedLung lung;
  std::vector<Vec3> starts;
  std::vector<Vec3> normals;
  TriangleMesh mesh;
  NearestTriangle later;

  Walls(Side side, const TriangleMesh& rest, const TriangleMesh& target, std::size_t mostPoints)
      : lung{{side, bounds(rest)},
             strainBetween(side, signedVolumeMm3(rest), signedVolumeMm3(target))},
        mesh(target),
        later(mesh) {
    const std::vector<Vec3> outwards = pointNormals(rest);
    const std::size_t every = std::max<std::size_t>(
        1, (outwards.size() + mostPoints - 1) / std::max<std::size_t>(1, mostPoints));
    for (std::size_t n = 0; n < outwards.size(); n += every) {
      starts.push_back(rest.points[n]);
      normals.push_back(outwards[n]);
    }
  }

  std::optional<WallPair> pair(std::size_t n, const Vec3& moved) const {
    const NearestTriangle::Hit hit = later.nearest(moved);
    const WallPair found{starts[n], hit.point, normalOf(mesh, hit.triangle)};
    const bool facing = found.normal.dot(normals[n]) >= LeastAgreement;
    return facing && (moved - hit.point).norm() <= MostDistanceMm ? std::optional(found)
                                                                  : std::nullopt;
  }
};

WallReading::WallReading(Side side, const TriangleMesh& rest, const TriangleMesh& later,
                         std::size_t mostPoints)
    : walls_(std::make_unique<Walls>(side, rest, later, mostPoints)) {}

WallReading::~WallReading() = default;
WallReading::WallReading(WallReading&&) noexcept = default;
WallReading& WallReading::operator=(WallReading&&) noexcept = default;

const StrainedLung& WallReading::lung() const { return walls_->lung; }

std::vector<WallPair> WallReading::pairs(const MotionForm& form, const Vec3& shift) const {
  const FormField field(form, walls_->lung.frame, walls_->lung.strain);
  std::vector<std::optional<WallPair>> found(walls_->starts.size());
  parallelFor(found.size(), [&](std::size_t n) {
    const Vec3& p = walls_->starts[n];
    found[n] = walls_->pair(n, p + field.at(p) + shift);
  });
  std::vector<WallPair> kept;
  for (const std::optional<WallPair>& pair : found) {
    if (pair) kept.push_back(*pair);
  }
  return kept;
}

double meanDistanceMm(const WallReading& reading, const MotionForm& form, const Vec3& shift) {
  const FormField field(form, reading.lung().frame, reading.lung().strain);
  const std::vector<WallPair> pairs = reading.pairs(form, shift);
  double sum = 0.0;
  for (const WallPair& pair : pairs) {
    sum += std::abs(pair.distanceMm(pair.start + field.at(pair.start) + shift));
  }
  return pairs.empty() ? 0.0 : sum / static_cast<double>(pairs.size());
}

}  // namespace pneuma
