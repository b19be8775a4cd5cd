#include "lobes/lobe_splitting.h"

#include <cmath>
#include <limits>
#include <numeric>
#include <string>

#include "core/error.h"
#include "core/parallel.h"
#include "lobes/fissure_cut.h"

namespace pneuma {
namespace {

constexpr double ShareTolerance = 1e-7;
constexpr double SplitTolerance = 5e-7;
constexpr int SolveSteps = 60;
constexpr int MoveAttempts = 12;
constexpr double TurnPerAttempt = 1e-5;  ///< slope: 1e-3 mm at 100 mm
constexpr double NudgeMm = 1e-3;  ///< where a cut runs through a point in a way that cannot be

RegionId idOf(Lobe lobe) { return static_cast<RegionId>(lobe); }

/// What a fissure makes of what.
struct Step {
  Fissure fissure;
  Lobe region;
  Lobe below;
  Lobe above;
};

std::vector<Step> stepsOf(Side side) {
  if (side == Side::Left) {
    return {{Fissure::LeftOblique, Lobe::LeftLung, Lobe::LeftLower, Lobe::LeftUpper}};
  }
  return {{Fissure::RightOblique, Lobe::RightLung, Lobe::RightLower, Lobe::RightLung},
          {Fissure::RightHorizontal, Lobe::RightLung, Lobe::RightMiddle, Lobe::RightUpper}};
}

Lobe lungOf(Side side) { return side == Side::Left ? Lobe::LeftLung : Lobe::RightLung; }

const HeightSurface& fissureIn(const FissureSurfaces& fissures, Fissure fissure) {
  const auto found = fissures.find(fissure);
  if (found != fissures.end()) return found->second;
  throw InvalidInput("the " + std::string(longName(fissure)) +
                     " is missing; a lung cannot be split without it");
}

HeightSurface moved(HeightSurface surface, double mm) {
  surface.quadratic[0] += mm;
  return surface;
}

/// Moves a fissure within a region until a wanted volume lies below it.
class Mover {
 public:
  Mover(const RegionComplex& complex, const Step& step, const HeightSurface& fissure,
        double capSpacingMm, const Progress& progress)
      : complex_(complex),
        step_(step),
        fissure_(fissure),
        capSpacingMm_(capSpacingMm),
        progress_(progress),
        whole_(volumeMm3(complex, idOf(step.region))),
        heights_(complex.points.size()) {
    // Moved, it has the same heights but for a number: splines of many knots are asked only once.
    parallelFor(heights_.size(),
                [&](std::size_t v) { heights_[v] = fissure_.height(complex_.points[v]); });
  }

  struct Move {
    double mm = 0.0;
    double belowMm3 = 0.0;  ///< by a single cut
  };

  /// By how much, so that this is the volume by a single cut. It may miss it where the volume
  /// jumps: a cut runs through points that are near.
  Move moveFor(double wantedMm3) const {
    double low = std::numeric_limits<double>::infinity();
    double high = -low;
    for (const Facet& facet : complex_.facets) {
      if (!facet.borders(idOf(step_.region))) continue;
      for (const std::uint32_t v : facet.corners) {
        low = std::min(low, heights_[v]);
        high = std::max(high, heights_[v]);
      }
    }
    double lowMissing = -wantedMm3;
    double highMissing = whole_ - wantedMm3;
    for (int i = 0; i < SolveSteps; ++i) {
      progress_.throwIfStopped();
      // Regula falsi, every third time a bisection: volumes are flat at the ends.
      const double mm = i % 3 == 2 ? (low + high) / 2.0
                                   : low + (high - low) * lowMissing / (lowMissing - highMissing);
      const double below = volumeBelow(mm);
      const double missing = below - wantedMm3;
      if (std::abs(missing) <= ShareTolerance * whole_ || high - low < 1e-9) return {mm, below};
      (missing < 0.0 ? low : high) = mm;
      (missing < 0.0 ? lowMissing : highMissing) = missing;
    }
    refuse();
  }

  [[noreturn]] void refuse() const {
    throw InvalidInput("the wanted volume beside the " + std::string(longName(step_.fissure)) +
                       " cannot be reached; set points instead");
  }

 private:
  /// The volume below the fissure moved by `mm`; none or all of it where that does not cross.
  double volumeBelow(double mm) const {
    for (int attempt = 0; attempt < 5; ++attempt) {
      const double by = mm + attempt * NudgeMm;
      RegionComplex work = complex_;
      CutSettings settings{.region = idOf(step_.region),
                           .below = idOf(step_.below),
                           .above = idOf(step_.above),
                           .snap = 0.1,
                           .capSpacingMm = capSpacingMm_,
                           .capPoints = {},
                           .sideOf = {},
                           .heights = heights_};
      for (double& height : settings.heights) height -= by;
      const Cut cut = cutRegion(work, moved(fissure_, by), settings, progress_);
      if (cut.outcome == CutOutcome::Done) return volumeMm3(work, idOf(step_.below));
      if (cut.outcome == CutOutcome::DoesNotCross) return cut.highestMm <= 0.0 ? whole_ : 0.0;
    }
    refuse();
  }

