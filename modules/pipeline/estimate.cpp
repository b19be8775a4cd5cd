#include "pipeline/estimate.h"

#include <cmath>
#include <functional>

#include "breathing/lung_motion.h"
#include "core/error.h"
#include "core/units.h"
#include "pipeline/detail/breathing_parts.h"
#include "pipeline/landmark_lungs.h"

namespace pneuma {
namespace {

using MotionOf = std::function<Vec3(const LandmarkPair&)>;

std::vector<Vec3> displacements(std::span<const LandmarkPair> landmarks, const MotionOf& motion) {
  std::vector<Vec3> all;
  for (const LandmarkPair& pair : landmarks) all.push_back(motion(pair));
  return all;
}

/// @throws InvalidOption, or InvalidInput with the usual options, if too few are held out to tell
/// an error
LandmarkSplit splitOf(const std::vector<LandmarkPair>& landmarks, const EstimateOptions& options) {
  constexpr std::size_t Fewest = 3;
  const auto count = static_cast<double>(landmarks.size());
  LandmarkSplit split =
      options.every > 0
          ? everyNthHeldOut(landmarks, static_cast<std::size_t>(options.every))
          : drawnLandmarks(landmarks,
                           static_cast<std::size_t>(std::lround((1.0 - options.holdOut) * count)),
                           options.seed);
  if (!split.heldOut.empty() && split.heldOut.size() < Fewest) {
    const std::string sentence =
        "of " + std::to_string(landmarks.size()) + " landmarks " +
        std::to_string(split.heldOut.size()) +
        " are held out, too few to tell an error; hold out three or more, or none "
        "with --hold-out 0";
    // Who asked for nothing special has too few landmarks.
    const bool asked = options.every > 0 || options.holdOut != EstimateOptions().holdOut;
    if (asked) throw InvalidOption(sentence);
    throw InvalidInput(sentence);
  }
  return split;
}

/// @throws InvalidInput if a later surface lacks a lung
void requireLater(const EstimateInput& input) {
  for (std::size_t n = 0; n < input.later.size(); ++n) {
    for (const auto& [side, wall] : input.rest) {
      if (input.later[n].contains(side)) continue;
      throw InvalidInput("later surface " + std::to_string(n + 1) + " holds no " +
                         std::string(name(side)) + " lung, which the surfaces at rest hold");
    }
  }
}

/// Boxes, volumes at rest and strains of the lungs.
void findLungs(const EstimateInput& input, std::span<const LandmarkPair> all,
               std::span<const LandmarkPair> fitted, const EstimateOptions& options,
               MotionEstimate& estimate) {
  double bothMm3 = 0.0;
  std::map<Side, Box3> boxes;
  for (const auto& [side, wall] : input.rest) {
    boxes[side] = bounds(wall);
    estimate.restMm3[side] = signedVolumeMm3(wall);
    bothMm3 += estimate.restMm3[side];
  }
  if (boxes.empty()) boxes = boxesOf(all);
  estimate.strainSource = !input.later.empty()   ? StrainSource::Surfaces
                          : options.gainMl > 0.0 ? StrainSource::Gain
                                                 : StrainSource::Landmarks;
  if (estimate.strainSource == StrainSource::Gain && input.rest.empty()) {
    throw InvalidOption("--gain is a gain of lungs; give their surfaces at rest too");
  }
  for (const auto& [side, box] : boxes) {
    double strain = 0.0;
    if (estimate.strainSource == StrainSource::Surfaces) {
      strain =
          std::cbrt(signedVolumeMm3(input.later.back().at(side)) / estimate.restMm3[side]) - 1.0;
    } else if (estimate.strainSource == StrainSource::Gain) {
      strain = std::cbrt(1.0 + cubicMillimetres(options.gainMl) / bothMm3) - 1.0;
    } else {
      strain = innerStrain(fitted, side) / InnerShareOfStrain;
    }
    if (estimate.strainSource == StrainSource::Landmarks && !(strain > 0.0)) {
      throw InvalidInput("the landmarks of the " + std::string(name(side)) +
                         " lung do not draw apart; are the places at expiration the first ones, "
                         "and are there four or more in each lung?");
    }
    estimate.lungs.emplace(side, StrainedLung{{side, box}, strain});
  }
}

/// By volume and strain, about the box's centre.
MotionOf sameExpansion(const StrainedLungs& lungs) {
  return [&lungs](const LandmarkPair& pair) -> Vec3 {
    const StrainedLung& lung = lungs.at(pair.side);
    const Vec3 fromCentre = lung.frame.shareOf(pair.rest) - Vec3::Constant(0.5);
    return lung.frame.toLps(lung.strain * fromCentre.cwiseProduct(lung.frame.lengths()));
  };
}

MotionOf presetMotion(const StrainedLungs& lungs, MotionPreset preset) {
  return [&lungs, preset](const LandmarkPair& pair) {
    const StrainedLung& lung = lungs.at(pair.side);
    return PresetField(preset, lung.frame, std::pow(1.0 + lung.strain, 3.0) - 1.0).at(pair.rest);
  };
}

MotionOf shiftAlone(std::span<const LandmarkPair> fitted) {
  Vec3 shift = Vec3::Zero();
  for (const LandmarkPair& pair : fitted) shift += pair.moved - pair.rest;
  shift /= static_cast<double>(fitted.size());
  return [shift](const LandmarkPair&) { return shift; };
}

/// u_Z = a strain L_Z q_Z and a shift.
MotionOf oneConstant(std::span<const LandmarkPair> fitted, const StrainedLungs& lungs) {
  TermChoice onlyDown = TermChoice::Constant(false);
  onlyDown(2, 2) = true;
  const PolynomialFit fit = fitPolynomialForm(fitted, lungs, onlyDown, 0.0);
  return [&lungs, fit](const LandmarkPair& pair) -> Vec3 {
    return displacementBy(fit.form, lungs, pair) + fit.shift;
  };
}

/// What `pneuma breathe` makes of the constants, with its layer of volume.
std::map<Side, LungMotion> breathingLungs(const EstimateInput& input,
                                          const MotionEstimate& estimate) {
  LungMotionOptions options;
  options.form = std::make_shared<const MotionForm>(estimate.fit.form);
  std::map<Side, LungMotion> motions;
  for (const auto& [side, wall] : input.rest) {
    const double ratio = std::pow(1.0 + estimate.lungs.at(side).strain, 3.0);
    motions.emplace(side, LungMotion(side, wall, options, ratio * estimate.restMm3.at(side)));
  }
  return motions;
}

class ErrorTable {
 public:
  ErrorTable(const LandmarkSplit& split, MotionEstimate& estimate)
      : split_(split), estimate_(estimate) {}

