#pragma once

#include <map>
#include <optional>
#include <tuple>
#include <vector>

#include "core/options.h"
#include "io/fissure_file.h"
#include "io/json.h"
#include "lobes/lobe_splitting.h"
#include "pipeline/lung_model.h"

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
enum class FissureSource { Proposal, BentProposal, Points };

constexpr auto choices(FissureSource) {
  return std::array<std::string_view, 3>{"proposal", "proposal bent through points", "points"};
}

/// A fissure that was cut along.
struct UsedFissure {
  HeightSurface surface;
  FissureSource source = FissureSource::Proposal;
  std::size_t points = 0;
  std::vector<double> leftOutMm;  ///< of each point, see leaveOneOut()
  double meanMm = 0.0;            ///< mean distance of the points from the surface
};

/// Lungs in lobes.
struct LobesOfLungs {
  std::map<Fissure, UsedFissure> fissures;
  std::vector<SplitLung> lungs;  ///< right before left
  std::map<Side, double> lungMm3;
  std::map<Lobe, double> lobeMm3;
  std::map<Lobe, std::size_t> faults;  ///< open, non-manifold, misoriented edges and pinched points
  std::vector<std::string> warnings;   ///< whole sentences
};

/// What the lobes are made with.
struct LobeInputs {
  FissurePointSets points;            ///< fissures without any are proposed
  std::map<Side, LobeShares> shares;  ///< of lungs whose fissures are moved to wanted volumes
};

/// Splits whole lungs into lobes. A fissure with six points or more is a thin-plate spline over
/// their best plane; with fewer the proposal of the lung's shape is bent through them; with none
/// it is the proposal.
/// @param model with surfaces of the right lung, the left one or both
/// @throws InvalidInput if there is no lung, one is not fit to be split, points lie far from it,
/// and as splitLung() and withShares(); Cancelled
LobesOfLungs splitLobes(const LungModel& model, const LobeInputs& inputs,
                        const LobeOptions& options = {}, const Progress& progress = {});

/// How far the lobes' volumes are from the lung's, as a share of it. They should not be.
double partitionError(const LobesOfLungs& lobes, Side side);

/// The report of `pneuma lobes` ("pneuma/lobes/1").
Json lobesReport(const LungModel& model, const LobesOfLungs& lobes, const LobeOptions& options);

/// For people.
std::string lobesText(const LobesOfLungs& lobes);

}  // namespace pneuma
