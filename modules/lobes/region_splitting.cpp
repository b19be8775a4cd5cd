#include "lobes/region_splitting.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "core/disjoint_sets.h"
#include "core/error.h"
#include "geometry/self_intersections.h"
#include "lobes/fissure_cut.h"
#include "lobes/subdivision.h"

namespace pneuma {
namespace {

/// How near the cut runs past points, round by round: rather good triangles first.
constexpr std::array<double, 7> Snaps = {0.1, 0.1, 0.03, 0.0, 0.0, 0.0, 0.0};
constexpr int MostJoins = 4;
constexpr double NearMm = 6.0;  ///< from the fissure, where new triangles may meet others

std::string mm(double value) {
  std::string text = std::to_string(std::lround(10.0 * value));
  const bool minus = text.front() == '-';
  if (minus) text.erase(0, 1);
  if (text.size() < 2) text.insert(0, "0");
  text.insert(text.size() - 1, ".");
  return (minus ? "-" : "") + text + " mm";
}

/// The pieces of a region: points by the piece they are in.
class Pieces {
 public:
  Pieces(const RegionComplex& complex, RegionId region)
      : complex_(complex), region_(region), sets_(complex.points.size()) {
    for (const Facet& facet : complex.facets) {
      if (!facet.borders(region)) continue;
      sets_.join(facet.corners[0], facet.corners[1]);
      sets_.join(facet.corners[0], facet.corners[2]);
    }
    facets_.assign(complex.points.size(), 0);
    for (const Facet& facet : complex.facets) {
      if (facet.borders(region)) ++facets_[sets_.find(facet.corners[0])];
    }
    for (std::uint32_t v = 0; v < facets_.size(); ++v) {
      if (facets_[v] == 0) continue;
      ++count_;
      if (facets_[v] > facets_[largest_] || facets_[largest_] == 0) largest_ = v;
    }
  }

  std::size_t count() const { return count_; }

  /// Calls `f(point)` for the corners of every facet that is not in the largest piece.
  template <class F>
  void forEachStray(F&& f) {
    for (const Facet& facet : complex_.facets) {
      if (!facet.borders(region_) || sets_.find(facet.corners[0]) == largest_) continue;
      for (const std::uint32_t v : facet.corners) f(v);
    }
  }

  double strayMm3() {
    double six = 0.0;
    for (const Facet& facet : complex_.facets) {
      if (!facet.borders(region_) || sets_.find(facet.corners[0]) == largest_) continue;
      const Vec3& origin = complex_.points[sets_.find(facet.corners[0])];
      const Vec3 a = complex_.points[facet.corners[0]] - origin;
      const Vec3 b = complex_.points[facet.corners[1]] - origin;
      const Vec3 c = complex_.points[facet.corners[2]] - origin;
      six += (facet.behind == region_ ? 1.0 : -1.0) * a.dot(b.cross(c));
    }
    return six / 6.0;
  }

 private:
  const RegionComplex& complex_;
  RegionId region_;
  DisjointSets sets_;
  std::vector<std::size_t> facets_;  ///< of the piece that a point stands for
  std::size_t count_ = 0;
  std::uint32_t largest_ = 0;
};

class Splitter {
 public:
  Splitter(const RegionComplex& complex, const HeightSurface& fissure, const SplitRegion& settings,
           const std::string& what)
      : base_(complex),
        fissure_(fissure),
        what_(what),
        pieces_(pieceCount(complex, settings.region)) {
    cut_.region = settings.region;
    cut_.below = settings.below;
    cut_.above = settings.above;
    cut_.capSpacingMm = settings.capSpacingMm;
  }

  RegionComplex split(SplitReport& report, const Progress& progress) {
    for (std::size_t round = 0; round < Snaps.size(); ++round) {
      report.rounds = static_cast<int>(round) + 1;
      progress.report(static_cast<double>(round) / static_cast<double>(Snaps.size()));
      cut_.snap = Snaps[round];
      RegionComplex work;
      const Cut cut = cutInPieces(work, report, progress);
      report.lowestMm = cut.lowestMm;
      report.highestMm = cut.highestMm;
      if (cut.outcome == CutOutcome::Pinched || cut.outcome == CutOutcome::Folds) {
        last_ = cut.outcome;
        continue;
      }
      const std::vector<std::uint32_t> meeting = intersecting(work, progress);
      if (meeting.empty()) {
        for (std::size_t f = cut.firstCapFacet; f < work.facets.size(); ++f) {
          report.contactMm2 += areaOf(work, work.facets[f]);
        }
        return work;
      }
      last_ = CutOutcome::Done;
      refine(work, cut, meeting);
    }
    throw InvalidInput(
        "the " + what_ +
        (last_ == CutOutcome::Folds
             ? " folds over itself, seen along its best plane; take points away where it bends "
               "back"
             : " could not be cut through the lung without triangles that meet each other; move "
               "the points near the lung's edge a little, or repair the lung's surface"));
  }

