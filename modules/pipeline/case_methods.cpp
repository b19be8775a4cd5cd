#include "pipeline/case_methods.h"

#include <algorithm>

#include "pipeline/figure_table.h"
#include "pipeline/report.h"

namespace pneuma {
namespace {

/// Sentences and the papers they name.
class Text {
 public:
  void say(const std::string& sentence) {
    methods_.paragraph += (methods_.paragraph.empty() ? "" : " ") + sentence;
  }

  /// "[2]"
  std::string cite(const std::string& reference) {
    auto& list = methods_.references;
    auto found = std::ranges::find(list, reference);
    if (found == list.end()) found = list.insert(list.end(), reference);
    return "[" + std::to_string(found - list.begin() + 1) + "]";
  }

  CaseMethods take() { return std::move(methods_); }

 private:
  CaseMethods methods_;
};

constexpr const char* Santhanam2003 =
    "Santhanam AP, Pattanaik SN, Rolland JP, et al. Physiologically-based modeling and "
    "visualization of deformable lungs. Pacific Graphics, 2003";
constexpr const char* Santhanam2008 =
    "Santhanam AP, Imielinska C, Davenport P, Kupelian P, Rolland JP. Modeling real-time 3-D lung "
    "deformations for medical visualization. IEEE Trans Inf Technol Biomed, 2008";
constexpr const char* Castillo2013 =
    "Castillo R, Castillo E, Fuentes D, et al. A reference dataset for deformable image "
    "registration spatial accuracy evaluation using the COPDgene study archive. Phys Med Biol "
    "58: 2861-2877, 2013";
constexpr const char* Castillo2009 =
    "Castillo R, Castillo E, Guerra R, et al. A framework for evaluation of deformable image "
    "registration spatial accuracy using large landmark point sets. Phys Med Biol 54: 1849-1870, "
    "2009";

void sayLungs(const LungModel& model, Text& text) {
  if (!model.lungs) return;
  std::string of = "a chest CT";
  if (model.ct) {
    const Vec3 spacing = model.ct->geometry.spacing;
    of += " (voxels of " + fixed(spacing.x(), 2) + " x " + fixed(spacing.y(), 2) + " x " +
          fixed(spacing.z(), 2) + " mm)";
  }
  text.say("Lungs, trachea and central bronchi were found in " + of +
           " by thresholds, connected regions and morphological closing" +
           (model.corrections ? "; the lungs were then corrected by hand (" +
                                    std::to_string(model.corrections->edits.size()) +
                                    (model.corrections->edits.size() == 1 ? " edit)." : " edits).")
                              : std::string(", without manual input.")));
}

void sayLobes(const ProjectState& state, Text& text) {
  if (!state.model.lobes) return;
  const std::size_t given = state.splitEdits.fissures.size();
  text.say(
      "Lungs were split into lobes along smooth surfaces through the fissures (" +
      (given == 0 ? std::string("all of them proposed by the lungs' shape")
                  : std::to_string(given) + " set by hand, the others proposed") +
      "); neighbouring lobes share their triangles, so that there is neither gap nor overlap.");
}

void sayAirways(const LungModel& model, Text& text) {
  if (!model.growth) return;
  const GrowthMethod& method = growthMethod(model.growth->options);
  text.say("The bronchial tree of " + std::to_string(model.growth->result.tree.size()) +
           " branches was grown by " + std::string(method.title) + " " +
           text.cite(std::string(method.citation)) + ", seed " +
           std::to_string(seedOf(model.growth->options)) + ".");
}

void sayBreath(const ProjectState& state, Text& text) {
  if (!state.breath) return;
  const std::string relation =
      "a second-order relation of pressure and volume " + text.cite(Santhanam2008);
  if (state.breath->model == MotionModel::Preset) {
    text.say("Breathing was simulated by " + relation +
             " and a field of displacements whose constants were fitted to landmarks of people " +
             text.cite(Castillo2013) + " " + text.cite(Castillo2009) +
             "; enclosed volumes follow the curve exactly.");
  } else {
    text.say("Breathing was simulated by " + relation + " and the force law of the same paper, " +
             "after " + text.cite(Santhanam2003) +
             ", with constants that are reasoned, not "
             "measured; enclosed volumes follow the curve exactly.");
  }
}

}  // namespace

CaseMethods methodsOf(const ProjectState& state) {
  Text text;
  sayLungs(state.model, text);
  sayLobes(state, text);
  sayAirways(state.model, text);
  sayBreath(state, text);
  text.say("All of it was done with Pneuma " + versionText() + " (commit " + commitText() +
           "), which is for research and not a medical device.");
  return text.take();
}

}  // namespace pneuma
