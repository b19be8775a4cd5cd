#include "lobes/region_complex.h"

#include <limits>

namespace pneuma {
namespace {

constexpr std::uint32_t Nowhere = std::numeric_limits<std::uint32_t>::max();

/// Takes triangles over with the points they use.
class MeshPicker {
 public:
  explicit MeshPicker(const RegionComplex& complex)
      : complex_(complex), indexOf_(complex.points.size(), Nowhere) {}

  void add(std::array<std::uint32_t, 3> corners, bool turned) {
    if (turned) std::swap(corners[1], corners[2]);
    for (std::uint32_t& corner : corners) {
      if (indexOf_[corner] == Nowhere) {
        indexOf_[corner] = static_cast<std::uint32_t>(mesh.points.size());
        mesh.points.push_back(complex_.points[corner]);
      }
      corner = indexOf_[corner];
    }
    mesh.triangles.push_back(corners);
  }

  TriangleMesh mesh;

 private:
  const RegionComplex& complex_;
  std::vector<std::uint32_t> indexOf_;
};

/// Neumaier 1974: a sum whose rounding does not grow with the number of terms.
class CompensatedSum {
 public:
  void add(double value) {
    const double sum = sum_ + value;
    lost_ += std::abs(sum_) >= std::abs(value) ? (sum_ - sum) + value : (value - sum) + sum_;
    sum_ = sum;
  }

  double value() const { return sum_ + lost_; }

 private:
  double sum_ = 0.0;
  double lost_ = 0.0;
};

}  // namespace

RegionComplex complexOf(const TriangleMesh& mesh, RegionId region) {
  RegionComplex complex{mesh.points, {}};
  complex.facets.reserve(mesh.triangles.size());
  for (const auto& triangle : mesh.triangles) {
    complex.facets.push_back({triangle, region, OutsideRegion});
  }
  return complex;
}

RegionSurface surfaceOf(const RegionComplex& complex, RegionId region) {
  MeshPicker picker(complex);
  RegionSurface surface;
  for (std::uint32_t f = 0; f < complex.facets.size(); ++f) {
    const Facet& facet = complex.facets[f];
    if (!facet.borders(region)) continue;
    picker.add(facet.corners, facet.front == region);
    surface.facetOf.push_back(f);
  }
  surface.mesh = std::move(picker.mesh);
  return surface;
}

TriangleMesh contactOf(const RegionComplex& complex, RegionId behind,
                       std::span<const RegionId> fronts) {
  const auto isFront = [&](RegionId region) { return std::ranges::count(fronts, region) > 0; };
  MeshPicker picker(complex);
  for (const Facet& facet : complex.facets) {
    if (facet.behind == behind && isFront(facet.front)) picker.add(facet.corners, false);
    if (facet.front == behind && isFront(facet.behind)) picker.add(facet.corners, true);
  }
  return std::move(picker.mesh);
}

double volumeMm3(const RegionComplex& complex, RegionId region) {
  CompensatedSum six;
  const Vec3* origin = nullptr;
  for (const Facet& facet : complex.facets) {
    if (!facet.borders(region)) continue;
    if (origin == nullptr) origin = &complex.points[facet.corners[0]];
    const Vec3 a = complex.points[facet.corners[0]] - *origin;
    const Vec3 b = complex.points[facet.corners[1]] - *origin;
    const Vec3 c = complex.points[facet.corners[2]] - *origin;
    const double volume = a.dot(b.cross(c));
    six.add(facet.behind == region ? volume : -volume);
  }
  return six.value() / 6.0;
}

}  // namespace pneuma
