#pragma once

#include <array>
#include <map>
#include <memory>
#include <optional>
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
  double extendMm = 0.0;

  static constexpr auto fields() {
    return std::tuple{
        Field{"smoothness", &LobeOptions::smoothness, "", Range{0.0, 100.0},
              "How far a fissure may leave its points to bend less; 0 goes through all of them."},
        Field{"spacing", &LobeOptions::capSpacingMm, "mm", Range{0.5, 20.0},
              "Size of the triangles between lobes."},
        Field{"extend", &LobeOptions::extendMm, "mm", Range{0.0, 15.0},
              "How far a fissure's surface from a file may end before the lung's wall; it goes on "
              "smoothly."},
    };
  }

  bool operator==(const LobeOptions&) const = default;
};

/// Where a fissure comes from.
enum class FissureSource {
  Proposal,
  BentProposal,
  Points,
  Plane,
  Equation,
  Surface,
  FoldingSurface
};

constexpr auto choices(FissureSource) {
  return std::array<std::string_view, 7>{
      "proposal",       "proposal bent through points", "points", "plane", "equation", "surface",
      "folding surface"};
}

/// A fissure that is cut along.
struct UsedFissure {
  HeightSurface surface;  ///< of a folding surface one through its middle, to look at alone
  std::shared_ptr<const FissureSheet> sheet;  ///< that is cut along, if the surface folds
  FissureSource source = FissureSource::Proposal;
  std::size_t points = 0;
  std::vector<double> leftOutMm;   ///< of each point, see leaveOneOut()
  double meanMm = 0.0;             ///< mean distance of the points from the surface
  std::optional<double> coverage;  ///< share of it that its points enclose, see addCoverage()
  double largestMm = 0.0;          ///< largest; of a surface from a file, of its points
};

/// Which points stand out from the others so far that somebody should look at them.
std::vector<std::size_t> suspects(const UsedFissure& used);

using UsedFissures = std::map<Fissure, UsedFissure>;

/// Those that fold.
FissureSheets sheetsIn(const UsedFissures& used);

/// Where a lung is: what proposals follow, and what points must lie near to.
struct LungExtent {
  const TriangleMesh* mesh = nullptr;  ///< has to live as long
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
/// @throws InvalidInput if points lie far from the lung, a plane stands upright so that neither
/// side is above, a surface from a file ends inside the lung, and as fitFissure(), fitPatch() and
/// fissureSheet()
UsedFissures fissureSurfaces(const TriangleMesh& lung, Side side, const GivenFissures& given,
                             const LobeOptions& options, std::vector<std::string>& warnings);

/// The same in a lung that was measured before.
UsedFissures fissureSurfaces(const LungExtent& lung, Side side, const GivenFissures& given,
                             const LobeOptions& options, std::vector<std::string>& warnings);

/// The surface of one more fissure in a lobe. There is no proposal: points alone make it.
/// @throws as fissureSurfaces()
UsedFissure accessorySurface(const AccessoryFissure& fissure, const TriangleMesh& lobe,
                             const LobeOptions& options, std::vector<std::string>& warnings);

}  // namespace pneuma
