#include "lobes/contact_sampling.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numeric>
#include <string>

#include "core/error.h"
#include "core/parallel.h"
#include "geometry/nearest_triangle.h"
#include "lobes/welding.h"

namespace pneuma {
namespace {

constexpr double ContactMm = 5.0;
constexpr double FacingCos = -0.7;   ///< of the normals
constexpr double ParallelCos = 0.7;  ///< of the normal and the way to the neighbour
constexpr double TouchingMm = 1e-6;  ///< nearer than this the way has no direction
constexpr double SharedShare = 0.5;  ///< of the contact by distance that shared triangles take
constexpr std::size_t Candidates = 12;
constexpr std::size_t Chunk = 1024;

using Triangle = std::array<std::uint32_t, 3>;

/// Twice the area along the normal.
Vec3 crossOf(const TriangleMesh& mesh, const Triangle& t) {
  const Vec3& a = mesh.points[t[0]];
  return (mesh.points[t[1]] - a).cross(mesh.points[t[2]] - a);
}

Vec3 middleOf(const TriangleMesh& mesh, const Triangle& t) {
  return (mesh.points[t[0]] + mesh.points[t[1]] + mesh.points[t[2]]) / 3.0;
}

void add(FissureContact& contact, const Vec3& point, double areaMm2, double gapMm) {
  contact.points.push_back(point);
  contact.areasMm2.push_back(areaMm2);
  contact.gapMeanMm += areaMm2 * gapMm;  // a sum until all are there
  contact.areaMm2 += areaMm2;
  contact.gapLargestMm = std::max(contact.gapLargestMm, gapMm);
}

/// Triangles that both have, turned the other way.
FissureContact sharedTriangles(const TriangleMesh& below, const TriangleMesh& above) {
  constexpr RegionId Below = 1;
  constexpr RegionId Above = 2;
  const std::array<std::pair<RegionId, const TriangleMesh*>, 2> both = {
      {{Below, &below}, {Above, &above}}};
  const TriangleMesh mesh = contactOf(weld(both).complex, Below, Above);
  FissureContact contact;
  contact.shared = true;
  for (const Triangle& t : mesh.triangles) {
    add(contact, middleOf(mesh, t), crossOf(mesh, t).norm() / 2.0, 0.0);
  }
  return contact;
}

/// Triangles of one that face the other nearby, at the middle of the gap.
FissureContact facingTriangles(const TriangleMesh& below, const TriangleMesh& above) {
  const NearestTriangle nearest(above);
  std::vector<NearestTriangle::Hit> hits(below.triangles.size());
  parallelFor((hits.size() + Chunk - 1) / Chunk, [&](std::size_t chunk) {
    const std::size_t end = std::min(hits.size(), (chunk + 1) * Chunk);
    for (std::size_t t = chunk * Chunk; t < end; ++t) {
      hits[t] = nearest.nearest(middleOf(below, below.triangles[t]));
    }
  });
  FissureContact contact;
  for (std::size_t t = 0; t < hits.size(); ++t) {
    const Vec3 middle = middleOf(below, below.triangles[t]);
    const Vec3 way = hits[t].point - middle;
    const Vec3 cross = crossOf(below, below.triangles[t]);
    const Vec3 other = crossOf(above, above.triangles[hits[t].triangle]);
    if (way.norm() > ContactMm || cross.norm() == 0.0 || other.norm() == 0.0) continue;
    if (cross.dot(other) > FacingCos * cross.norm() * other.norm()) continue;
    const bool beside = std::abs(cross.dot(way)) < ParallelCos * cross.norm() * way.norm();
    if (beside && way.norm() > TouchingMm) continue;
    add(contact, middle + way / 2.0, cross.norm() / 2.0, way.norm());
  }
  return contact;
}

FissureContact withMean(FissureContact contact) {
  if (contact.areaMm2 > 0.0) contact.gapMeanMm /= contact.areaMm2;
  return contact;
}

void requireEnough(const FissureContact& contact, std::size_t n) {
  if (n <= contact.points.size()) return;
  throw InvalidInput("the lobes touch in " + std::to_string(contact.points.size()) +
                     " triangles only; " + std::to_string(n) + " points cannot be taken from them");
}

/// Squared distances from the nearest point that was taken.
class Apart {
 public:
  explicit Apart(const FissureContact& contact)
      : points_(contact.points),
        apart_(contact.points.size(), std::numeric_limits<double>::infinity()) {}

  void take(std::size_t i) {
    taken.push_back(points_[i]);
    for (std::size_t k = 0; k < apart_.size(); ++k) {
      apart_[k] = std::min(apart_[k], (points_[k] - points_[i]).squaredNorm());
    }
  }

