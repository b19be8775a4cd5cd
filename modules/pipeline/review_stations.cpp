#include "pipeline/review_stations.h"

#include <algorithm>
#include <limits>

namespace pneuma {
namespace {

/// The middle of a triangle, and its area.
struct Place {
  Vec3 middle;
  double area;
};

double nearest(const Vec3& p, std::span<const Vec3> others) {
  double least = std::numeric_limits<double>::infinity();
  for (const Vec3& other : others) least = std::min(least, (p - other).norm());
  return least;
}

Vec3 centreOf(std::span<const Place> places) {
  Vec3 sum = Vec3::Zero();
  double area = 0.0;
  for (const Place& place : places) {
    sum += place.area * place.middle;
    area += place.area;
  }
  return area > 0.0 ? Vec3(sum / area) : places.front().middle;
}

}  // namespace

std::vector<Vec3> reviewStations(const TriangleMesh& patch, std::span<const Vec3> points,
                                 std::size_t count) {
  std::vector<Place> places;
  double whole = 0.0;
  for (const auto& [a, b, c] : patch.triangles) {
    const Vec3& p = patch.points[a];
    const Vec3& q = patch.points[b];
    const Vec3& r = patch.points[c];
    places.push_back({(p + q + r) / 3.0, 0.5 * (q - p).cross(r - p).norm()});
    whole += places.back().area;
  }
  std::ranges::sort(places, {}, [](const Place& place) { return place.middle.x(); });

  std::vector<Vec3> seen(points.begin(), points.end());
  std::vector<Vec3> stations;
  std::size_t from = 0;
  double area = 0.0;
  for (std::size_t band = 1; band <= count && from < places.size(); ++band) {
    std::size_t to = from;
    const double limit = whole * static_cast<double>(band) / static_cast<double>(count);
    while (to < places.size() && (area < limit || band == count)) area += places[to++].area;
    if (to == from) continue;
    const auto inBand = std::span(places).subspan(from, to - from);
    // The first one, where nothing was set, is in the middle of its band.
    const std::vector<Vec3> middle = {centreOf(inBand)};
    const auto unseen = [&](const Place& place) {
      return seen.empty() ? -nearest(place.middle, middle) : nearest(place.middle, seen);
    };
    stations.push_back(std::ranges::max_element(inBand, {}, unseen)->middle);
    seen.push_back(stations.back());
    from = to;
  }
  return stations;
}

}  // namespace pneuma
