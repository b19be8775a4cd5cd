#include "breathing/surface_proxy.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <span>

#include "breathing/surface_points.h"
#include "core/parallel.h"

namespace pneuma {
namespace {

constexpr std::uint32_t None = std::numeric_limits<std::uint32_t>::max();
constexpr double Packing = 0.7;  // points times distance^2 by area, thrown until none has room
constexpr std::size_t Block = 4096;

template <class Body>
void inBlocks(std::size_t count, const Body& body) {
  parallelFor((count + Block - 1) / Block, [&](std::size_t block) {
    for (std::size_t n = block * Block; n < std::min(count, (block + 1) * Block); ++n) body(n);
  });
}

/// Points of a surface that are at least `distance` from each other, or on different faces of it:
/// where two sheets nearly touch each has its own.
class SpreadPoints {
 public:
  SpreadPoints(const TriangleMesh& surface, double distance)
      : points_(surface.points),
        normals_(pointNormals(surface)),
        distance_(distance),
        low_(bounds(surface).min()),
        cells_((bounds(surface).sizes() / distance).array().floor().cast<int>() + 1),
        first_(static_cast<std::size_t>(cells_.x()) * cells_.y() * cells_.z(), None) {
    for (std::uint32_t n = 0; n < points_.size(); ++n) {
      if (nearest(n) != None) continue;
      std::uint32_t& cell = first_[cellAt(placeOf(points_[n]))];
      next_.push_back(cell);
      cell = static_cast<std::uint32_t>(chosen.size());
      chosen.push_back(n);
    }
  }

  /// The chosen one within `distance` that is nearest to a point, on its face of the surface.
  std::uint32_t nearest(std::uint32_t n) const {
    const Eigen::Array3i middle = placeOf(points_[n]);
    const Eigen::Array3i from = (middle - 1).max(0);
    const Eigen::Array3i to = (middle + 1).min(cells_ - 1);
    std::uint32_t best = None;
    double least = distance_ * distance_;
    for (int z = from.z(); z <= to.z(); ++z) {
      for (int y = from.y(); y <= to.y(); ++y) {
        for (int x = from.x(); x <= to.x(); ++x) {
          for (std::uint32_t at = first_[cellAt({x, y, z})]; at != None; at = next_[at]) {
            const double squared = (points_[chosen[at]] - points_[n]).squaredNorm();
            if (squared < least && normals_[chosen[at]].dot(normals_[n]) >= 0.0) {
              least = squared;
              best = at;
            }
          }
        }
      }
    }
    return best;
  }

  std::vector<std::uint32_t> chosen;

 private:
  Eigen::Array3i placeOf(const Vec3& p) const {
    const Eigen::Array3i place = ((p - low_) / distance_).array().floor().cast<int>();
    return place.max(0).min(cells_ - 1);
  }

  std::size_t cellAt(const Eigen::Array3i& place) const {
    return (static_cast<std::size_t>(place.z()) * cells_.y() + place.y()) * cells_.x() + place.x();
  }

