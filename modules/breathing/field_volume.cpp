#include "breathing/field_volume.h"

namespace pneuma {
namespace {

constexpr std::size_t Fields = 4;

/// Six times the volume of the tetrahedron with the origin.
double tetrahedron(const Vec3& a, const Vec3& b, const Vec3& c) { return a.dot(b.cross(c)); }

/// Calls visit(index, b, c) for b <= c.
template <class Visit>
void forPairs(const Visit& visit) {
  std::size_t index = 0;
  for (std::size_t b = 0; b < Fields; ++b) {
    for (std::size_t c = b; c < Fields; ++c) visit(index++, b, c);
  }
}

/// Calls visit(index, b, c, d) for b <= c <= d.
template <class Visit>
void forTriples(const Visit& visit) {
  std::size_t index = 0;
  for (std::size_t b = 0; b < Fields; ++b) {
    for (std::size_t c = b; c < Fields; ++c) {
      for (std::size_t d = c; d < Fields; ++d) visit(index++, b, c, d);
    }
  }
}

}  // namespace

FieldVolume::FieldVolume(const TriangleMesh& surface,
                         const std::array<std::vector<Vec3>, 4>& fields) {
  // About the middle, so that little is lost where the surface is far from the origin.
  const Vec3 middle = bounds(surface).center();
  for (const auto& [i, j, k] : surface.triangles) {
    const Vec3 p = surface.points[i] - middle;
    const Vec3 q = surface.points[j] - middle;
    const Vec3 r = surface.points[k] - middle;
    rest_ += tetrahedron(p, q, r) / 6.0;
    std::array<Vec3, Fields> u;
    std::array<Vec3, Fields> v;
    std::array<Vec3, Fields> w;
    for (std::size_t b = 0; b < Fields; ++b) {
      u[b] = fields[b][i];
      v[b] = fields[b][j];
      w[b] = fields[b][k];
      linear_[b] +=
          (tetrahedron(u[b], q, r) + tetrahedron(p, v[b], r) + tetrahedron(p, q, w[b])) / 6.0;
    }
    const auto second = [&](std::size_t b, std::size_t c) {
      return tetrahedron(u[b], v[c], r) + tetrahedron(u[b], q, w[c]) + tetrahedron(p, v[b], w[c]);
    };
    forPairs([&](std::size_t at, std::size_t b, std::size_t c) {
      quadratic_[at] += (b == c ? second(b, b) : second(b, c) + second(c, b)) / 6.0;
    });
    const auto third = [&](std::size_t b, std::size_t c, std::size_t d) {
      return tetrahedron(u[b], v[c], w[d]);
    };
    forTriples([&](std::size_t at, std::size_t b, std::size_t c, std::size_t d) {
      double sum = third(b, c, d);  // and every other order of the three
      if (b != c && c != d) {
        sum += third(b, d, c) + third(c, b, d) + third(c, d, b) + third(d, b, c) + third(d, c, b);
      } else if (b != c || c != d) {
        sum += third(c, d, b) + third(d, b, c);
      }
      cubic_[at] += sum / 6.0;
    });
  }
}

double FieldVolume::at(const std::array<double, 4>& weights) const {
  return along(weights).at(1.0);
}

VolumePolynomial FieldVolume::along(const std::array<double, 4>& weights) const {
  VolumePolynomial volume{{rest_, 0.0, 0.0, 0.0}};
  for (std::size_t b = 0; b < Fields; ++b) volume.a[1] += linear_[b] * weights[b];
  forPairs([&](std::size_t at, std::size_t b, std::size_t c) {
    volume.a[2] += quadratic_[at] * weights[b] * weights[c];
  });
  forTriples([&](std::size_t at, std::size_t b, std::size_t c, std::size_t d) {
    volume.a[3] += cubic_[at] * weights[b] * weights[c] * weights[d];
  });
  return volume;
}

}  // namespace pneuma