  double operator[](std::size_t i) const { return apart_[i]; }

  std::size_t farthest() const {
    return static_cast<std::size_t>(std::ranges::max_element(apart_) - apart_.begin());
  }

  std::vector<Vec3> taken;

 private:
  const std::vector<Vec3>& points_;
  std::vector<double> apart_;
};

}  // namespace

std::vector<std::pair<Lobe, Lobe>> lobesBeside(Fissure fissure) {
  switch (fissure) {
    case Fissure::RightHorizontal:
      return {{Lobe::RightMiddle, Lobe::RightUpper}};
    case Fissure::LeftOblique:
      return {{Lobe::LeftLower, Lobe::LeftUpper}};
    case Fissure::RightOblique:
      break;
  }
  return {{Lobe::RightLower, Lobe::RightMiddle}, {Lobe::RightLower, Lobe::RightUpper}};
}

FissureContact contactBetween(const TriangleMesh& below, const TriangleMesh& above) {
  if (below.triangles.empty() || above.triangles.empty()) return {};
  FissureContact shared = sharedTriangles(below, above);
  FissureContact facing = facingTriangles(below, above);
  const bool most = shared.areaMm2 > SharedShare * facing.areaMm2;
  return withMean(std::move(most ? shared : facing));
}

std::vector<LobePair> pairsBeside(Fissure fissure, const std::map<Lobe, TriangleMesh>& lobes) {
  std::vector<LobePair> pairs;
  for (const auto& [below, above] : lobesBeside(fissure)) {
    if (!lobes.contains(below) || !lobes.contains(above)) return {};
    pairs.push_back({below, above, contactBetween(lobes.at(below), lobes.at(above))});
  }
  return pairs;
}

FissureContact joined(std::span<const LobePair> pairs) {
  FissureContact all;
  all.shared = !pairs.empty();
  for (const auto& [below, above, contact] : pairs) {
    all.points.insert(all.points.end(), contact.points.begin(), contact.points.end());
    all.areasMm2.insert(all.areasMm2.end(), contact.areasMm2.begin(), contact.areasMm2.end());
    all.areaMm2 += contact.areaMm2;
    all.gapMeanMm += contact.gapMeanMm * contact.areaMm2;
    all.gapLargestMm = std::max(all.gapLargestMm, contact.gapLargestMm);
    all.shared = all.shared && contact.shared;
  }
  return withMean(std::move(all));
}

FissureContact fissureContact(Fissure fissure, const std::map<Lobe, TriangleMesh>& lobes) {
  return joined(pairsBeside(fissure, lobes));
}

std::vector<Vec3> farthestPoints(const FissureContact& contact, std::size_t n) {
  requireEnough(contact, n);
  if (n == 0) return {};
  Vec3 middle = Vec3::Zero();
  for (std::size_t i = 0; i < contact.points.size(); ++i) {
    middle += contact.areasMm2[i] / contact.areaMm2 * contact.points[i];
  }
  const auto farther = [&](const Vec3& a, const Vec3& b) {
    return (a - middle).squaredNorm() < (b - middle).squaredNorm();
  };
  Apart apart(contact);
  apart.take(static_cast<std::size_t>(std::ranges::max_element(contact.points, farther) -
                                      contact.points.begin()));
  while (apart.taken.size() < n) apart.take(apart.farthest());
  return apart.taken;
}

std::vector<Vec3> spreadPoints(const FissureContact& contact, std::size_t n, Random& random) {
  requireEnough(contact, n);
  std::vector<double> areaUpTo(contact.areasMm2.size());
  std::partial_sum(contact.areasMm2.begin(), contact.areasMm2.end(), areaUpTo.begin());
  const auto draw = [&] {
    const double at = random.uniform() * areaUpTo.back();
    const auto found = std::ranges::upper_bound(areaUpTo, at);
    return std::min(static_cast<std::size_t>(found - areaUpTo.begin()), areaUpTo.size() - 1);
  };
  Apart apart(contact);
  while (apart.taken.size() < n) {
    std::size_t best = draw();
    for (std::size_t k = 1; k < Candidates && !apart.taken.empty(); ++k) {
      const std::size_t other = draw();
      if (apart[other] > apart[best]) best = other;
    }
    apart.take(apart[best] > 0.0 ? best : apart.farthest());
  }
  return apart.taken;
}

std::vector<Vec3> withNoise(std::span<const Vec3> points, double noiseMm, Random& random) {
  std::vector<Vec3> noisy(points.begin(), points.end());
  for (Vec3& p : noisy) {
    for (double& coordinate : p) coordinate += noiseMm * random.normal();
  }
  return noisy;
}

}  // namespace pneuma
