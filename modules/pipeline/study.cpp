#include "pipeline/study.h"

#include <algorithm>

#include "anatomy/branch_order.h"
#include "core/error.h"
#include "core/joint_progress.h"
#include "core/parallel.h"
#include "pipeline/figure_table.h"
#include "pipeline/trees_at_once.h"

namespace pneuma {
namespace {

constexpr std::size_t MostSeeds = 10000;

void add(Figures& figures, const std::string& name, std::optional<double> value) {
  if (value.has_value()) figures.emplace_back(name, *value);
}

void addEfficiency(Figures& figures, const EfficiencyFunctions& functions,
                   const std::string& suffix) {
  add(figures, "C_n" + suffix, functions.cn);
  add(figures, "V_r" + suffix, functions.vr);
  add(figures, "EL" + suffix, functions.el);
  add(figures, "PI" + suffix, functions.pi);
}

/// Means over the terminals: generation, diameter, path from the root.
void addTerminals(Figures& figures, const AirwayTree& tree) {
  const Children children(tree);
  const std::vector<int> generation = generations(tree);
  std::vector<double> path(tree.size(), 0.0);
  double count = 0.0;
  double generationSum = 0.0;
  double diameterSum = 0.0;
  double pathSum = 0.0;
  for (std::size_t i = 0; i < tree.size(); ++i) {
    const int parent = tree[i].parent;
    path[i] = lengthMm(tree[i]) + (parent < 0 ? 0.0 : path[static_cast<std::size_t>(parent)]);
    if (!children.isTerminal(i)) continue;
    count += 1.0;
    generationSum += generation[i];
    diameterSum += 2.0 * tree[i].radiusMm;
    pathSum += path[i];
  }
  figures.emplace_back("generation", generationSum / count);
  figures.emplace_back("terminal_diameter_mm", diameterSum / count);
  figures.emplace_back("path_length_mm", pathSum / count);
}

Figures figuresOf(const Growth& growth) {
  const Efficiency& e = growth.efficiency;
  Figures figures = {{"N", static_cast<double>(e.branches)},
                     {"T", static_cast<double>(e.terminals)},
                     {"failed", static_cast<double>(e.failed)},
                     {"Q_f", e.qf}};
  add(figures, "C_a", e.ca);
  addEfficiency(figures, e.paper, "");
  addEfficiency(figures, e.today, "_today");
  addTerminals(figures, growth.result.tree);
  for (const auto& figure : growth.result.figures) figures.push_back(figure);
  return figures;
}

std::vector<StudyQuantity> quantitiesOf(const std::vector<StudyRow>& rows) {
  std::vector<StudyQuantity> quantities;
  std::vector<std::vector<double>> values;
  for (const StudyRow& row : rows) {
    for (const auto& [name, value] : row.figures) {
      const auto found = std::ranges::find(quantities, name, &StudyQuantity::name);
      const auto place = static_cast<std::size_t>(found - quantities.begin());
      if (found == quantities.end()) {
        quantities.push_back({name, {}});
        values.emplace_back();
      }
      values[place].push_back(value);
    }
  }
  for (std::size_t i = 0; i < quantities.size(); ++i) quantities[i].summary = summary(values[i]);
  return quantities;
}

}  // namespace

Study study(const LungModel& model, const GrowthOptions& options, const VariationOptions& variation,
            const std::vector<std::uint64_t>& seeds, const Progress& progress) {
  if (seeds.empty() || seeds.size() > MostSeeds) {
    throw InvalidOption("a study takes 1 to " + std::to_string(MostSeeds) + " seeds, but " +
                        std::to_string(seeds.size()) + " were given");
  }
  progress.throwIfStopped();
  const LungModel ready = readyToGrow(model);
  Study result{options, variation, std::vector<StudyRow>(seeds.size()), {}, {}};
  JointProgress joint(progress, seeds.size());
  std::vector<std::vector<std::string>> warnings(seeds.size());
  const auto growSeed = [&](std::size_t i) {
    const LungModel grown =
        grow(varied(ready, variation, seeds[i]), withSeed(options, seeds[i]), joint.task(i));
    result.rows[i] = {seeds[i], figuresOf(*grown.growth)};
    warnings[i] = grown.growth->result.warnings;
    return grown.growth->result.tree.size();
  };
  const std::size_t atOnce = treesAtOnce(growSeed(0));
  for (std::size_t begin = 1; begin < seeds.size(); begin += atOnce) {
    parallelFor(std::min(atOnce, seeds.size() - begin),
                [&](std::size_t k) { growSeed(begin + k); });
  }
  result.quantities = quantitiesOf(result.rows);
  for (std::size_t i = 0; i < seeds.size(); ++i) {
    for (const std::string& warning : warnings[i]) {
      result.warnings.push_back("seed " + std::to_string(seeds[i]) + ": " + warning);
    }
  }
  progress.report(1.0);
  return result;
}

}  // namespace pneuma
