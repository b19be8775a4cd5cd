#pragma once

#include <map>
#include <memory>
#include <vector>

#include "anatomy/fissure.h"
#include "lobes/height_surface.h"
#include "lobes/region_complex.h"
#include "lobes/region_splitting.h"
#include "lobes/sheet_splitting.h"

namespace pneuma {

/// Fissures by name.
using FissureSurfaces = std::map<Fissure, HeightSurface>;

/// Those among them that fold, so that they are cut along as surfaces.
using FissureSheets = std::map<Fissure, std::shared_ptr<const FissureSheet>>;

/// The fissures of a lung, in the order in which they cut: the horizontal one cuts what the oblique
/// one leaves in front.
std::vector<Fissure> fissuresOf(Side side);

/// The lobes of a lung, upper before lower.
std::vector<Lobe> lobesOf(Side side);

/// The lobe of a place by the fissures that it lies below. The left lung has no horizontal one.
constexpr Lobe lobeBy(Side side, bool belowOblique, bool belowHorizontal) {
  if (side == Side::Left) return belowOblique ? Lobe::LeftLower : Lobe::LeftUpper;
  if (belowOblique) return Lobe::RightLower;
  return belowHorizontal ? Lobe::RightMiddle : Lobe::RightUpper;
}

/// One lung in lobes. Its regions have the numbers of Lobe.
struct SplitLung {
  Side side = Side::None;
  RegionComplex complex;
  std::map<Fissure, SplitReport> reports;
};

/// Splits a lung into its lobes: closed, manifold, without gap or overlap, each triangle of a
/// contact the same in both neighbours, volumes that sum up to the lung's.
/// @param lung closed, oriented outwards, LPS, mm
/// @param fissures of this side, those of others do not matter
/// @throws InvalidInput as splitRegion(), and if a fissure is missing; Cancelled
SplitLung splitLung(const TriangleMesh& lung, Side side, const FissureSurfaces& fissures,
                    double capSpacingMm, const Progress& progress = {});

/// The same along sheets where there are some.
SplitLung splitLung(const TriangleMesh& lung, Side side, const FissureSurfaces& fissures,
                    const FissureSheets& sheets, double capSpacingMm,
                    const Progress& progress = {});

/// Shares of a lung's volume, in the order of lobesOf(side).
using LobeShares = std::vector<double>;

/// Shares of 85 people of the COPDGene study: 40.5, 12.9, 46.6 and 50, 50 %.
LobeShares usualShares(Side side);

/// The same fissures moved along their normals so that the lobes have these shares of the lung,
/// to 1e-6 of it.
/// @throws InvalidInput if shares are not positive or do not sum up to 1 within 0.001, or cannot be
/// met; Cancelled
FissureSurfaces withShares(const TriangleMesh& lung, Side side, FissureSurfaces fissures,
                           const LobeShares& shares, double capSpacingMm,
                           const Progress& progress = {});

}  // namespace pneuma