  const RegionComplex& complex_;
  const Step& step_;
  HeightSurface fissure_;
  double capSpacingMm_;
  const Progress& progress_;
  double whole_;
  std::vector<double> heights_;
};

/// Moves a fissure and splits the region along it, until the volume that the split leaves below is
/// the wanted one: it heals and joins what a single cut does not, and runs through points that are
/// near, so that volumes jump. Where the wanted one lies within such a jump, the fissure is turned
/// by less than any hand could tell.
void moveAndSplit(RegionComplex& complex, const Step& step, HeightSurface& fissure,
                  double wantedMm3, double toleranceMm3, double capSpacingMm,
                  const Progress& progress) {
  double aim = wantedMm3;
  for (int attempt = 0; attempt < MoveAttempts; ++attempt) {
    HeightSurface turned = fissure;
    turned.quadratic[1] += attempt * TurnPerAttempt * turned.scale;
    const Mover mover(complex, step, turned, capSpacingMm, progress);
    const auto [mm, belowMm3] = mover.moveFor(aim);
    const HeightSurface there = moved(turned, mm);
    RegionComplex work = complex;
    splitRegion(work, there, {idOf(step.region), idOf(step.below), idOf(step.above), capSpacingMm},
                std::string(longName(step.fissure)), progress);
    const double below = volumeMm3(work, idOf(step.below));
    if (std::abs(below - wantedMm3) <= toleranceMm3) {
      fissure = there;
      complex = std::move(work);
      return;
    }
    aim = wantedMm3 - (below - belowMm3);
    if (attempt + 1 == MoveAttempts) mover.refuse();
  }
}

void requireShares(const LobeShares& shares, std::size_t lobes) {
  double sum = 0.0;
  bool positive = shares.size() == lobes;
  for (const double share : shares) {
    sum += share;
    positive = positive && share > 0.0;
  }
  if (positive && std::abs(sum - 1.0) <= 0.001) return;
  throw InvalidInput("the lobes' shares of a lung must be " + std::to_string(lobes) +
                     " positive numbers that sum up to 100 %");
}

}  // namespace

std::vector<Fissure> fissuresOf(Side side) {
  std::vector<Fissure> fissures;
  for (const Step& step : stepsOf(side)) fissures.push_back(step.fissure);
  return fissures;
}

std::vector<Lobe> lobesOf(Side side) {
  if (side == Side::Left) return {Lobe::LeftUpper, Lobe::LeftLower};
  return {Lobe::RightUpper, Lobe::RightMiddle, Lobe::RightLower};
}

SplitLung splitLung(const TriangleMesh& lung, Side side, const FissureSurfaces& fissures,
                    double capSpacingMm, const Progress& progress) {
  return splitLung(lung, side, fissures, {}, capSpacingMm, progress);
}

SplitLung splitLung(const TriangleMesh& lung, Side side, const FissureSurfaces& fissures,
                    const FissureSheets& sheets, double capSpacingMm, const Progress& progress) {
  SplitLung split{side, complexOf(lung, idOf(lungOf(side))), {}};
  const std::vector<Step> steps = stepsOf(side);
  for (std::size_t n = 0; n < steps.size(); ++n) {
    const auto part = [&](std::size_t done) {
      return static_cast<double>(done) / static_cast<double>(steps.size());
    };
    const Progress now = progress.part(part(n), part(n + 1), "cutting along fissures");
    const auto& [fissure, region, below, above] = steps[n];
    const SplitRegion settings{idOf(region), idOf(below), idOf(above), capSpacingMm};
    const std::string what(longName(fissure));
    const auto sheet = sheets.find(fissure);
    split.reports[fissure] =
        sheet != sheets.end()
            ? splitRegion(split.complex, *sheet->second, settings, what, now)
            : splitRegion(split.complex, fissureIn(fissures, fissure), settings, what, now);
  }
  return split;
}

LobeShares usualShares(Side side) {
  if (side == Side::Left) return {0.5, 0.5};
  return {0.405, 0.129, 0.466};
}

FissureSurfaces withShares(const TriangleMesh& lung, Side side, FissureSurfaces fissures,
                           const LobeShares& shares, double capSpacingMm,
                           const Progress& progress) {
  requireShares(shares, lobesOf(side).size());
  RegionComplex complex = complexOf(lung, idOf(lungOf(side)));
  const double whole = volumeMm3(complex, idOf(lungOf(side)));
  const double sum = std::accumulate(shares.begin(), shares.end(), 0.0);
  // Lower lobe first, then the middle one: the share below each fissure in turn.
  std::size_t lobe = shares.size();
  for (const Step& step : stepsOf(side)) {
    fissureIn(fissures, step.fissure);  // refuses if there is none
    moveAndSplit(complex, step, fissures.at(step.fissure), whole * shares[--lobe] / sum,
                 SplitTolerance * whole, capSpacingMm, progress);
  }
  return fissures;
}

}  // namespace pneuma
