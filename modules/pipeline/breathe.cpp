#include "pipeline/breathe.h"

#include <algorithm>
#include <cmath>

#include "core/error.h"
#include "pipeline/detail/breathing_parts.h"
#include "pipeline/detail/collapse.h"

namespace pneuma {
namespace {

constexpr double Mm3PerMl = 1000.0;
constexpr double MlPerLitre = 1000.0;

/// @throws InvalidOption if options speak against each other
void requireOneMotion(const BreatheOptions& options) {
  const bool preset = options.model == MotionModel::Preset;
  if (options.person && (!preset || options.motion != MotionChoice::Scenario)) {
    throw InvalidOption(
        "--constants are the person's own and take the place of --motion; models other than "
        "preset have none. Leave one of the two out");
  }
  if (preset || options.motion == MotionChoice::Scenario) return;
  throw InvalidOption(
      "--motion chooses the constants of --model preset; the other models have none. Leave one of "
      "the two out");
}

MotionPreset presetOf(const BreatheOptions& options) {
  if (options.motion == MotionChoice::Quiet) return MotionPreset::Quiet;
  if (options.motion == MotionChoice::Deep) return MotionPreset::Deep;
  return scenarioOf(options.scenario).deep ? MotionPreset::Deep : MotionPreset::Quiet;
}

/// The curve that was measured.
BreathCycle measuredCycle(const BreatheOptions& options, BreathDrive& drive) {
  if (options.tidalMl > 0.0 || options.periodSeconds > 0.0) {
    throw InvalidOption(
        "a measured breath has its own volume and period; leave --tidal and --period out");
  }
  const auto& samples = options.fit->cycle.samples;
  const auto fullest = std::ranges::max_element(samples, {}, &BreathSample::volume);
  const auto hardest = std::ranges::max_element(samples, {}, &BreathSample::pressure);
  drive.period = options.fit->period;
  drive.inspiration = fullest->seconds;
  drive.relaxation = drive.period - drive.inspiration;
  drive.peak = hardest->pressure - options.fit->offset;
  return options.fit->cycle;
}

/// The curve of the scenario, brought to the volume and period that were asked for.
/// @param compliance of both lungs by that of healthy ones
BreathCycle cycleOf(const BreatheOptions& options, double compliance, BreathDrive& drive) {
  if (options.fit) return measuredCycle(options, drive);
  const BreathScenario& scenario = scenarioOf(options.scenario);
  BreathMechanics mechanics = scenario.mechanics;
  mechanics.compliance *= compliance;
  drive = scenario.drive;
  if (options.periodSeconds > 0.0) {
    const double longer = options.periodSeconds / drive.period;
    drive.period *= longer;
    drive.inspiration *= longer;
    drive.relaxation *= longer;
  }
  const double asked = options.tidalMl / MlPerLitre;
  if (asked > 0.0) mechanics.tidal = asked;
  if (asked > 0.0 || options.periodSeconds > 0.0 || scenario.deep) {
    return breathOfVolume(mechanics, drive, mechanics.tidal);
  }
  return periodicBreath(mechanics, drive);
}

/// Of each lung in what both take in: by its volume and what it keeps of its compliance.
std::map<Side, double> sharesOf(const std::map<Side, double>& restMm3,
                                const std::map<Side, double>& compliance,
                                const BreatheOptions& options) {
  const BreathScenario& scenario = scenarioOf(options.scenario);
  const Side affected = options.affected == AffectedLung::Right ? Side::Right : Side::Left;
  std::map<Side, double> shares = restMm3;
  double sum = 0.0;
  for (auto& [side, share] : shares) {
    share *= compliance.at(side);
    if (side == affected) share *= scenario.affectedCompliance;
    sum += share;
  }
  for (auto& [side, share] : shares) share /= sum;
  return shares;
}

/// Points within a lung to look at, about one for every 12 mm in each direction.
std::vector<Vec3> probesIn(const LungMotion& motion) {
  constexpr double StepMm = 12.0;
  const Box3 box = bounds(motion.wall());
  std::vector<Vec3> points = motion.wall().points;
  const std::size_t every = std::max<std::size_t>(1, points.size() / 4000);
  std::vector<Vec3> probes;
  for (std::size_t n = 0; n < points.size(); n += every) probes.push_back(points[n]);
  const std::vector<Vec3> inside = pointsWithin(motion.wall(), box, StepMm);
  probes.insert(probes.end(), inside.begin(), inside.end());
  return probes;
}

/// What a lung takes in when both take in so much.
double takenMm3(const BreathingLungs& lungs, Side side, double litres) {
  return lungs.share.at(side) * litres * MlPerLitre * Mm3PerMl;
}

double phaseOf(const BreathCycle& cycle, std::vector<BreathSample>::const_iterator sample) {
  const auto steps = static_cast<double>(cycle.samples.size() - 1);
  const double phase = static_cast<double>(sample - cycle.samples.begin()) / steps;
  return phase - std::floor(phase);
}

}  // namespace

BreathingLungs breathe(const LungModel& given, const BreatheOptions& options,
                       const Progress& progress) {
  requireValid(options);
  requireOneMotion(options);
  BreathingLungs lungs;
  progress.report(0.02);
  const Side affected = options.affected == AffectedLung::Right ? Side::Right : Side::Left;
  std::optional<Collapse> collapse;
  if (hasChestWall(options) && given.surfaces) {
    collapse = collapseOf(given, affected, scenarioOf(options.scenario).affectedRest);
    lungs.warnings.push_back(warningOf(*collapse));
  }
  const LungModel model = collapse ? collapsed(given, *collapse) : given;
  const std::map<Side, TriangleMesh> walls =
      wallsOf(model, lungs.warnings, progress.part(0.02, 0.3, "joining lobes"));
  std::map<Side, double> restMm3;
  for (const auto& [side, wall] : walls) restMm3[side] = signedVolumeMm3(wall);
  std::map<Side, double> compliance;
  double bothMm3 = 0.0;
  double bothCompliance = 0.0;
  for (const auto& [side, mm3] : restMm3) {
    compliance[side] = complianceOf(side, mm3, model, options.regions);
    bothMm3 += mm3;
    bothCompliance += mm3 * compliance[side];
  }
  lungs.cycle = cycleOf(options, bothCompliance / bothMm3, lungs.drive);
  lungs.share = sharesOf(restMm3, compliance, options);
  const double mostLitres = lungs.cycle.trapped + lungs.cycle.tidal;
  LungMotionOptions healthy{presetOf(options), options.model, options.posture};
  if (options.person) {
    healthy.form = std::make_shared<const MotionForm>(options.person->form);
    std::map<Side, double> mostMm3;
    for (const auto& [side, mm3] : restMm3) {
      mostMm3[side] = mm3 + takenMm3(lungs, side, mostLitres);
    }
    for (std::string& doubt : doubts(*options.person, restMm3, mostMm3)) {
      lungs.warnings.push_back(std::move(doubt));
    }
  }
  for (const auto& [side, wall] : walls) {
    LungMotionOptions by = healthy;
    by.stiffness = stiffnessAt(wall.points, side, model, options.regions);
    const double taken = takenMm3(lungs, side, mostLitres);
    lungs.motion.emplace(side, LungMotion(side, wall, by, restMm3.at(side) + taken));
    progress.report(0.35);
    if (!collapse || side != collapse->side) continue;
    const TriangleMesh before = beforeCollapse(wall, *collapse);
    lungs.chestWall.emplace(side, before, healthy, signedVolumeMm3(before) + taken);
    progress.report(0.4);
  }
  lungs.surfaces = movingSurfaces(model, lungs.motion, progress.part(0.4, 0.8, "moving lobes"));
  for (const MovingSurface& surface : lungs.surfaces) {
    const auto part = volumePolynomial(*surface.surface.mesh, surface.displacement);
    for (std::size_t k = 0; k < part.a.size(); ++k) lungs.volume[surface.side].a[k] += part.a[k];
  }
  // Between the moments that are written, nothing folds either.
  frameAt(lungs, emptiestPhase(lungs));
  frameAt(lungs, fullestPhase(lungs));
  for (int n = 0; n < options.frames; ++n) {
    lungs.frames.push_back(frameAt(lungs, static_cast<double>(n) / options.frames));
  }
  for (const auto& [side, motion] : lungs.motion) {
    lungs.leastDeterminant[side] =
        leastDeterminant(motion, probesIn(motion), LungMotion::SafeTimes);
    if (lungs.leastDeterminant[side] <= 0.0) {
      throw InvalidInput("the " + std::string(name(side)) +
                         " lung would be turned inside out at 1.5 times this breath; ask for a "
                         "smaller one with --tidal");
    }
  }
  lungs.tree = treeOf(model);
  if (lungs.tree) moveTree(lungs, progress.part(0.8, 1.0, "moving airways"));
  progress.report(1.0);
  return lungs;
}

BreathFrame frameAt(const BreathingLungs& lungs, double phase) {
  BreathFrame frame;
  frame.phase = phase - std::floor(phase);
  frame.breath = lungs.cycle.at(frame.phase);
  for (const auto& [side, motion] : lungs.motion) {
    const VolumePolynomial& volume = lungs.volume.at(side);
    const double taken = takenMm3(lungs, side, frame.breath.volume);
    frame.scale[side] = motion.scaleFor(volume, volume.a[0] + taken);
    frame.volumeMl[side] = volume.at(frame.scale[side]) / Mm3PerMl;
    if (lungs.chestWall && lungs.chestWall->side() == side) {
      frame.chestWallScale = lungs.chestWall->scaleFor(lungs.chestWall->restMm3() + taken);
    }
  }
  return frame;
}

double fullestPhase(const BreathingLungs& lungs) {
  const BreathCycle& cycle = lungs.cycle;
  return phaseOf(cycle, std::ranges::max_element(cycle.samples, {}, &BreathSample::volume));
}

double emptiestPhase(const BreathingLungs& lungs) {
  const BreathCycle& cycle = lungs.cycle;
  return phaseOf(cycle, std::ranges::min_element(cycle.samples, {}, &BreathSample::volume));
}

bool hasChestWall(const BreatheOptions& options) {
  return scenarioOf(options.scenario).affectedRest != 1.0;
}

double pleuralGapMl(const BreathingLungs& lungs) {
  const LungMotion& chest = *lungs.chestWall;
  return (chest.restMm3() - lungs.volume.at(chest.side()).a[0]) / Mm3PerMl;
}

TriangleMesh surfaceAt(const MovingSurface& surface, double scale) {
  TriangleMesh moved = *surface.surface.mesh;
  for (std::size_t n = 0; n < moved.points.size(); ++n) {
    moved.points[n] += scale * surface.displacement[n];
  }
  return moved;
}

AirwayTree treeAt(const BreathingLungs& lungs, const BreathFrame& frame) {
  AirwayTree moved;
  moved.reserve(lungs.tree->size());
  for (std::size_t n = 0; n < lungs.tree->size(); ++n) {
    const Branch& branch = (*lungs.tree)[n];
    const auto scale = frame.scale.find(side(branch.lobe));
    const double s = scale == frame.scale.end() ? 0.0 : scale->second;
    moved.add(movedBranch(branch, lungs.treeMotion, n, s));
  }
  return moved;
}

}  // namespace pneuma
