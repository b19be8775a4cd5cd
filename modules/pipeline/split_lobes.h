#pragma once

#include <map>
#include <memory>
#include <optional>
#include <vector>

#include "io/json.h"
#include "pipeline/accessory_fissures.h"
#include "pipeline/fissure_snapping.h"
#include "pipeline/fissure_surfaces.h"
#include "pipeline/lung_model.h"

namespace pneuma {

/// What a lobe's surface is like.
struct LobeShape {
  std::size_t faults = 0;  ///< open, non-manifold, misoriented edges and pinched points
  std::size_t pieces = 0;
  int genus = 0;  ///< handles: a fissure that goes around the hilum makes a ring
  double areaMm2 = 0.0;
};

/// Lungs in lobes.
struct LobesOfLungs {
  UsedFissures fissures;
  std::vector<SplitLung> lungs;  ///< right before left
  std::map<Side, double> lungMm3;
  std::map<Lobe, double> lobeMm3;
  FissureSnappings snapped;                  ///< empty without snapping
  std::map<Fissure, Completeness> complete;  ///< empty without a CT of thin slices
  std::map<Lobe, LobeShape> shapes;
  std::vector<PartedLobe> parted;     ///< along accessory fissures
  std::vector<std::string> warnings;  ///< whole sentences
};

/// What the lobes are made with.
struct LobeInputs {
  GivenFissures given;  ///< the others are proposed
  std::vector<AccessoryFissure> accessory;
  std::map<Side, LobeShares> shares;  ///< of lungs whose fissures are moved to wanted volumes
  std::optional<SnapOptions> snap;    ///< onto what shows in the model's CT
  /// What shows in the model's CT, by fissureSheets(); empty: found when it is needed.
  std::map<Side, std::shared_ptr<const SheetnessImage>> sheets;
};

/// The contact of lobes along a fissure, normals from below to above. The lower lobe has two
/// neighbours.
TriangleMesh fissurePatch(const SplitLung& lung, Fissure fissure);

/// Splits whole lungs into lobes along fissureSurfaces().
/// @param model with surfaces of the right lung, the left one or both; with a CT of thin slices and
/// its labels the fissures' completeness is found
/// @throws InvalidInput if there is no lung, one is not fit to be split, fissures shall be snapped
/// without a CT, and as fissureSurfaces(), fissureSheets(), splitLung(), withShares() and
/// partedLobes(); Cancelled
LobesOfLungs splitLobes(const LungModel& model, const LobeInputs& inputs,
                        const LobeOptions& options = {}, const Progress& progress = {});

/// How far the lobes' volumes are from the lung's, as a share of it. They should not be.
double partitionError(const LobesOfLungs& lobes, Side side);

/// The report of `pneuma lobes` ("pneuma/lobes/1").
Json lobesReport(const LungModel& model, const LobesOfLungs& lobes, const LobeOptions& options);

/// For people.
std::string lobesText(const LobesOfLungs& lobes);

}  // namespace pneuma
