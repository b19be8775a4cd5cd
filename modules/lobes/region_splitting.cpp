#include "lobes/region_splitting.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "core/error.h"
#include "geometry/self_intersections.h"
#include "lobes/detail/sentence_text.h"
#include "lobes/fissure_cut.h"
#include "lobes/region_pieces.h"
#include "lobes/subdivision.h"

namespace pneuma {
namespace {

/// How near the cut runs past points, round by round: rather good triangles first.
constexpr std::array<double, 7> Snaps = {0.1, 0.1, 0.03, 0.0, 0.0, 0.0, 0.0};
/// A fissure that only touches the lung somewhere may meet it there however fine both are divided;
/// a little aside it does not. Along its normal, mm, in the order of the tries.
constexpr std::array<double, 7> MovesMm = {0.0, 0.05, -0.05, 0.1, -0.1, 0.2, -0.2};
constexpr int MostJoins = 4;
constexpr double NearMm = 6.0;  ///< from the fissure, where new triangles may meet others

/// Splits along one fissure as it lies.
class Splitter {
 public:
  Splitter(const RegionComplex& complex, const HeightSurface& fissure, const SplitRegion& settings)
      : base_(complex), fissure_(fissure) {
    cut_.region = settings.region;
    cut_.below = settings.below;
    cut_.above = settings.above;
    cut_.capSpacingMm = settings.capSpacingMm;
  }

  /// Nothing if every cut meets the region's own triangles, if the fissure folds, or misses it.
  std::optional<RegionComplex> split(SplitReport& report, const Progress& progress) {
    for (std::size_t round = 0; round < Snaps.size(); ++round) {
      report.rounds = static_cast<int>(round) + 1;
      progress.report(static_cast<double>(round) / static_cast<double>(Snaps.size()));
      cut_.snap = Snaps[round];
      RegionComplex work;
      const Cut cut = cutInPieces(work, report, progress);
      report.lowestMm = cut.lowestMm;
      report.highestMm = cut.highestMm;
      last_ = cut.outcome;
      if (cut.outcome == CutOutcome::DoesNotCross) return std::nullopt;
      if (cut.outcome != CutOutcome::Done) continue;
      const std::vector<std::uint32_t> meeting = intersecting(work, progress);
      if (meeting.empty()) {
        for (std::size_t f = cut.firstCapFacet; f < work.facets.size(); ++f) {
          report.contactMm2 += areaOf(work, work.facets[f]);
        }
        return work;
      }
      refine(work, cut, meeting);
    }
    return std::nullopt;
  }

  /// Of the last cut.
  CutOutcome outcome() const { return last_; }

 private:
  /// Cuts until nothing is left on the wrong side.
  Cut cutInPieces(RegionComplex& work, SplitReport& report, const Progress& progress) {
    for (int join = 0;; ++join) {
      work = base_;
      Cut cut = cutRegion(work, fissure_, cut_, progress);
      if (cut.outcome != CutOutcome::Done || join == MostJoins) return cut;
      const StrayPieces below = strayPieces(work, cut_.below, cut_.above);
      const StrayPieces above = strayPieces(work, cut_.above, cut_.below);
      if (below.count + above.count == 0) return cut;
      report.piecesJoined += below.count + above.count;
      report.joinedMm3 += below.volumeMm3 + above.volumeMm3;
      putOn(std::int8_t{1}, below, work);
      putOn(std::int8_t{-1}, above, work);
    }
  }

  /// Decides the side of what was on the wrong one.
  void putOn(std::int8_t side, const StrayPieces& strays, const RegionComplex& work) {
    for (const std::uint32_t f : strays.facets) {
      for (const std::uint32_t v : work.facets[f].corners) {
        if (v < base_.points.size()) cut_.sideOf[v] = side;
      }
    }
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
  CutSettings cut_;
  CutOutcome last_ = CutOutcome::Done;
};

[[noreturn]] void refuseMiss(const SplitReport& report, const std::string& what) {
  const bool touches = report.lowestMm <= 0.0 && report.highestMm >= 0.0;
  throw InvalidInput(
      "the " + what +
      (touches ? " touches the lung and does not cross it"
               : std::string(" does not cross the lung: all of it lies between ") +
                     lengthText(report.lowestMm) + " and " + lengthText(report.highestMm) +
                     " above the fissure") +
      "; check that its points belong to this lung and lie in the same frame (LPS, mm)");
}

}  // namespace

SplitReport splitRegion(RegionComplex& complex, const HeightSurface& fissure,
                        const SplitRegion& settings, const std::string& what,
                        const Progress& progress) {
  HeightSurface moved = fissure;
  for (std::size_t i = 0; i < MovesMm.size(); ++i) {
    SplitReport report;
    report.movedMm = MovesMm[i];
    moved.centre = fissure.centre + MovesMm[i] * fissure.normal();
    Splitter splitter(complex, moved, settings);
    const double start = 0.9 + 0.01 * static_cast<double>(i);
    std::optional<RegionComplex> parts = splitter.split(
        report, i == 0 ? progress : progress.part(start, start + 0.01, "moving a fissure aside"));
    if (parts) {
      complex = std::move(*parts);
      return report;
    }
    if (i > 0) continue;
    if (splitter.outcome() == CutOutcome::DoesNotCross) refuseMiss(report, what);
    if (splitter.outcome() == CutOutcome::Folds) {
      throw InvalidInput("the " + what +
                         " folds over itself, seen along its best plane; take points away where "
                         "it bends back");
    }
  }
  throw InvalidInput("the " + what +
                     " could not be cut through the lung without triangles that meet each other; "
                     "move the points near the lung's edge a little, or repair the lung's surface");
}

}  // namespace pneuma
