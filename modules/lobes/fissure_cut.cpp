#include "lobes/fissure_cut.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/parallel.h"
#include "geometry/planar_triangulation.h"
#include "lobes/subdivision.h"

namespace pneuma {
namespace {

constexpr double RootMm = 1e-9;
constexpr double NearestEnd = 1e-6;  ///< a new point keeps this share of its edge from the ends
constexpr int RootSteps = 60;
constexpr int UnpinchRounds = 20;
constexpr int ChordRounds = 6;
constexpr double FreeOfLoops = 0.7;  ///< spacings that the cap's points keep from its rim
constexpr std::size_t Chunk = 4096;

using Edge = std::array<std::uint32_t, 2>;

std::uint64_t keyOf(const Edge& edge) { return (std::uint64_t{edge[0]} << 32U) | edge[1]; }

Edge undirected(std::uint32_t a, std::uint32_t b) { return {std::min(a, b), std::max(a, b)}; }

class Cutter {
 public:
  Cutter(RegionComplex& complex, const HeightSurface& surface, const CutSettings& settings)
      : complex_(complex), surface_(surface), settings_(settings) {}

  Cut cut(const Progress& progress) {
    findHeights(progress);
    const RegionComplex before = complex_;
    for (int round = 0; round < UnpinchRounds; ++round) {
      progress.throwIfStopped();
      findSides();
      divide();
      label();
      const Loops loops = findLoops();
      if (loops.edges.empty()) {
        cut_.outcome = CutOutcome::DoesNotCross;
        return std::move(cut_);
      }
      if (loops.pinched.empty()) {
        cut_.outcome = close(loops) ? CutOutcome::Done : CutOutcome::Folds;
        return std::move(cut_);
      }
      // Points that the cut was snapped to; without that it passes beside them.
      for (const std::uint32_t v : loops.pinched) {
        if (v < height_.size()) unsnapped_[v] = 1;
      }
      complex_ = before;
    }
    cut_.outcome = CutOutcome::Pinched;
    return std::move(cut_);
  }

 private:
  struct Loops {
    std::vector<Edge> edges;  ///< as the part below has them
    std::vector<std::uint32_t> pinched;
  };

  void findHeights(const Progress& progress) {
    height_.assign(complex_.points.size(), std::numeric_limits<double>::quiet_NaN());
    unsnapped_.assign(complex_.points.size(), 0);
    std::vector<char> isOf(complex_.points.size(), 0);
    for (const Facet& facet : complex_.facets) {
      if (!facet.borders(settings_.region)) continue;
      for (const std::uint32_t v : facet.corners) isOf[v] = 1;
    }
    parallelFor((height_.size() + Chunk - 1) / Chunk, [&](std::size_t chunk) {
      progress.throwIfStopped();
      const std::size_t end = std::min(height_.size(), (chunk + 1) * Chunk);
      for (std::size_t v = chunk * Chunk; v < end; ++v) {
        if (isOf[v] == 0) continue;
        height_[v] =
            settings_.heights.empty() ? surface_.height(complex_.points[v]) : settings_.heights[v];
      }
    });
    cut_.lowestMm = std::numeric_limits<double>::infinity();
    cut_.highestMm = -cut_.lowestMm;
    for (const double h : height_) {
      if (std::isnan(h)) continue;
      cut_.lowestMm = std::min(cut_.lowestMm, h);
      cut_.highestMm = std::max(cut_.highestMm, h);
    }
  }

  std::int8_t ownSide(std::uint32_t v) const {
    const auto decided = settings_.sideOf.find(v);
    if (decided != settings_.sideOf.end()) return decided->second;
    // A height of exactly 0 that must not stay so counts as above.
    return height_[v] < 0.0 ? std::int8_t{-1} : std::int8_t{1};
  }

  bool mayBeOn(std::uint32_t v) const {
    return unsnapped_[v] == 0 && !settings_.sideOf.contains(v);
  }

  template <class F>
  void forEachFacet(F&& f) const {
    for (const Facet& facet : complex_.facets) {
      if (facet.borders(settings_.region)) f(facet.corners);
    }
  }

  /// -1 below, 1 above, 0 on the cut, for every point of the region.
  void findSides() {
    side_.assign(height_.size(), 0);
    for (std::uint32_t v = 0; v < height_.size(); ++v) {
      if (std::isnan(height_[v])) continue;
      side_[v] = height_[v] == 0.0 && mayBeOn(v) ? std::int8_t{0} : ownSide(v);
    }
    std::vector<std::uint32_t> near;
    forEachFacet([&](const std::array<std::uint32_t, 3>& t) {
      for (std::size_t e = 0; e < 3; ++e) {
        const std::uint32_t a = t[e];
        const std::uint32_t b = t[(e + 1) % 3];
        if (side_[a] * side_[b] >= 0) continue;
        const double share = height_[a] / (height_[a] - height_[b]);
        if (share < settings_.snap && mayBeOn(a)) near.push_back(a);
        if (1.0 - share < settings_.snap && mayBeOn(b)) near.push_back(b);
      }
    });
    for (const std::uint32_t v : near) side_[v] = 0;
    // A triangle must not lie in the cut as a whole.
    for (bool changed = true; changed;) {
      changed = false;
      forEachFacet([&](const std::array<std::uint32_t, 3>& t) {
        if (side_[t[0]] != 0 || side_[t[1]] != 0 || side_[t[2]] != 0) return;
        const std::uint32_t farthest =
            *std::max_element(t.begin(), t.end(), [&](std::uint32_t a, std::uint32_t b) {
              return std::abs(height_[a]) < std::abs(height_[b]);
            });
        side_[farthest] = ownSide(farthest);
        changed = true;
      });
    }
  }

