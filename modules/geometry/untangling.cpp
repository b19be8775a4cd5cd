#include "geometry/untangling.h"

#include <algorithm>
#include <unordered_set>
#include <vector>

#include "geometry/self_intersections.h"

namespace pneuma {
namespace {

constexpr int Rounds = 40;
constexpr int RoundsPerRing = 8;
/// More is no fold of a smooth surface; smoothing would eat a shape away.
constexpr std::size_t MostTriangles = 2000;

class Untangler {
 public:
  Untangler(TriangleMesh& mesh, const Progress& progress) : mesh_(mesh), progress_(progress) {}

  Untangled run() {
    Untangled result;
    SelfIntersecting found = selfIntersecting(mesh_, progress_);
    result.pairsBefore = result.pairsAfter = found.pairs;
    if (found.triangles.empty() || found.triangles.size() > MostTriangles) return result;
    findNeighbours();
    const std::vector<Vec3> before = mesh_.points;
    std::unordered_set<std::uint32_t> moved;
    for (int round = 0; round < Rounds && !found.triangles.empty(); ++round) {
      progress_.throwIfStopped();
      std::unordered_set<std::uint32_t> points;
      for (const std::uint32_t t : found.triangles) {
        points.insert(mesh_.triangles[t].begin(), mesh_.triangles[t].end());
      }
      for (int ring = 0; ring < round / RoundsPerRing; ++ring) grow(points);
      smooth(points);
      moved.insert(points.begin(), points.end());
      found = cutting(moved);
    }
    if (!found.triangles.empty()) {
      mesh_.points = before;
      return result;
    }
    result.pairsAfter = 0;
    result.movedPoints = moved.size();
    for (const std::uint32_t p : moved) {
      result.farthestMm = std::max(result.farthestMm, (mesh_.points[p] - before[p]).norm());
    }
    return result;
  }

 private:
  void findNeighbours() {
    neighbours_.resize(mesh_.points.size());
    for (const auto& [a, b, c] : mesh_.triangles) {
      neighbours_[a].push_back(b);
      neighbours_[b].push_back(c);
      neighbours_[c].push_back(a);
    }
  }

  void grow(std::unordered_set<std::uint32_t>& points) const {
    const std::vector<std::uint32_t> inner(points.begin(), points.end());
    for (const std::uint32_t p : inner) points.insert(neighbours_[p].begin(), neighbours_[p].end());
  }

  void smooth(const std::unordered_set<std::uint32_t>& points) {
    std::vector<std::pair<std::uint32_t, Vec3>> places;
    for (const std::uint32_t p : points) {
      Vec3 sum = Vec3::Zero();
      for (const std::uint32_t q : neighbours_[p]) sum += mesh_.points[q];
      places.emplace_back(p, sum / static_cast<double>(neighbours_[p].size()));
    }
    for (const auto& [p, place] : places) mesh_.points[p] = place;
  }

  /// Triangles that cut each other near points that were moved; elsewhere nothing changed.
  SelfIntersecting cutting(const std::unordered_set<std::uint32_t>& moved) const {
    std::vector<Box3> boxes;
    for (const std::uint32_t p : moved) {
      Box3 box(mesh_.points[p]);
      for (const std::uint32_t q : neighbours_[p]) box.extend(mesh_.points[q]);
      boxes.push_back(box);
    }
    Box3 all;
    for (const Box3& box : boxes) all.extend(box);
    TriangleMesh near{mesh_.points, {}};
    std::vector<std::uint32_t> triangleOf;
    for (std::uint32_t t = 0; t < mesh_.triangles.size(); ++t) {
      Box3 box;
      for (const std::uint32_t v : mesh_.triangles[t]) box.extend(mesh_.points[v]);
      if (!all.intersects(box) ||
          std::ranges::none_of(boxes, [&](const Box3& b) { return b.intersects(box); })) {
        continue;
      }
      near.triangles.push_back(mesh_.triangles[t]);
      triangleOf.push_back(t);
    }
    SelfIntersecting found = selfIntersecting(near, progress_);
    for (std::uint32_t& t : found.triangles) t = triangleOf[t];
    return found;
  }

  TriangleMesh& mesh_;
  const Progress& progress_;
  std::vector<std::vector<std::uint32_t>> neighbours_;
};

}  // namespace

Untangled untangle(TriangleMesh& mesh, const Progress& progress) {
  return Untangler(mesh, progress).run();
}

}  // namespace pneuma
