#include "breathing/volume_layer.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "breathing/screened_laplacian.h"
#include "breathing/surface_points.h"
#include "breathing/volume_polynomial.h"
#include "core/error.h"
#include "geometry/nearest_triangle.h"

namespace pneuma {
namespace {

constexpr double DepthMm = 15.0;
constexpr double SmoothMm = 10.0;
constexpr double SolvedTo = 1e-8;
constexpr double MostMm = 10.0;  // of a; its slope in depth is a / 15 mm

/// Normals that change over SmoothMm whatever the triangles' size: N of (M + l^2 L) N = M N0.
std::vector<Vec3> smoothedNormals(const TriangleMesh& surface) {
  std::vector<Vec3> normals = pointNormals(surface);
  const std::vector<double> areas = pointAreas(surface);
  const PointMatrix matrix = screenedLaplacian(surface, areas, {}, SmoothMm);
  std::vector<double> wanted(areas.size());
  for (int axis = 0; axis < 3; ++axis) {
    for (std::size_t n = 0; n < areas.size(); ++n) wanted[n] = areas[n] * normals[n][axis];
    const std::vector<double> solved = solve(matrix, wanted, {SolvedTo});
    for (std::size_t n = 0; n < areas.size(); ++n) normals[n][axis] = solved[n];
  }
  for (Vec3& normal : normals) {
    if (!normal.isZero(0.0)) normal.normalize();
  }
  return normals;
}

}  // namespace

struct VolumeLayer::Surface {
  TriangleMesh mesh;
  std::vector<Vec3> normals;
  NearestTriangle nearest;

  explicit Surface(const TriangleMesh& surface)
      : mesh(surface), normals(smoothedNormals(surface)), nearest(mesh) {}
};

VolumeLayer::VolumeLayer(const TriangleMesh& surface)
    : surface_(std::make_unique<Surface>(surface)) {}

VolumeLayer::~VolumeLayer() = default;
VolumeLayer::VolumeLayer(VolumeLayer&&) noexcept = default;
VolumeLayer& VolumeLayer::operator=(VolumeLayer&&) noexcept = default;

const std::vector<Vec3>& VolumeLayer::normals() const { return surface_->normals; }

double VolumeLayer::thicknessFor(std::span<const Vec3> displacement, double wantedMm3) const {
  TriangleMesh moved = surface_->mesh;
  for (std::size_t n = 0; n < moved.points.size(); ++n) moved.points[n] += displacement[n];
  const auto thickness = scaleForVolume(volumePolynomial(moved, surface_->normals), wantedMm3);
  if (thickness && std::abs(*thickness) <= MostMm) return *thickness;
  throw InvalidInput("the lung cannot be brought to " + std::to_string(wantedMm3 / 1000.0) +
                     " ml near its wall; ask for a smaller change of volume");
}

Vec3 VolumeLayer::at(const Vec3& p) const {
  const NearestTriangle::Hit hit = surface_->nearest.nearest(p);
  const auto& triangle = surface_->mesh.triangles[hit.triangle];
  const Vec3& a = surface_->mesh.points[triangle[0]];
  const Vec3& b = surface_->mesh.points[triangle[1]];
  const Vec3& c = surface_->mesh.points[triangle[2]];
  const Vec3 area = (b - a).cross(c - a);
  const double whole = area.squaredNorm();
  Vec3 normal = surface_->normals[triangle[0]];
  if (whole > 0.0) {
    const double first = area.dot((b - hit.point).cross(c - hit.point)) / whole;
    const double second = area.dot((c - hit.point).cross(a - hit.point)) / whole;
    normal = first * surface_->normals[triangle[0]] + second * surface_->normals[triangle[1]] +
             (1.0 - first - second) * surface_->normals[triangle[2]];
  }
  return std::exp(-(p - hit.point).norm() / DepthMm) * normal;
}

}  // namespace pneuma
