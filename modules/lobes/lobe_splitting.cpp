#include "lobes/lobe_splitting.h"

#include <cmath>
#include <numeric>
#include <string>

#include "core/error.h"
#include "lobes/fissure_cut.h"

namespace pneuma {
namespace {

constexpr double ShareTolerance = 1e-7;
constexpr int SolveSteps = 60;
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

/// The volume below a fissure moved by `mm`, or less than 0 if it does not cross.
double volumeBelow(const RegionComplex& complex, const Step& step, const HeightSurface& fissure,
                   double mm, double capSpacingMm, const Progress& progress) {
  for (int attempt = 0; attempt < 5; ++attempt) {
    RegionComplex work = complex;
    const CutSettings settings{.region = idOf(step.region),
                               .below = idOf(step.below),
                               .above = idOf(step.above),
                               .snap = 0.1,
                               .capSpacingMm = capSpacingMm,
                               .capPoints = {},
                               .sideOf = {}};
    const Cut cut = cutRegion(work, moved(fissure, mm + attempt * NudgeMm), settings, progress);
    if (cut.outcome == CutOutcome::Done) return volumeMm3(work, idOf(step.below));
    if (cut.outcome == CutOutcome::DoesNotCross) {
      return cut.highestMm <= 0.0 ? volumeMm3(complex, idOf(step.region)) : 0.0;
    }
  }
  throw InvalidInput("the " + std::string(longName(step.fissure)) +
                     " cannot be moved to the wanted volume; set points instead");
}

/// By how much a fissure has to be moved for a volume below it.
double moveFor(const RegionComplex& complex, const Step& step, const HeightSurface& fissure,
               double wantedMm3, double capSpacingMm, const Progress& progress) {
  double low = 1e300;
  double high = -1e300;
  for (const Facet& facet : complex.facets) {
    if (!facet.borders(idOf(step.region))) continue;
    for (const std::uint32_t v : facet.corners) {
      const double h = fissure.height(complex.points[v]);
      low = std::min(low, h);
      high = std::max(high, h);
    }
  }
  const double whole = volumeMm3(complex, idOf(step.region));
  double lowMissing = -wantedMm3;
  double highMissing = whole - wantedMm3;
  for (int i = 0; i < SolveSteps; ++i) {
    progress.throwIfStopped();
    // Regula falsi, every third time a bisection: volumes are flat at the ends.
    const double mm = i % 3 == 2 ? (low + high) / 2.0
                                 : low + (high - low) * lowMissing / (lowMissing - highMissing);
    const double missing =
        volumeBelow(complex, step, fissure, mm, capSpacingMm, progress) - wantedMm3;
    if (std::abs(missing) <= ShareTolerance * whole || high - low < 1e-9) return mm;
    (missing < 0.0 ? low : high) = mm;
    (missing < 0.0 ? lowMissing : highMissing) = missing;
  }
  throw InvalidInput("the wanted volume beside the " + std::string(longName(step.fissure)) +
                     " cannot be reached");
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
    HeightSurface& fissure = fissures.at(step.fissure);
    const double wanted = whole * shares[--lobe] / sum;
    fissure = moved(fissure, moveFor(complex, step, fissureIn(fissures, step.fissure), wanted,
                                     capSpacingMm, progress));
    if (lobe > 1) {
      splitRegion(complex, fissure,
                  {idOf(step.region), idOf(step.below), idOf(step.above), capSpacingMm},
                  std::string(longName(step.fissure)), progress);
    }
  }
  return fissures;
}

}  // namespace pneuma