  const std::vector<Vec3>& points_;
  std::vector<Vec3> normals_;
  double distance_;
  Vec3 low_;
  Eigen::Array3i cells_;
  std::vector<std::uint32_t> first_;  // chosen point of each cell
  std::vector<std::uint32_t> next_;   // after each chosen point in its cell
};

/// The parts made connected: what does not hang together with the chosen point of its part goes to
/// a part that it touches.
void connect(std::vector<std::uint32_t>& partOf, const std::vector<std::uint32_t>& chosen,
             const PointMatrix& edges) {
  std::vector<char> reached(partOf.size(), 0);
  std::vector<std::uint32_t> row = chosen;
  for (const std::uint32_t n : chosen) reached[n] = 1;
  const auto walk = [&](bool overBorders) {
    for (std::size_t next = 0; next < row.size(); ++next) {
      const std::uint32_t n = row[next];
      for (std::size_t at = edges.first[n]; at < edges.first[n + 1]; ++at) {
        const std::uint32_t other = edges.column[at];
        if (reached[other] != 0 || (!overBorders && partOf[other] != partOf[n])) continue;
        partOf[other] = partOf[n];
        reached[other] = 1;
        row.push_back(other);
      }
    }
  };
  walk(false);
  walk(true);
}

/// Where three parts meet at a triangle they become a triangle; each once.
std::vector<std::array<std::uint32_t, 3>> meetings(const TriangleMesh& surface,
                                                   const std::vector<std::uint32_t>& partOf) {
  std::vector<std::array<std::uint32_t, 3>> triangles;
  for (const auto& [i, j, k] : surface.triangles) {
    std::array<std::uint32_t, 3> parts = {partOf[i], partOf[j], partOf[k]};
    if (parts[0] == parts[1] || parts[1] == parts[2] || parts[2] == parts[0]) continue;
    std::ranges::rotate(parts, std::ranges::min_element(parts));
    triangles.push_back(parts);
  }
  std::ranges::sort(triangles);
  const auto again = std::ranges::unique(triangles);
  triangles.erase(again.begin(), again.end());
  return triangles;
}

/// Which of many things name each of some points as one of their three corners.
class Groups {
 public:
  template <class Things, class Corners>
  Groups(std::size_t points, const Things& things, const Corners& corners) : first_(points + 1, 0) {
    for (const auto& thing : things) {
      for (const std::uint32_t corner : corners(thing)) ++first_[corner + 1];
    }
    for (std::size_t n = 0; n < points; ++n) first_[n + 1] += first_[n];
    members_.resize(first_.back());
    std::vector<std::size_t> next(first_.begin(), first_.end() - 1);
    std::uint32_t index = 0;
    for (const auto& thing : things) {
      for (const std::uint32_t corner : corners(thing)) members_[next[corner]++] = index;
      ++index;
    }
  }

  std::span<const std::uint32_t> of(std::size_t point) const {
    return {members_.data() + first_[point], first_[point + 1] - first_[point]};
  }