 private:
  /// Cuts until both parts are in as many pieces as the region was.
  Cut cutInPieces(RegionComplex& work, SplitReport& report, const Progress& progress) {
    for (int join = 0;; ++join) {
      work = base_;
      Cut cut = cutRegion(work, fissure_, cut_, progress);
      if (cut.outcome == CutOutcome::DoesNotCross) refuseMiss(cut);
      if (cut.outcome != CutOutcome::Done || join == MostJoins) return cut;
      Pieces below(work, cut_.below);
      Pieces above(work, cut_.above);
      if (below.count() <= pieces_ && above.count() <= pieces_) return cut;
      for (auto [part, side] :
           {std::pair{&below, std::int8_t{1}}, std::pair{&above, std::int8_t{-1}}}) {
        if (part->count() <= pieces_) continue;
        report.piecesJoined += part->count() - 1;
        report.joinedMm3 += part->strayMm3();
        part->forEachStray([&, side = side](std::uint32_t v) {
          if (v < base_.points.size()) cut_.sideOf[v] = side;
        });
      }
    }
  }

  [[noreturn]] void refuseMiss(const Cut& cut) const {
    const bool touches = cut.lowestMm <= 0.0 && cut.highestMm >= 0.0;
    throw InvalidInput(
        "the " + what_ +
        (touches ? " touches the lung and does not cross it"
                 : std::string(" does not cross the lung: all of it lies between ") +
                       mm(cut.lowestMm) + " and " + mm(cut.highestMm) + " above the fissure") +
        "; check that its points belong to this lung and lie in the same frame (LPS, mm)");
  }

  static double areaOf(const RegionComplex& complex, const Facet& facet) {
    const Vec3& a = complex.points[facet.corners[0]];
    return (complex.points[facet.corners[1]] - a)
               .cross(complex.points[facet.corners[2]] - a)
               .norm() /
           2.0;
  }

  /// Facets of the parts near the fissure that meet others. The region's own were sound before;
  /// only the cap is new.
  std::vector<std::uint32_t> intersecting(const RegionComplex& work,
                                          const Progress& progress) const {
    std::vector<char> isNear(work.points.size(), 0);
    std::vector<char> known(work.points.size(), 0);
    TriangleMesh mesh{work.points, {}};
    std::vector<std::uint32_t> facetOf;
    for (std::uint32_t f = 0; f < work.facets.size(); ++f) {
      const Facet& facet = work.facets[f];
      if (!facet.borders(cut_.below) && !facet.borders(cut_.above)) continue;
      bool near = false;
      for (const std::uint32_t v : facet.corners) {
        if (known[v] == 0) {
          known[v] = 1;
          isNear[v] = std::abs(fissure_.distance(work.points[v])) <= NearMm ? 1 : 0;
        }
        near = near || isNear[v] != 0;
      }
      if (!near) continue;
      mesh.triangles.push_back(facet.corners);
      facetOf.push_back(f);
    }
    std::vector<std::uint32_t> facets;
    for (const std::uint32_t t : selfIntersecting(mesh, progress).triangles) {
      facets.push_back(facetOf[t]);
    }
    return facets;
  }

  /// More points for the cap where it meets something; the region's triangles there are halved.
  void refine(const RegionComplex& work, const Cut& cut,
              const std::vector<std::uint32_t>& meeting) {
    EdgePoints upon(base_.points.size());
    for (const std::uint32_t f : meeting) {
      if (f >= cut.firstCapFacet) {
        Vec2 centre = Vec2::Zero();
        for (const std::uint32_t v : work.facets[f].corners) {
          centre += fissure_.planar(work.points[v]) / 3.0;
        }
        cut_.capPoints.push_back(centre);
        continue;
      }
      const auto& t = base_.facets[cut.parentOf[f]].corners;
      const auto lengthOf = [&](std::size_t e) {
        return (base_.points[t[e]] - base_.points[t[(e + 1) % 3]]).squaredNorm();
      };
      std::size_t longest = 0;
      for (std::size_t e = 1; e < 3; ++e) {
        if (lengthOf(e) > lengthOf(longest)) longest = e;
      }
      const std::uint32_t a = t[longest];
      const std::uint32_t b = t[(longest + 1) % 3];
      if (upon.find(a, b) != nullptr) continue;
      upon.add(a, b, static_cast<std::uint32_t>(base_.points.size()));
      const Vec3 middle = (base_.points[a] + base_.points[b]) / 2.0;
      base_.points.push_back(middle);
    }
    if (!upon.empty()) subdivide(base_, upon);
  }

  RegionComplex base_;
  const HeightSurface& fissure_;
  const std::string& what_;
  std::size_t pieces_;
  CutSettings cut_;
  CutOutcome last_ = CutOutcome::Done;
};

}  // namespace

std::size_t pieceCount(const RegionComplex& complex, RegionId region) {
  return Pieces(complex, region).count();
}

SplitReport splitRegion(RegionComplex& complex, const HeightSurface& fissure,
                        const SplitRegion& settings, const std::string& what,
                        const Progress& progress) {
  SplitReport report;
  complex = Splitter(complex, fissure, settings, what).split(report, progress);
  return report;
}

}  // namespace pneuma
