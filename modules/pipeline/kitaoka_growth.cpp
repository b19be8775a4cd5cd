#include "pipeline/kitaoka_growth.h"

#include "anatomy/branch_order.h"
#include "anatomy/efficiency.h"
#include "anatomy/summary.h"
#include "core/units.h"
#include "pipeline/organs.h"

namespace pneuma {
namespace {

constexpr double ParenchymaShare = 0.9;  // of the lungs (Weibel 1963, as the paper cites it)

using FigureMap = std::map<std::string, double>;

/// The central airways with their trunk turned and lengthened; only a trunk alone can be.
AirwayTree withTrunk(const AirwayTree& central, const KitaokaCase& grown) {
  Branch trunk = central[0];
  const Vec3 turned = Eigen::AngleAxisd(radians(grown.trunkTurnLeftDeg), -Vec3::UnitY()) *
                      (Eigen::AngleAxisd(radians(grown.trunkTurnBackDeg), Vec3::UnitX()) *
                       (trunk.distal - trunk.proximal));
  trunk.distal = trunk.proximal + grown.trunkLength * turned;
  AirwayTree result;
  result.add(trunk);
  return result;
}

LungModel organOf(const KitaokaCase& grown) {
  LungModel model = openOrgan(grown.organ);
  if (model.central->size() == 1) {
    model.central = std::make_shared<const AirwayTree>(withTrunk(*model.central, grown));
  }
  return model;
}

void addEfficiency(const Efficiency& efficiency, FigureMap& figures) {
  figures["N"] = static_cast<double>(efficiency.branches);
  figures["T"] = static_cast<double>(efficiency.terminals);
  figures["failed"] = static_cast<double>(efficiency.failed);
  figures["Q_f"] = efficiency.qf;
  figures["C_n"] = efficiency.paper.cn.value();
  figures["C_a"] = efficiency.ca.value();
  figures["V_r"] = efficiency.paper.vr;
  figures["EL"] = efficiency.paper.el;
  figures["PI"] = efficiency.paper.pi.value();
  figures["airway_volume_ml"] = efficiency.airwayVolumeMl;
  figures["lung_volume_ml"] = efficiency.today.lungVolumeMl;
}

/// What the rules did, from the counts of growth.
void addRules(const std::vector<std::pair<std::string, double>>& counts, FigureMap& figures) {
  const FigureMap count(counts.begin(), counts.end());
  const auto share = [](double part, double whole) { return whole > 0.0 ? part / whole : 0.0; };
  figures["rotation"] = count.at("rotation_mean_deg");
  figures["rotation_sd"] = count.at("rotation_sd_deg");
  figures["length_to_diameter"] = count.at("length_to_diameter_mean");
  figures["length_to_diameter_sd"] = count.at("length_to_diameter_sd");
  for (const auto& [name, key] :
       {std::pair{"corrected_by_6a", "angles_corrected"},
        std::pair{"dividing_corrected_by_6a", "angles_corrected_dividing"}}) {
    const double corrected = count.at(key);
    figures[name] = share(corrected, figures["N"]);
    figures[std::string(name) + "_below_18_deg"] =
        share(count.at(std::string(key) + "_below_18_deg"), corrected);
  }
}

void addTerminals(const AirwayTree& tree, FigureMap& figures) {
  const std::vector<int> generation = generations(tree);
  std::vector<double> generations;
  std::vector<double> diametersMm;
  std::vector<double> aciniMl;
  for (std::size_t i = 0; i < tree.size(); ++i) {
    if (tree[i].ending != Ending::Flow) continue;
    generations.push_back(generation[i]);
    diametersMm.push_back(2.0 * tree[i].radiusMm);
    aciniMl.push_back(ParenchymaShare * tree[i].suppliedMl);
  }
  const Summary deep = summary(generations);
  figures["generation"] = deep.mean;
  figures["generation_sd"] = deep.sd;
  figures["generation_min"] = deep.min;
  figures["generation_max"] = deep.max;
  const Summary wide = summary(diametersMm);
  figures["terminal_diameter_mm"] = wide.mean;
  figures["terminal_diameter_sd_mm"] = wide.sd;
  const Summary acinus = summary(aciniMl);
  figures["acinus_ml"] = acinus.mean;
  figures["acinus_sd_ml"] = acinus.sd;
}

}  // namespace

KitaokaGrowth growCase(const KitaokaCase& grown, const Progress& progress) {
  KitaokaGrowth result;
  result.model = organOf(grown);
  const LungModel& model = result.model;
  GrowthResult growth = growByKitaoka(*model.central, *model.regions, grown.options,
                                      progress.part(0.0, 0.95, "growing the paper's trees"));
  addEfficiency(efficiency(growth.tree, *model.regions, model.cubes,
                           progress.part(0.95, 1.0, "measuring the paper's trees")),
                result.figures);
  addRules(growth.figures, result.figures);
  addTerminals(growth.tree, result.figures);
  result.model.opened = std::make_shared<const AirwayTree>(std::move(growth.tree));
  return result;
}

}  // namespace pneuma