  /// Where along an edge the height is zero, as a share.
  double rootOf(const Vec3& from, const Vec3& to, double low, double high) const {
    double a = 0.0;
    double b = 1.0;
    if (!(low * high < 0.0)) return std::abs(low) < std::abs(high) ? 0.1 : 0.9;  // a decided side
    for (int step = 0; step < RootSteps; ++step) {
      // Illinois; a bisection now and then so that it never creeps.
      const double t = step % 4 == 3 ? (a + b) / 2.0 : a + (b - a) * low / (low - high);
      const double h = surface_.height(from + t * (to - from));
      if (std::abs(h) < RootMm) return t;
      if ((h < 0.0) == (low < 0.0)) {
        a = t;
        low = h;
      } else {
        b = t;
        high = h;
      }
    }
    return (a + b) / 2.0;
  }

  void divide() {
    EdgePoints upon(complex_.points.size());
    forEachFacet([&](const std::array<std::uint32_t, 3>& t) {
      for (std::size_t e = 0; e < 3; ++e) {
        const std::uint32_t a = std::min(t[e], t[(e + 1) % 3]);
        const std::uint32_t b = std::max(t[e], t[(e + 1) % 3]);
        if (side_[a] * side_[b] >= 0 || upon.find(a, b) != nullptr) continue;
        const Vec3 from = complex_.points[a];
        const Vec3 to = complex_.points[b];
        const double share =
            std::clamp(rootOf(from, to, height_[a], height_[b]), NearestEnd, 1.0 - NearestEnd);
        upon.add(a, b, static_cast<std::uint32_t>(complex_.points.size()));
        complex_.points.push_back(from + share * (to - from));
      }
    });
    subdivide(complex_, upon, &cut_.parentOf);
    side_.resize(complex_.points.size(), 0);
  }

  void label() {
    for (Facet& facet : complex_.facets) {
      if (!facet.borders(settings_.region)) continue;
      int side = 0;
      for (const std::uint32_t v : facet.corners) {
        if (side_[v] != 0) side = side_[v];
      }
      RegionId& region = facet.behind == settings_.region ? facet.behind : facet.front;
      region = side < 0 ? Below : Above;
    }
    for (Facet& facet : complex_.facets) {
      for (RegionId* region : {&facet.behind, &facet.front}) {
        if (*region == Below) *region = settings_.below;
        if (*region == Above) *region = settings_.above;
      }
    }
  }

  /// Calls `f(edge)` for the edges of the complex whose ends both lie on the cut.
  template <class F>
  void forEachEdgeOnCut(F&& f) const {
    for (const Facet& facet : complex_.facets) {
      for (std::size_t e = 0; e < 3; ++e) {
        const Edge edge = undirected(facet.corners[e], facet.corners[(e + 1) % 3]);
        const auto isOn = [&](std::uint32_t v) { return side_[v] == 0 && isOfRegion(v); };
        if (isOn(edge[0]) && isOn(edge[1])) f(edge);
      }
    }
  }

  Loops findLoops() const {
    std::vector<Edge> half;  // of the part below, along the cut
    for (std::size_t f = 0; f < complex_.facets.size(); ++f) {
      const Facet& facet = complex_.facets[f];
      if (!facet.borders(settings_.below)) continue;
      const bool turned = facet.front == settings_.below;
      for (std::size_t e = 0; e < 3; ++e) {
        std::uint32_t a = facet.corners[e];
        std::uint32_t b = facet.corners[(e + 1) % 3];
        if (side_[a] != 0 || side_[b] != 0 || !isOfRegion(a) || !isOfRegion(b)) continue;
        if (turned) std::swap(a, b);
        half.push_back({a, b});
      }
    }
    std::unordered_map<std::uint64_t, int> there;
    for (const Edge& edge : half) ++there[keyOf(edge)];
    Loops loops;
    std::unordered_map<std::uint32_t, int> outgoing;
    for (const Edge& edge : half) {
      if (there.contains(keyOf({edge[1], edge[0]}))) continue;
      loops.edges.push_back(edge);
      if (++outgoing[edge[0]] == 2) loops.pinched.push_back(edge[0]);
    }
    return loops;
  }

