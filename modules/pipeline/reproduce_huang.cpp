#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>

#include "anatomy/branch_order.h"
#include "core/units.h"
#include "pipeline/organs.h"
#include "pipeline/reproduce_paper.h"

namespace pneuma {
namespace {

constexpr std::uint64_t PaperPoints = 103894;
constexpr double ChosenRatio = 0.41;

constexpr std::string_view MiddleLobe = "1";
constexpr std::string_view RightLung = "right-lung";

constexpr std::array<PaperTable, 2> Tables = {
    {{MiddleLobe, "Table 1: right middle lobe"}, {RightLung, "Right lung at ratio 0.41"}}};

/// A column of Table 1: right middle lobe at one ratio, with the limits we hold ourselves to.
/// The paper's lobe was read off CT slices that are lost; ours is synthetic, hence the limits
/// (docs/algorithms/centroid-splitting.md).
struct TableColumn {
  double ratio;
  double terminals;
  double angleDeg;
  double generation;
  double terminalsLimit;   // relative
  double angleLimitDeg;    // absolute
  double generationLimit;  // absolute
};

constexpr std::array<TableColumn, 10> Columns = {{
    {0.30, 2897, 25.97, 15.28, 0.10, 2.0, 0.10},
    {0.35, 2879, 31.79, 15.30, 0.06, 1.0, 0.10},
    {0.37, 2866, 33.43, 15.26, 0.06, 1.0, 0.10},
    {0.39, 2951, 35.81, 15.27, 0.06, 1.0, 0.10},
    {0.40, 2963, 36.75, 15.30, 0.06, 1.0, 0.10},
    {0.41, 2975, 37.84, 15.33, 0.06, 1.0, 0.10},
    {0.42, 3013, 38.65, 15.38, 0.06, 1.0, 0.10},
    {0.43, 3032, 39.25, 15.36, 0.06, 1.0, 0.10},
    {0.45, 3023, 40.77, 15.35, 0.10, 2.0, 0.10},
    // The mean generation hardly depends on the ratio in any reading tried: 15.32 against 15.43.
    {0.50, 3066, 43.88, 15.43, 0.10, 2.0, 0.12},
}};

/// The paper's own statistics, with its own definitions.
struct PaperStatistics {
  double terminals = 0.0;
  double generation = 0.0;        // mean over terminals, trachea 0
  double angleDeg = 0.0;          // mean over daughters of mothers with two daughters
  double terminalLengthMm = 0.0;  // mean
  double pathMm = 0.0;            // mean, from the end of the second generation
};

PaperStatistics statistics(const AirwayTree& tree, std::optional<Lobe> lobe) {
  const Children children(tree);
  const std::vector<int> generation = generations(tree);
  std::vector<double> path(tree.size(), 0.0);
  PaperStatistics sums;
  double angles = 0.0;
  for (std::size_t i = 0; i < tree.size(); ++i) {
    const Branch& branch = tree[i];
    if (branch.parent < 0) continue;
    const auto parent = static_cast<std::size_t>(branch.parent);
    path[i] = path[parent] + (generation[i] > 2 ? lengthMm(branch) : 0.0);
    if (branch.origin != Origin::Grown || (lobe.has_value() && branch.lobe != *lobe)) continue;
    if (children.of(parent).size() == 2) {
      sums.angleDeg += degrees(angleBetween(direction(branch), direction(tree[parent])));
      angles += 1.0;
    }
    if (children.isTerminal(i)) {
      sums.terminals += 1.0;
      sums.generation += generation[i];
      sums.terminalLengthMm += lengthMm(branch);
      sums.pathMm += path[i];
    }
  }
  sums.angleDeg /= std::max(angles, 1.0);
  const double terminals = std::max(sums.terminals, 1.0);
  sums.generation /= terminals;
  sums.terminalLengthMm /= terminals;
  sums.pathMm /= terminals;
  return sums;
}

void addColumn(const TableColumn& column, const AirwayTree& tree, ReproducedTable& table) {
  const PaperStatistics lobe = statistics(tree, Lobe::RightMiddle);
  std::array<char, 8> name{};
  std::snprintf(name.data(), name.size(), "%.2f", column.ratio);
  table.rows.push_back({name.data(),
                        "terminals",
                        column.terminals,
                        lobe.terminals,
                        Limit::relative(column.terminalsLimit),
                        {}});
  table.rows.push_back({name.data(),
                        "branching angle, deg",
                        column.angleDeg,
                        lobe.angleDeg,
                        Limit::difference(column.angleLimitDeg),
                        {}});
  table.rows.push_back({name.data(),
                        "mean generation",
                        column.generation,
                        lobe.generation,
                        Limit::difference(column.generationLimit),
                        {}});
}

void addWholeLung(const Growth& growth, ReproducedTable& table) {
  const PaperStatistics all = statistics(growth.result.tree, std::nullopt);
  const double dimension = std::log(all.terminals) / std::log(200.0 / all.terminalLengthMm);
  const auto outside = static_cast<double>(growth.outside.ends);
  table.rows = {
      {"0.41", "terminals", 16141, all.terminals, Limit::relative(0.03), {}},
      {"0.41", "terminal length, mm", 2.4, all.terminalLengthMm, Limit::difference(0.1), {}},
      {"0.41",
       "dimension ln N / ln(200 mm / length)",
       2.19,
       dimension,
       Limit::difference(0.02),
       {}},
      {"0.41", "path from the end of generation 2, mm", 135, all.pathMm, Limit::relative(0.05), {}},
      {"0.41", "ends outside their lobe", 0, outside, Limit::difference(0.0), {}}};
}

void reproduceHuang(const ReproduceOptions& options, Reproduction& result,
                    const Progress& progress) {
  const LungModel organ = openOrgan("right-lung");
  ReproducedTable lobe{std::string(Tables[0].id), std::string(Tables[0].name), {}};
  ReproducedTable lung{std::string(Tables[1].id), std::string(Tables[1].name), {}};
  std::vector<TableColumn> columns(Columns.begin(), Columns.end());
  if (!wanted(options, MiddleLobe)) {
    std::erase_if(columns, [](const TableColumn& column) { return column.ratio != ChosenRatio; });
  }
  for (std::size_t i = 0; i < columns.size(); ++i) {
    const double share = 1.0 / static_cast<double>(columns.size());
    LungModel grown =
        grow(organ, CentroidSplittingOptions{.ratio = columns[i].ratio, .points = PaperPoints},
             progress.part(share * static_cast<double>(i), share * static_cast<double>(i + 1),
                           "growing the paper's lung"));
    addColumn(columns[i], grown.growth->result.tree, lobe);
    if (columns[i].ratio != ChosenRatio) continue;
    addWholeLung(*grown.growth, lung);
    if (!options.figures) continue;
    grown.surfaces = surfacesOf(*grown.regions, 2.0);
    result.figures.push_back({"lung", std::move(grown)});
  }
  for (ReproducedTable* table : {&lobe, &lung}) {
    if (wanted(options, table->id)) result.tables.push_back(std::move(*table));
  }
}

}  // namespace

const Paper& huang2004() {
  static const Paper paper{"huang-2004", growthMethod("centroid").citation, Tables, reproduceHuang};
  return paper;
}

}  // namespace pneuma
