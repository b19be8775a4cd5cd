#pragma once

#include <array>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <tuple>
#include <vector>

#include "anatomy/tree_motion.h"
#include "breathing/breath_cycle.h"
#include "breathing/breath_fit.h"
#include "breathing/lung_motion.h"
#include "core/options.h"
#include "core/progress.h"
#include "io/json.h"
#include "pipeline/lung_model.h"
#include "pipeline/person_motion.h"
#include "pipeline/stiffness_region.h"

namespace pneuma {

/// How lungs move: as the scenario has it, or as people do in quiet or in deep breathing.
enum class MotionChoice { Scenario, Quiet, Deep };

constexpr auto choices(MotionChoice) {
  return std::array<std::string_view, 3>{"scenario", "quiet", "deep"};
}

/// Which lung a pneumothorax has.
enum class AffectedLung { Right, Left };

constexpr auto choices(AffectedLung) { return std::array<std::string_view, 2>{"right", "left"}; }

struct BreatheOptions {
  Breathing scenario = Breathing::Quiet;
  double tidalMl = 0.0;
  double periodSeconds = 0.0;
  int frames = 20;
  MotionChoice motion = MotionChoice::Scenario;
  AffectedLung affected = AffectedLung::Left;
  /// A measured breath, which is breathed instead of the scenario's; null: none. Volume and period
  /// are its own then.
  std::shared_ptr<const BreathFit> fit = nullptr;
  Posture posture = Posture::Supine;
  MotionModel model = MotionModel::Preset;
  std::vector<StiffnessRegion> regions{};  ///< stiffer or softer than healthy lung
  /// A person's own constants, in place of the preset's; null: none.
  std::shared_ptr<const PersonMotion> person = nullptr;

  static constexpr auto fields() {
    using O = BreatheOptions;
    return std::tuple{
        Field{"scenario", &O::scenario, "", Range{}, "The way of breathing."},
        Field{"tidal", &O::tidalMl, "ml", Range{0.0, 10000.0},
              "Volume of a breath, both lungs; 0: the scenario's."},
        Field{"period", &O::periodSeconds, "s", Range{0.0, 60.0},
              "Time of a breath; 0: the scenario's."},
        Field{"frames", &O::frames, "", Range{1, 1000}, "Moments of a breath that are written."},
        Field{"motion", &O::motion, "", Range{},
              "How the lungs move: as people do in quiet or in deep breathing."},
        Field{"affected", &O::affected, "", Range{}, "The lung that has the pneumothorax."},
        Field{"posture", &O::posture, "", Range{},
              "How the person lies, sits or hangs; only supine is measured."},
        Field{"model", &O::model, "", Range{},
              "What moves the lungs: constants of people, the spring network of Santhanam 2008 as "
              "published, or its force law on an elastic surface."},
    };
  }

  bool operator==(const BreatheOptions&) const = default;
};

/// Something that moves with a lung, at rest: the surface of a lobe or of a whole lung.
struct MovingSurface {
  LobeSurface surface;
  Side side = Side::None;
  std::vector<Vec3> displacement;  ///< of its points at s = 1, mm
  /// det(I + s grad u) = 1 + c[0] s + c[1] s^2 + c[2] s^3 at its points.
  std::vector<std::array<double, 3>> volumeChange;
};

/// One moment of a breath.
struct BreathFrame {
  double phase = 0.0;               ///< in [0, 1)
  BreathSample breath;              ///< both lungs
  std::map<Side, double> volumeMl;  ///< of each lung
  std::map<Side, double> scale;     ///< s of each lung
  double chestWallScale = 0.0;      ///< s of BreathingLungs::chestWall
};

/// Lungs that breathe.
struct BreathingLungs {
  BreathCycle cycle;
  BreathDrive drive;
  std::map<Side, LungMotion> motion;
  std::map<Side, VolumePolynomial> volume;  ///< of what the surfaces of a lung enclose together
  std::map<Side, double> share;             ///< of each lung in what both take in; 1 together
  /// Around a lung with a pneumothorax: where its surface would rest were it healthy.
  std::optional<LungMotion> chestWall;
  std::vector<MovingSurface> surfaces;
  std::shared_ptr<const AirwayTree> tree;  ///< null without one
  TreeMotion treeMotion;                   ///< at s = 1
  std::vector<BreathFrame> frames;
  std::map<Side, double> leastDeterminant;  ///< in each lung, at 1.5 times what is used
  std::vector<std::string> warnings;        ///< whole sentences
};

/// Makes the lungs of a model breathe: its surfaces are taken for the lungs at rest. Lobes of a
/// lung and the airways in it follow one field of displacements; trachea and main bronchi stay, and
/// airways take up the motion over 30 mm from where they enter a lobe. Each lung has its share of
/// the breath by its volume, and its surface encloses exactly what the curve of pressure and volume
/// says.
/// @param model with surfaces of lobes or whole lungs; its tree breathes with them
/// @throws InvalidInput if there is no lung, it is open or no lung by its size, the tree lies
/// elsewhere, or the breath would fold the lung; InvalidOption if a measured breath shall have
/// another volume or period, or a model or a person is given constants that it has no use for;
/// Cancelled
BreathingLungs breathe(const LungModel& model, const BreatheOptions& options,
                       const Progress& progress = {});

/// The breath at any share of the period; whole numbers are the beginning of a breath. The chest
/// wall of a pneumothorax follows the lung within it, so that the air between them keeps its
/// volume.
BreathFrame frameAt(const BreathingLungs& lungs, double phase);

/// The share of the period at which the lungs hold most.
double fullestPhase(const BreathingLungs& lungs);

/// The share of the period at which the lungs hold least.
double emptiestPhase(const BreathingLungs& lungs);

/// True if breathe() will draw a chest wall around a lung.
bool hasChestWall(const BreatheOptions& options);

/// The air between a lung with a pneumothorax and the chest wall, ml. @pre there is a chest wall
double pleuralGapMl(const BreathingLungs& lungs);

/// A surface at s, mm.
TriangleMesh surfaceAt(const MovingSurface& surface, double scale);

/// The tree at a moment. @pre there is one
AirwayTree treeAt(const BreathingLungs& lungs, const BreathFrame& frame);

/// The report of `pneuma breathe` ("pneuma/breathe/1").
Json breatheReport(const LungModel& model, const BreathingLungs& lungs,
                   const BreatheOptions& options);

}  // namespace pneuma