  /// Points of the region before the cut, and new ones.
  bool isOfRegion(std::uint32_t v) const { return v >= height_.size() || !std::isnan(height_[v]); }

  /// A hexagonal grid over the loops.
  std::vector<WantedPoint> grid(const std::vector<Vec2>& rim) const {
    Eigen::AlignedBox2d box;
    for (const Vec2& p : rim) box.extend(p);
    std::vector<WantedPoint> points;
    for (const Vec2& p : settings_.capPoints) points.push_back({p, 0.0});
    const double step = settings_.capSpacingMm;
    const std::vector<WantedPoint> grid = hexagonalGrid(box, step, FreeOfLoops * step);
    points.insert(points.end(), grid.begin(), grid.end());
    return points;
  }

  /// Triangles inside the loops. Two points of the rim that an edge of the surface joins beside the
  /// loops must not be joined by the cap as well, or four triangles would share that edge: the cap
  /// gets a point in the middle there.
  std::optional<PlanarTriangulation> capOver(const std::vector<Vec2>& rim,
                                             const std::vector<Edge>& loops,
                                             const std::vector<std::uint32_t>& vertexOf) const {
    std::unordered_map<std::uint64_t, int> loopEdges;
    for (const Edge& edge : loops) ++loopEdges[keyOf(undirected(edge[0], edge[1]))];
    std::unordered_map<std::uint64_t, int> surfaceEdges;
    forEachEdgeOnCut([&](const Edge& edge) { ++surfaceEdges[keyOf(edge)]; });
    std::vector<WantedPoint> wanted = grid(rim);
    for (int round = 0; round < ChordRounds; ++round) {
      auto cap = triangulateInside(rim, loops, wanted);
      if (!cap) return cap;
      const std::size_t before = wanted.size();
      for (const auto& t : cap->triangles) {
        for (std::size_t e = 0; e < 3; ++e) {
          const auto [a, b] = undirected(t[e], t[(e + 1) % 3]);
          if (b >= rim.size() || loopEdges.contains(keyOf({a, b}))) continue;
          const Edge joined = undirected(vertexOf[a], vertexOf[b]);
          // Both triangles of the cap see it; one point is enough.
          if (surfaceEdges.contains(keyOf(joined)) && t[e] < t[(e + 1) % 3]) {
            wanted.push_back({(rim[a] + rim[b]) / 2.0, 0.0});
          }
        }
      }
      if (wanted.size() == before) return cap;
    }
    return std::nullopt;
  }

  /// Closes both parts. False if the loops have no inside, seen along the normal.
  bool close(const Loops& loops) {
    std::unordered_map<std::uint32_t, std::uint32_t> indexOf;
    std::vector<std::uint32_t> vertexOf;
    std::vector<Vec2> rim;
    std::vector<Edge> edges;
    for (const Edge& edge : loops.edges) {
      Edge planar{};
      for (std::size_t end = 0; end < 2; ++end) {
        const auto [found, isNew] =
            indexOf.try_emplace(edge[end], static_cast<std::uint32_t>(rim.size()));
        if (isNew) {
          vertexOf.push_back(edge[end]);
          rim.push_back(surface_.planar(complex_.points[edge[end]]));
        }
        planar[end] = found->second;
      }
      edges.push_back(planar);
    }
    const auto cap = capOver(rim, edges, vertexOf);
    if (!cap) return false;
    cut_.firstCapFacet = complex_.facets.size();
    for (std::size_t i = rim.size(); i < cap->points.size(); ++i) {
      vertexOf.push_back(static_cast<std::uint32_t>(complex_.points.size()));
      complex_.points.push_back(surface_.at(cap->points[i]));
    }
    std::unordered_map<std::uint64_t, int> there;
    for (const auto& t : cap->triangles) {
      for (std::size_t e = 0; e < 3; ++e) ++there[keyOf({t[e], t[(e + 1) % 3]})];
      complex_.facets.push_back(
          {{vertexOf[t[0]], vertexOf[t[1]], vertexOf[t[2]]}, settings_.below, settings_.above});
    }
    // The cap lies where the part below ends: it has every edge of the loops, the other way.
    return std::ranges::all_of(edges, [&](const Edge& edge) {
      return there.contains(keyOf({edge[1], edge[0]}));
    });
  }

  // While labels change, so that a part may have the region's own number.
  static constexpr RegionId Below = 254;
  static constexpr RegionId Above = 255;

  RegionComplex& complex_;
  const HeightSurface& surface_;
  const CutSettings& settings_;
  Cut cut_;
  std::vector<double> height_;   ///< of the points before the cut; no number off the region
  std::vector<char> unsnapped_;  ///< points that the cut must not run through
  std::vector<std::int8_t> side_;
};

}  // namespace

Cut cutRegion(RegionComplex& complex, const HeightSurface& surface, const CutSettings& settings,
              const Progress& progress) {
  return Cutter(complex, surface, settings).cut(progress);
}

}  // namespace pneuma
