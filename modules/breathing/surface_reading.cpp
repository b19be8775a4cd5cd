#include "breathing/surface_reading.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "core/error.h"
#include "core/parallel.h"
#include "geometry/nearest_triangle.h"

namespace pneuma {
namespace {

constexpr double BackMm = -2.0;
constexpr double SomeMm = 45.0;
constexpr double MoreMm = 80.0;
constexpr double LeastFacing = 0.3;  // cosine of a direction and the normal it starts from

Vec3 areaOf(const TriangleMesh& mesh, std::size_t triangle) {
  const auto& [a, b, c] = mesh.triangles[triangle];
  return (mesh.points[b] - mesh.points[a]).cross(mesh.points[c] - mesh.points[a]);
}

struct Target {
  TriangleMesh mesh;
  NearestTriangle lines;

  explicit Target(const TriangleMesh& surface) : mesh(surface), lines(mesh) {}

  /// Where a line first passes a triangle that faces as its start does. Without that it stops at
  /// another sheet of the surface: 5.6 mm off along true directions.
  std::optional<double> facing(const Vec3& p, const Vec3& direction, bool outwards,
                               double mostMm) const {
    for (const auto& hit : lines.along(p, direction, BackMm, mostMm)) {
      if ((areaOf(mesh, hit.triangle).dot(direction) > 0.0) == outwards) return hit.alongMm;
    }
    return std::nullopt;
  }
};

double ratioOf(double restMm3, double someMm3, double moreMm3) {
  if (!(restMm3 < someMm3) || !(someMm3 < moreMm3)) {
    throw InvalidInput("the surfaces of a lung hold " + std::to_string(restMm3 / 1000.0) + ", " +
                       std::to_string(someMm3 / 1000.0) + " and " +
                       std::to_string(moreMm3 / 1000.0) +
                       " ml; give them in the order of rising volumes");
  }
  return (moreMm3 - restMm3) / (someMm3 - restMm3);
}

}  // namespace

struct SurfaceReading::Surfaces {
  LungFrame frame;
  std::vector<Vec3> starts;
  std::vector<Vec3> normals;
  Target some;
  Target more;
  double ratio;  ///< of the third distance to the second one

  Surfaces(Side side, const TriangleMesh& rest, const TriangleMesh& second,
           const TriangleMesh& third, std::size_t mostPoints)
      : frame(side, bounds(rest)),
        some(second),
        more(third),
        ratio(ratioOf(signedVolumeMm3(rest), signedVolumeMm3(second), signedVolumeMm3(third))) {
    std::vector<Vec3> areas(rest.points.size(), Vec3::Zero());
    for (std::size_t t = 0; t < rest.triangles.size(); ++t) {
      for (const std::uint32_t n : rest.triangles[t]) areas[n] += areaOf(rest, t);
    }
    const std::size_t every = std::max<std::size_t>(
        1, (areas.size() + mostPoints - 1) / std::max<std::size_t>(1, mostPoints));
    for (std::size_t n = 0; n < areas.size(); n += every) {
      starts.push_back(rest.points[n]);
      normals.push_back(areas[n].normalized());
    }
  }

  std::optional<double> residual(std::size_t n, const PublishedForm& form) const {
    const Vec3 direction = frame.toLps(form.direction(frame.shareOf(starts[n])));
    const double facing = direction.dot(normals[n]);
    if (std::abs(facing) < LeastFacing) return std::nullopt;
    const auto near = some.facing(starts[n], direction, facing > 0.0, SomeMm);
    const auto far = more.facing(starts[n], direction, facing > 0.0, MoreMm);
    if (!near || !far) return std::nullopt;
    return *far - ratio * *near;
  }
};

SurfaceReading::SurfaceReading(Side side, const TriangleMesh& rest, const TriangleMesh& some,
                               const TriangleMesh& more, std::size_t mostPoints)
    : surfaces_(std::make_unique<Surfaces>(side, rest, some, more, mostPoints)) {}

SurfaceReading::~SurfaceReading() = default;
SurfaceReading::SurfaceReading(SurfaceReading&&) noexcept = default;
SurfaceReading& SurfaceReading::operator=(SurfaceReading&&) noexcept = default;

const LungFrame& SurfaceReading::frame() const { return surfaces_->frame; }

std::vector<double> SurfaceReading::residualsMm(const PublishedForm& form) const {
  std::vector<double> residuals(surfaces_->starts.size());
  parallelFor(residuals.size(),
              [&](std::size_t n) { residuals[n] = surfaces_->residual(n, form).value_or(0.0); });
  return residuals;
}

double SurfaceReading::meanResidualMm(const PublishedForm& form) const {
  double sum = 0.0;
  std::size_t count = 0;
  for (std::size_t n = 0; n < surfaces_->starts.size(); ++n) {
    const std::optional<double> residual = surfaces_->residual(n, form);
    if (!residual) continue;
    sum += std::abs(*residual);
    ++count;
  }
  if (count == 0) throw InvalidInput("no line along these directions passes all three surfaces");
  return sum / static_cast<double>(count);
}

}  // namespace pneuma
