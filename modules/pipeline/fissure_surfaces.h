#pragma once

#include <array>
#include <map>
#include <string>
#include <string_view>
#include <tuple>
#include <vector>

#include "core/options.h"
#include "core/triangle_mesh.h"
#include "io/fissure_file.h"
#include "lobes/fissure_proposal.h"
#include "lobes/lobe_splitting.h"

namespace pneuma {

struct LobeOptions {
  double smoothness = 0.01;
  double capSpacingMm = 2.5;

  static constexpr auto fields() {
    return std::tuple{
        Field{"smoothness", &LobeOptions::smoothness, "", Range{0.0, 100.0},
              "How far a fissure may leave its points to bend less; 0 goes through all of them."},
        Field{"spacing", &LobeOptions::capSpacingMm, "mm", Range{0.5, 20.0},
              "Size of the triangles between lobes."},
    };
  }

  bool operator==(const LobeOptions&) const = default;
};

/// Where a fissure comes from.
enum class FissureSource { Proposal, BentProposal, Points, Plane };

constexpr auto choices(FissureSource) {
  return std::array<std::string_view, 4>{"proposal", "proposal bent through points", "points",
                                         "plane"};
}

/// A fissure that is cut along.
struct UsedFissure {
  HeightSurface surface;
  FissureSource source = FissureSource::Proposal;
  std::size_t points = 0;
  std::vector<double> leftOutMm;  ///< of each point, see leaveOneOut()
  double meanMm = 0.0;            ///< mean distance of the points from the surface
};

/// Which points stand out from the others so far that somebody should look at them.
std::vector<std::size_t> suspects(const UsedFissure& used);

using UsedFissures = std::map<Fissure, UsedFissure>;

/// Where a lung is: what proposals follow, and what points must lie near to.
struct LungExtent {
  Box3 bounds;
  LungBox box;
};

/// @throws as lungBox()
LungExtent extentOf(const TriangleMesh& lung);

/// The surfaces of a lung's fissures. One given by six points or more is a thin-plate spline over
/// their best plane; with fewer the proposal of the lung's shape is bent through them; one that is
/// not given is the proposal.
/// @param lung closed, oriented outwards, LPS, mm
/// @param warnings gets whole sentences, for example on points that stand out
/// @throws InvalidInput if points lie far from the lung, and as fitFissure()
UsedFissures fissureSurfaces(const TriangleMesh& lung, Side side, const GivenFissures& given,
                             const LobeOptions& options, std::vector<std::string>& warnings);

/// The same in a lung that was measured before.
UsedFissures fissureSurfaces(const LungExtent& lung, Side side, const GivenFissures& given,
                             const LobeOptions& options, std::vector<std::string>& warnings);

}  // namespace pneuma