  void add(const std::string& motion, const MotionOf& of, bool ofPerson = false) {
    MotionErrors row{motion, ofPerson,
                     landmarkErrors(split_.fitted, displacements(split_.fitted, of)), std::nullopt};
    if (!split_.heldOut.empty()) {
      row.heldOut = landmarkErrors(split_.heldOut, displacements(split_.heldOut, of));
    }
    estimate_.errors.push_back(std::move(row));
  }

 private:
  const LandmarkSplit& split_;
  MotionEstimate& estimate_;
};

void tellErrors(const EstimateInput& input, const LandmarkSplit& split, MotionEstimate& estimate) {
  const StrainedLungs& lungs = estimate.lungs;
  ErrorTable table(split, estimate);
  table.add("no motion", [](const LandmarkPair&) -> Vec3 { return Vec3::Zero(); });
  table.add("the same expansion everywhere", sameExpansion(lungs));
  table.add("constants of people, quiet", presetMotion(lungs, MotionPreset::Quiet));
  table.add("constants of people, deep", presetMotion(lungs, MotionPreset::Deep));
  table.add("a shift alone", shiftAlone(split.fitted), true);
  table.add("one constant, towards the base", oneConstant(split.fitted, lungs), true);
  const FormFit& fit = estimate.fit;
  if (!input.rest.empty()) {
    try {
      const std::map<Side, LungMotion> motions = breathingLungs(input, estimate);
      table.add(
          "these constants in pneuma breathe",
          [&](const LandmarkPair& pair) -> Vec3 {
            return motions.at(pair.side).at(pair.rest) + fit.shift;
          },
          true);
    } catch (const InvalidInput& error) {
      estimate.warnings.push_back(
          "Lungs cannot breathe by these constants: " + std::string(error.what()) + ".");
    }
  }
  table.add(
      "these constants",
      [&](const LandmarkPair& pair) -> Vec3 {
        return displacementBy(fit.form, lungs, pair) + fit.shift;
      },
      true);
}

void tellWarnings(const EstimateInput& input, MotionEstimate& estimate) {
  if (estimate.heldOutCount == 0) {
    estimate.warnings.emplace_back(
        "No landmark was held out: errors are those of the landmarks that the constants were "
        "fitted to, and flatter.");
  }
  if (estimate.strainSource == StrainSource::Landmarks) {
    estimate.warnings.emplace_back(
        "Volumes are not known; the lungs' strain was guessed from the fitted landmarks. Give the "
        "lungs at inspiration (--later) or the volume taken in (--gain).");
  }
  if (input.rest.empty()) {
    estimate.warnings.emplace_back(
        "There are no surfaces of lungs: boxes are those of the landmarks, which are smaller, so "
        "that lungs that breathe by these constants move a little too far.");
  }
}

}  // namespace

std::map<Side, TriangleMesh> lungWalls(const LungModel& model, std::vector<std::string>& warnings,
                                       const Progress& progress) {
  return wallsOf(model, warnings, progress);
}

MotionEstimate estimateMotion(const EstimateInput& input, const EstimateOptions& options,
                              const Progress& progress) {
  requireValid(options);
  if (input.landmarks.empty()) {
    throw InvalidOption(
        "surfaces alone do not tell how a lung moves: constants that move points 8 mm wrongly "
        "agree with them as well as the true ones. Give landmarks too (--landmarks)");
  }
  if (input.rest.empty() && !input.later.empty()) {
    throw InvalidOption("later surfaces need the surfaces of the same lungs at rest");
  }
  requireLater(input);
  progress.report(0.05);
  std::vector<LandmarkPair> landmarks = input.landmarks;
  if (input.rest.empty()) {
    tellSidesByGap(landmarks);
  } else {
    tellSidesByWalls(landmarks, input.rest);
  }
  const LandmarkSplit split = splitOf(landmarks, options);
  MotionEstimate estimate;
  estimate.fittedCount = split.fitted.size();
  estimate.heldOutCount = split.heldOut.size();
  findLungs(input, landmarks, split.fitted, options, estimate);
  std::vector<WallReading> walls;
  std::vector<int> numbers;
  for (std::size_t n = 0; n < input.later.size(); ++n) {
    for (const auto& [side, wall] : input.rest) {
      walls.emplace_back(side, wall, input.later[n].at(side));
      numbers.push_back(static_cast<int>(n) + 1);
      progress.report(0.2);
    }
  }
  estimate.fit = fitForm(split.fitted, estimate.lungs, walls,
                         {options.form, options.prior, options.surfaceWeight});
  progress.report(0.7);
  for (std::size_t n = 0; n < walls.size(); ++n) {
    const StrainedLung& lung = walls[n].lung();
    estimate.walls.push_back({numbers[n], lung.frame.side(), lung.strain,
                              meanDistanceMm(walls[n], PolynomialForm{}, Vec3::Zero()),
                              meanDistanceMm(walls[n], estimate.fit.form, estimate.fit.shift)});
  }
  tellErrors(input, split, estimate);
  tellWarnings(input, estimate);
  progress.report(1.0);
  return estimate;
}

}  // namespace pneuma