 private:
  std::vector<std::size_t> first_;
  std::vector<std::uint32_t> members_;
};

/// A point of a triangle near `p`: that of its plane, brought within it.
SurfaceProxy::Place placeWithin(const TriangleMesh& mesh, const std::array<std::uint32_t, 3>& of,
                                const Vec3& p) {
  const Vec3 b = mesh.points[of[1]] - mesh.points[of[0]];
  const Vec3 c = mesh.points[of[2]] - mesh.points[of[0]];
  const Vec3 to = p - mesh.points[of[0]];
  const Vec3 area = b.cross(c);
  const double whole = area.squaredNorm();
  if (!(whole > 0.0)) return {of, {1.0, 0.0, 0.0}};
  const double second = area.dot(to.cross(c)) / whole;
  const double third = area.dot(b.cross(to)) / whole;
  SurfaceProxy::Place place{of, {1.0 - second - third, second, third}};
  double sum = 0.0;
  for (double& share : place.share) sum += share = std::max(0.0, share);
  for (double& share : place.share) share /= sum;
  return place;
}

double squaredDistance(const TriangleMesh& mesh, const SurfaceProxy::Place& place, const Vec3& p) {
  Vec3 there = Vec3::Zero();
  for (std::size_t k = 0; k < 3; ++k) there += place.share[k] * mesh.points[place.corner[k]];
  return (there - p).squaredNorm();
}

}  // namespace

std::vector<double> SurfaceProxy::atFinePoints(const std::vector<double>& coarse) const {
  std::vector<double> fine(places.size());
  inBlocks(fine.size(), [&](std::size_t n) {
    const auto& [corner, share] = places[n];
    fine[n] =
        share[0] * coarse[corner[0]] + share[1] * coarse[corner[1]] + share[2] * coarse[corner[2]];
  });
  return fine;
}

std::vector<double> SurfaceProxy::gathered(const std::vector<double>& fine) const {
  std::vector<double> coarse(mesh.points.size(), 0.0);
  for (std::size_t n = 0; n < fine.size(); ++n) {
    for (std::size_t k = 0; k < 3; ++k) coarse[places[n].corner[k]] += places[n].share[k] * fine[n];
  }
  return coarse;
}

PointMatrix SurfaceProxy::condensed(const PointMatrix& fine) const {
  struct Entry {
    std::uint32_t column;
    double value;
  };

  const Groups near(mesh.points.size(), places, [](const Place& place) { return place.corner; });
  std::vector<std::vector<Entry>> rows(mesh.points.size());
  parallelFor((rows.size() + Block - 1) / Block, [&](std::size_t block) {
    std::vector<double> sum(rows.size(), 0.0);  // of the row at hand
    std::vector<char> named(rows.size(), 0);
    std::vector<std::uint32_t> columns;
    const auto add = [&](const Place& place, double value) {
      for (std::size_t k = 0; k < 3; ++k) {
        const std::uint32_t column = place.corner[k];
        if (named[column] == 0) columns.push_back(column);
        named[column] = 1;
        sum[column] += value * place.share[k];
      }
    };
    for (std::size_t row = block * Block; row < std::min(rows.size(), (block + 1) * Block); ++row) {
      std::uint32_t last = None;
      for (const std::uint32_t n : near.of(row)) {
        if (n == last) continue;  // a place of one corner names it three times
        last = n;
        double share = 0.0;
        for (std::size_t k = 0; k < 3; ++k) {
          if (places[n].corner[k] == row) share += places[n].share[k];
        }
        if (share == 0.0) continue;
        add(places[n], share * fine.diagonal[n]);
        for (std::size_t at = fine.first[n]; at < fine.first[n + 1]; ++at) {
          add(places[fine.column[at]], share * fine.value[at]);
        }
      }
      std::ranges::sort(columns);
      for (const std::uint32_t column : columns) {
        rows[row].push_back({column, sum[column]});
        sum[column] = 0.0;
        named[column] = 0;
      }
      columns.clear();
    }
  });
  PointMatrix coarse;
  coarse.first.push_back(0);
  for (std::size_t row = 0; row < rows.size(); ++row) {
    double diagonal = 0.0;
    for (const Entry& entry : rows[row]) {
      if (entry.column == row) {
        diagonal = entry.value;
      } else {
        coarse.column.push_back(entry.column);
        coarse.value.push_back(entry.value);
      }
    }
    coarse.diagonal.push_back(diagonal > 0.0 ? diagonal : 1.0);
    coarse.first.push_back(coarse.column.size());
  }
  return coarse;
}

SurfaceProxy surfaceProxy(const TriangleMesh& surface, const PointMatrix& edges,
                          std::size_t points) {
  const double distance = std::sqrt(Packing * areaMm2(surface) / static_cast<double>(points));
  const SpreadPoints spread(surface, distance);
  std::vector<std::uint32_t> partOf(surface.points.size());
  inBlocks(partOf.size(),
           [&](std::size_t n) { partOf[n] = spread.nearest(static_cast<std::uint32_t>(n)); });
  connect(partOf, spread.chosen, edges);
  SurfaceProxy proxy;
  for (const std::uint32_t n : spread.chosen) proxy.mesh.points.push_back(surface.points[n]);
  proxy.mesh.triangles = meetings(surface, partOf);
  const Groups around(proxy.mesh.points.size(), proxy.mesh.triangles,
                      [](const auto& triangle) { return triangle; });
  proxy.places.resize(surface.points.size());
  inBlocks(proxy.places.size(), [&](std::size_t n) {
    const std::uint32_t part = partOf[n];
    SurfaceProxy::Place place{{part, part, part}, {1.0, 0.0, 0.0}};
    double least = squaredDistance(proxy.mesh, place, surface.points[n]);
    for (const std::uint32_t triangle : around.of(part)) {
      const SurfaceProxy::Place there =
          placeWithin(proxy.mesh, proxy.mesh.triangles[triangle], surface.points[n]);
      const double squared = squaredDistance(proxy.mesh, there, surface.points[n]);
      if (squared >= least) continue;
      least = squared;
      place = there;
    }
    proxy.places[n] = place;
  });
  return proxy;
}

}  // namespace pneuma
