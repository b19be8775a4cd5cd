#include "geometry/surface_voxels.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <string>

#include "core/error.h"
#include "core/parallel.h"

namespace pneuma {
namespace {

/// Rows pass beside the voxels' centres, so that none runs through a point or along an edge of a
/// surface that was made on the same voxels.
constexpr double RowShiftJ = 0.00012340917;
constexpr double RowShiftK = 0.00017724539;
constexpr double Rounding = 1e-9;  ///< of a crossing in a voxel's centre, voxels

bool before(const Vec3& a, const Vec3& b) {
  return std::lexicographical_compare(a.data(), a.data() + 3, b.data(), b.data() + 3);
}

/// A triangle in voxel coordinates. Its corners are put in an order of their own, so that the same
/// triangle of a neighbour, which turns the other way, gives the same crossings to the last bit.
struct Crossed {
  std::array<Vec3, 3> corners;

  explicit Crossed(const std::array<Vec3, 3>& unordered) : corners(unordered) {
    std::ranges::sort(corners, before);
  }

  /// Twice the area of (a, b, p) seen along the rows, the same but for its sign for (b, a, p).
  static double area(const Vec3& a, const Vec3& b, double j, double k) {
    return (b.y() - a.y()) * (k - a.z()) - (b.z() - a.z()) * (j - a.y());
  }

  /// Where row (j, k) passes through, along i; false if it does not.
  bool crossing(double j, double k, double& i) const {
    // Each edge runs from its lesser corner to the greater one, for both triangles beside it.
    const double ab = area(corners[0], corners[1], j, k);
    const double bc = area(corners[1], corners[2], j, k);
    const double ac = area(corners[0], corners[2], j, k);
    const bool inside = (ab >= 0.0) == (bc >= 0.0) && (ab >= 0.0) != (ac >= 0.0);
    if (!inside) return false;
    const double all = ab + bc - ac;
    if (all == 0.0) return false;
    i = (bc * corners[0].x() - ac * corners[1].x() + ab * corners[2].x()) / all;
    return true;
  }
};

}  // namespace

std::vector<std::uint8_t> voxelsInside(const TriangleMesh& surface, const ImageGeometry& geometry,
                                       const Progress& progress) {
  std::vector<std::uint8_t> inside(geometry.voxelCount(), 0);
  const Mat3 toVoxel = geometry.steps().inverse();
  std::vector<Vec3> points;
  points.reserve(surface.points.size());
  for (const Vec3& p : surface.points) points.emplace_back(toVoxel * (p - geometry.origin));

  const auto slices = static_cast<std::size_t>(geometry.size[2]);
  std::vector<std::vector<std::uint32_t>> ofSlice(slices);
  for (std::uint32_t t = 0; t < surface.triangles.size(); ++t) {
    const auto& [a, b, c] = surface.triangles[t];
    const auto [low, high] = std::minmax({points[a].z(), points[b].z(), points[c].z()});
    const double last = std::min(std::floor(high - RowShiftK), static_cast<double>(slices) - 1.0);
    for (double k = std::max(std::ceil(low - RowShiftK), 0.0); k <= last; ++k) {
      ofSlice[static_cast<std::size_t>(k)].push_back(t);
    }
  }
  parallelFor(slices, [&](std::size_t k) {
    progress.throwIfStopped();
    std::vector<std::vector<double>> ofRow(static_cast<std::size_t>(geometry.size[1]));
    const double z = static_cast<double>(k) + RowShiftK;
    for (const std::uint32_t t : ofSlice[k]) {
      const auto& [a, b, c] = surface.triangles[t];
      const Crossed triangle({points[a], points[b], points[c]});
      const auto [low, high] = std::minmax({points[a].y(), points[b].y(), points[c].y()});
      const double last = std::min(std::floor(high - RowShiftJ), geometry.size[1] - 1.0);
      for (double j = std::max(std::ceil(low - RowShiftJ), 0.0); j <= last; ++j) {
        double i = 0.0;
        if (triangle.crossing(j + RowShiftJ, z, i)) ofRow[static_cast<std::size_t>(j)].push_back(i);
      }
    }
    for (std::size_t j = 0; j < ofRow.size(); ++j) {
      std::vector<double>& crossings = ofRow[j];
      std::ranges::sort(crossings);
      const auto row = inside.begin() + static_cast<std::ptrdiff_t>(geometry.index(
                                            0, static_cast<int>(j), static_cast<int>(k)));
      const auto voxel = [&](double i) {
        return static_cast<std::ptrdiff_t>(
            std::clamp(std::ceil(i - Rounding), 0.0, geometry.size[0] + 0.0));
      };
      for (std::size_t n = 0; n + 1 < crossings.size(); n += 2) {
        std::fill(row + voxel(crossings[n]), row + voxel(crossings[n + 1]), std::uint8_t{1});
      }
    }
  });
  return inside;
}

ImageGeometry geometryAround(const Box3& box, double spacingMm, int marginVoxels,
                             std::size_t mostVoxels) {
  ImageGeometry geometry;
  geometry.spacing = Vec3::Constant(spacingMm);
  geometry.origin = box.min() - Vec3::Constant(marginVoxels * spacingMm);
  double count = 1.0;
  std::array<double, 3> size{};
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const auto a = static_cast<Eigen::Index>(axis);
    size[axis] = std::ceil(box.sizes()[a] / spacingMm) + 2.0 * marginVoxels + 1.0;
    count *= size[axis];
  }
  if (!(count <= static_cast<double>(mostVoxels))) {
    throw InvalidInput("a surface " + std::to_string(std::lround(box.sizes().maxCoeff())) +
                       " mm large is no lung's; check its unit");
  }
  for (std::size_t axis = 0; axis < 3; ++axis) geometry.size[axis] = static_cast<int>(size[axis]);
  return geometry;
}

}  // namespace pneuma
