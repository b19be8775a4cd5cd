#include "breathing/volume_layer.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <unordered_map>

#include <Eigen/LU>

#include "breathing/screened_laplacian.h"
#include "breathing/surface_points.h"
#include "breathing/volume_polynomial.h"
#include "core/error.h"
#include "core/point_hash.h"
#include "geometry/nearest_triangle.h"

namespace pneuma {
namespace {

constexpr double DepthMm = 15.0;
constexpr double SmoothMm = 10.0;
constexpr double DirectionsSolvedTo = 1e-5;
constexpr double NearWallMm = 1e-6;
constexpr double LeastStretch = 0.1;
constexpr double MostMm = 10.0;  // of a; its slope in depth is a / 15 mm

/// Normals that change over SmoothMm whatever the triangles' size: N of (M + l^2 L) N = M N0.
std::vector<Vec3> smoothedNormals(const TriangleMesh& surface) {
  std::vector<Vec3> normals = pointNormals(surface);
  const std::vector<double> areas = pointAreas(surface);
  const PointMatrix matrix = screenedLaplacian(surface, areas, {}, SmoothMm);
  std::vector<double> wanted(areas.size());
  for (int axis = 0; axis < 3; ++axis) {
    for (std::size_t n = 0; n < areas.size(); ++n) wanted[n] = areas[n] * normals[n][axis];
    const std::vector<double> solved = solve(matrix, wanted, {DirectionsSolvedTo});
    for (std::size_t n = 0; n < areas.size(); ++n) normals[n][axis] = solved[n];
  }
  for (Vec3& normal : normals) {
    if (!normal.isZero(0.0)) normal.normalize();
  }
  return normals;
}

/// The gradient of the normals along the surface at each point, mean of the triangles around it by
/// their area.
std::vector<Eigen::Matrix3d> bendsOf(const TriangleMesh& surface,
                                     const std::vector<Vec3>& normals) {
  std::vector<Eigen::Matrix3d> bends(normals.size(), Eigen::Matrix3d::Zero());
  std::vector<double> areas(normals.size(), 0.0);
  for (const auto& triangle : surface.triangles) {
    const Vec3& a = surface.points[triangle[0]];
    const Vec3 area = (surface.points[triangle[1]] - a).cross(surface.points[triangle[2]] - a);
    const double whole = area.squaredNorm();
    if (!(whole > 0.0)) continue;
    Eigen::Matrix3d bend = Eigen::Matrix3d::Zero();
    for (std::size_t corner = 0; corner < 3; ++corner) {
      const Vec3 opposite =
          surface.points[triangle[(corner + 2) % 3]] - surface.points[triangle[(corner + 1) % 3]];
      bend += normals[triangle[corner]] * (area.cross(opposite) / whole).transpose();
    }
    for (const std::uint32_t n : triangle) {
      bends[n] += std::sqrt(whole) * bend;
      areas[n] += std::sqrt(whole);
    }
  }
  for (std::size_t n = 0; n < bends.size(); ++n) {
    if (areas[n] > 0.0) bends[n] /= areas[n];
  }
  return bends;
}

}  // namespace

struct VolumeLayer::Surface {
  TriangleMesh mesh;
  std::vector<Vec3> normals;
  std::vector<Eigen::Matrix3d> bends;  ///< what the normals change by along the surface
  NearestTriangle nearest;
  std::unordered_map<Vec3, std::uint32_t, PointHash> own;  ///< its points, which need no search

  explicit Surface(const TriangleMesh& surface)
      : mesh(surface),
        normals(smoothedNormals(surface)),
        bends(bendsOf(surface, normals)),
        nearest(mesh) {
    own.reserve(mesh.points.size());
    for (std::size_t n = 0; n < mesh.points.size(); ++n) {
      own.try_emplace(mesh.points[n], static_cast<std::uint32_t>(n));
    }
  }

  /// The nearest place of the surface: the point and what its triangle's corners weigh there.
  struct Foot {
    Vec3 point;
    std::array<std::uint32_t, 3> corners;
    Vec3 weights;
  };

  Foot footOf(const Vec3& p) const;
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

VolumeLayer::Surface::Foot VolumeLayer::Surface::footOf(const Vec3& p) const {
  if (const auto at = own.find(p); at != own.end()) {
    return {p, {at->second, at->second, at->second}, Vec3::UnitX()};
  }
  const NearestTriangle::Hit hit = nearest.nearest(p);
  Foot foot{hit.point, mesh.triangles[hit.triangle], Vec3::UnitX()};
  const Vec3& a = mesh.points[foot.corners[0]];
  const Vec3& b = mesh.points[foot.corners[1]];
  const Vec3& c = mesh.points[foot.corners[2]];
  const Vec3 area = (b - a).cross(c - a);
  const double whole = area.squaredNorm();
  if (whole > 0.0) {
    const double first = area.dot((b - hit.point).cross(c - hit.point)) / whole;
    const double second = area.dot((c - hit.point).cross(a - hit.point)) / whole;
    foot.weights = {first, second, 1.0 - first - second};
  }
  return foot;
}

Vec3 VolumeLayer::at(const Vec3& p) const {
  const Surface::Foot foot = surface_->footOf(p);
  Vec3 normal = Vec3::Zero();
  for (Eigen::Index n = 0; n < 3; ++n) {
    normal += foot.weights[n] * surface_->normals[foot.corners[static_cast<std::size_t>(n)]];
  }
  return std::exp(-(p - foot.point).norm() / DepthMm) * normal;
}

FieldAt VolumeLayer::withGradientAt(const Vec3& p) const {
  const Surface::Foot foot = surface_->footOf(p);
  Vec3 normal = Vec3::Zero();
  Eigen::Matrix3d bend = Eigen::Matrix3d::Zero();
  for (Eigen::Index n = 0; n < 3; ++n) {
    const std::uint32_t corner = foot.corners[static_cast<std::size_t>(n)];
    normal += foot.weights[n] * surface_->normals[corner];
    bend += foot.weights[n] * surface_->bends[corner];
  }
  const double depth = (p - foot.point).norm();
  const double share = std::exp(-depth / DepthMm);
  const Vec3 inwards = depth > NearWallMm ? Vec3((p - foot.point) / depth) : Vec3(-normal);
  const Eigen::Matrix3d along = Eigen::Matrix3d::Identity() - inwards * inwards.transpose();
  const double below = inwards.dot(normal) < 0.0 ? depth : -depth;
  const Eigen::Matrix3d stretch = Eigen::Matrix3d::Identity() - below * bend;
  // Deeper than the wall is bent, several places of it are nearest.
  const bool focused = stretch.determinant() < LeastStretch;
  const Eigen::Matrix3d change =
      focused ? Eigen::Matrix3d(bend * along) : Eigen::Matrix3d(bend * stretch.inverse() * along);
  // Just outside of a wall that was drawn anew the lung goes on as it does just inside.
  const Vec3 deeper = below >= 0.0 ? inwards : Vec3(-inwards);
  return {share * normal, share * (change - normal * deeper.transpose() / DepthMm)};
}

}  // namespace pneuma
