#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <tuple>
#include <vector>

#include "anatomy/landmark_pair.h"
#include "breathing/form_fit.h"
#include "breathing/landmark_error.h"
#include "core/options.h"
#include "core/progress.h"
#include "core/triangle_mesh.h"
#include "io/json.h"
#include "pipeline/lung_model.h"

namespace pneuma {

struct EstimateOptions {
  FormKind form = FormKind::Deep;
  double prior = WeakRidge;
  double surfaceWeight = 0.1;
  double holdOut = 0.2;
  int every = 0;
  double gainMl = 0.0;
  std::uint64_t seed = 1;

  static constexpr auto fields() {
    using O = EstimateOptions;
    return std::tuple{
        Field{"form", &O::form, "", Range{},
              "What constants are fitted of: the polynomial of deep or of quiet breathing, or the "
              "form of Santhanam 2008."},
        Field{"prior", &O::prior, "", Range{0.0, 100.0},
              "How strongly a polynomial is drawn to the same expansion everywhere; 0: not at "
              "all."},
        Field{"surface-weight", &O::surfaceWeight, "", Range{0.0, 10.0},
              "Weight of all later surfaces together by that of all landmarks."},
        Field{"hold-out", &O::holdOut, "", Range{0.0, 0.95},
              "Share of the landmarks, drawn by the seed, that is not fitted but tells the error."},
        Field{"every", &O::every, "", Range{0, 1000},
              "Hold out every n-th landmark instead; 0: draw them."},
        Field{"gain", &O::gainMl, "ml", Range{0.0, 10000.0},
              "Volume that both lungs take in between the two places of the landmarks; 0: that of "
              "the last later surface."},
        Field{"seed", &O::seed, "", Range{0, 9007199254740991.0},
              "Seed of the landmarks that are held out."},
    };
  }

  bool operator==(const EstimateOptions&) const = default;
};

/// One person.
struct EstimateInput {
  std::map<Side, TriangleMesh> rest;  ///< walls at the end of expiration; may be empty
  std::vector<std::map<Side, TriangleMesh>> later;  ///< at rising volumes; may be empty
  std::vector<LandmarkPair> landmarks;
};

/// How far landmarks are from where a motion brings them.
struct MotionErrors {
  std::string motion;
  bool ofPerson = false;  ///< known from the fitted landmarks, the person's shift with it
  LandmarkErrors fitted;
  std::optional<LandmarkErrors> heldOut;
};

/// How far a lung's wall is from its surface at a later volume, mm, mean over the wall.
struct WallAgreement {
  int later = 1;  ///< number of the later surface
  Side side = Side::None;
  double strain = 0.0;
  double stillMm = 0.0;   ///< if nothing moves
  double fittedMm = 0.0;  ///< by the fitted constants
};

/// Where the strains come from.
enum class StrainSource { Surfaces, Gain, Landmarks };

struct MotionEstimate {
  FormFit fit;
  StrainedLungs lungs;
  std::map<Side, double> restMm3;  ///< empty without surfaces
  StrainSource strainSource = StrainSource::Surfaces;
  std::size_t fittedCount = 0;
  std::size_t heldOutCount = 0;
  std::vector<MotionErrors> errors;  ///< the fitted constants' last
  std::vector<WallAgreement> walls;
  std::vector<std::string> warnings;  ///< whole sentences
};

/// The closed surfaces of a model's lungs, its lobes joined.
/// @param warnings that come up are added, whole sentences
/// @throws InvalidInput if there is no lung, or a lobe is missing
std::map<Side, TriangleMesh> lungWalls(const LungModel& model, std::vector<std::string>& warnings,
                                       const Progress& progress = {});

/// Fits the constants of a form of motion to one person's landmarks, and tells what they are worth
/// on landmarks that were not used. Later surfaces give each lung's strain, and hint weakly at how
/// it moves; alone they are refused, as constants that move points wrongly agree with them as well.
/// Without surfaces at rest, boxes are those of the landmarks.
/// @throws InvalidOption if there are surfaces and no landmarks, or too few are held out;
/// InvalidInput as fitForm(), if a later surface lacks a lung or is not larger, or landmarks lie
/// outside of the lungs; Cancelled
MotionEstimate estimateMotion(const EstimateInput& input, const EstimateOptions& options,
                              const Progress& progress = {});

/// The report of `pneuma estimate` ("pneuma/estimate/1"), which readPersonMotion() reads.
Json estimateReport(std::span<const InputFile> inputs, const EstimateOptions& options,
                    const MotionEstimate& estimate);

}  // namespace pneuma
