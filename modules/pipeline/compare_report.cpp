#include <algorithm>
#include <array>
#include <set>

#include "pipeline/compare_trees.h"
#include "pipeline/figure_table.h"
#include "pipeline/report.h"

namespace pneuma {
namespace {

/// Figures of a tree in its regions, with keys in the object of the tree.
constexpr std::array RegionLines = std::to_array<FigureLine>({
    {"outside/ends", "ends outside their lobe", 0},
    {"outside/segments", "branches outside their lobe", 0},
    {"efficiency/failed", "failed terminals", 0},
    {"efficiency/paper/Q_f", "- share of the flow that they carry, Q_f", 4},
    {"efficiency/paper/C_n", "C_n by the definition of Kitaoka 1999", 3},
    {"efficiency/today/C_n", "- by today's", 3},
    {"efficiency/paper/C_a", "C_a", 3},
    {"efficiency/paper/V_r", "V_r by the definition of Kitaoka 1999", 4},
    {"efficiency/today/V_r", "- by today's", 4},
    {"efficiency/paper/EL", "EL by the definition of Kitaoka 1999", 4},
    {"efficiency/today/EL", "- by today's", 4},
    {"efficiency/paper/PI", "PI by the definition of Kitaoka 1999", 3},
    {"efficiency/today/PI", "- by today's", 3},
});

using Row = std::vector<std::string>;

Json treeJson(const ComparedTree& tree) {
  Json json = {{"label", tree.opened.label},
               {"path", tree.opened.input.path},
               {"format", tree.opened.format},
               {"metadata", tree.opened.metadata}};
  json.update(toJson(tree.measured));
  return json;
}

std::vector<Figures> wholeFigures(const TreeComparison& comparison) {
  std::vector<Figures> figures;
  for (const ComparedTree& tree : comparison.trees) {
    figures.push_back(figuresOf(tree.measured.whole));
  }
  return figures;
}

std::optional<double> valueOf(const Figures& figures, std::string_view key) {
  const auto found = std::ranges::find(figures, key, &Figures::value_type::first);
  if (found == figures.end()) return std::nullopt;
  return found->second;
}

/// Every published band that one of the trees has a figure for; null where one has none.
Json publishedJson(const TreeComparison& comparison) {
  const std::vector<Figures> figures = wholeFigures(comparison);
  Json json = Json::array();
  for (const PublishedBand& band : publishedBands()) {
    Json values = Json::array();
    for (const Figures& each : figures) {
      const std::optional<double> value = valueOf(each, band.quantity);
      values.push_back(value.has_value() ? Json(*value) : Json());
    }
    if (std::ranges::all_of(values, [](const Json& value) { return value.is_null(); })) continue;
    json.push_back({{"quantity", band.quantity},
                    {"values", std::move(values)},
                    {"low", band.low},
                    {"high", band.high},
                    {"source", band.source}});
  }
  return json;
}

/// A figure or the mean and spread of a summary; "-" if it is not known.
std::string cellText(const Json& figure, int decimals) {
  const std::optional<double> mean = meanOf(figure);
  if (!mean.has_value()) return "-";
  std::string text = fixed(*mean, decimals);
  if (figure.is_object()) text += " +- " + fixed(figure.at("sd").get<double>(), decimals);
  return text;
}

/// Where each mean lies by the published band, if there is one.
std::vector<BandSide> sidesOf(const FigureLine& line, const std::vector<Json>& reports) {
  const std::optional<PublishedBand> band = bandOf(line);
  std::vector<BandSide> sides;
  for (const Json& report : reports) {
    const std::optional<double> mean = meanOf(figureAt(report, line.key));
    const bool known = mean.has_value() && band.has_value() && band->low < band->high;
    sides.push_back(!known               ? BandSide::NoBand
                    : *mean < band->low  ? BandSide::Below
                    : *mean > band->high ? BandSide::Above
                                         : BandSide::Within);
  }
  return sides;
}

void appendRows(std::span<const FigureLine> lines, const std::vector<Json>& reports,
                std::vector<ComparisonRow>& rows) {
  for (const FigureLine& line : lines) {
    ComparisonRow row{std::string(line.key), std::string(line.label), {}, {}, {}, {}};
    for (const Json& report : reports) {
      row.values.push_back(cellText(figureAt(report, line.key), line.decimals));
    }
    if (std::ranges::all_of(row.values, [](const auto& cell) { return cell == "-"; })) continue;
    row.sides = sidesOf(line, reports);
    if (const std::vector<std::string> band = bandText(line); !band.empty()) {
      row.published = band[0];
      row.source = band[1];
    }
    rows.push_back(std::move(row));
  }
}

/// The length of all branches together, which no report of a single tree has.
ComparisonRow lengthRow(const TreeComparison& comparison) {
  ComparisonRow row{"length_m", "length of all branches, m", {}, {}, {}, {}};
  for (const ComparedTree& tree : comparison.trees) {
    double sumMm = 0.0;
    for (std::size_t i = 0; i < tree.opened.tree->size(); ++i) {
      sumMm += lengthMm((*tree.opened.tree)[i]);
    }
    row.values.push_back(fixed(sumMm / 1000.0, 2));
  }
  row.sides.assign(row.values.size(), BandSide::NoBand);
  return row;
}

/// The keys of all figures, in the order of the report.
std::vector<std::string> keysOf(const std::vector<Figures>& all) {
  std::vector<std::string> keys;
  for (const Figures& figures : all) {
    auto next = keys.begin();
    for (const auto& figure : figures) {
      auto place = std::ranges::find(keys, figure.first);
      if (place == keys.end()) place = keys.insert(next, figure.first);
      next = place + 1;
    }
  }
  return keys;
}

void appendCsv(std::string_view region, const std::vector<Figures>& all,
               std::span<const PublishedBand> bands, std::string& csv) {
  for (const std::string& key : keysOf(all)) {
    csv += std::string(region) + "," + key;
    for (const Figures& figures : all) {
      const std::optional<double> value = valueOf(figures, key);
      csv += ',';
      if (value.has_value()) csv += textOf(*value);
    }
    csv.append(",").append(csvBand(bands, key)).append("\n");
  }
}

}  // namespace

Json toJson(const TreeComparison& comparison, const LungModel& organ, Json parameters) {
  std::vector<InputFile> inputs;
  for (const ComparedTree& tree : comparison.trees) inputs.push_back(tree.opened.input);
  inputs.insert(inputs.end(), organ.inputs.begin(), organ.inputs.end());
  Json json = reportEnvelope("pneuma/compare/1", inputs, std::move(parameters), comparison.seed);
  json["trees"] = Json::array();
  for (const ComparedTree& tree : comparison.trees) {
    for (Json& check : checksOf(tree.measured)) {
      check["tree"] = tree.opened.label;
      json["checks"].push_back(std::move(check));
    }
    for (const std::string& note : tree.opened.notes) {
      json["warnings"].push_back(tree.opened.label + ": " + note);
    }
    json["trees"].push_back(treeJson(tree));
  }
  for (const std::string& warning : organ.warnings) json["warnings"].push_back(warning);
  json["published"] = publishedJson(comparison);
  return json;
}

std::vector<ComparisonRow> comparisonRows(const TreeComparison& comparison) {
  std::vector<Json> trees;
  std::vector<Json> morphometries;
  for (const ComparedTree& tree : comparison.trees) {
    trees.push_back(treeJson(tree));
    morphometries.push_back(trees.back().at("morphometry"));
  }
  std::vector<ComparisonRow> rows;
  appendRows(morphometryLines(), morphometries, rows);
  const auto terminals = std::ranges::find(rows, "terminals", &ComparisonRow::key);
  rows.insert(terminals == rows.end() ? terminals : terminals + 1, lengthRow(comparison));
  appendRows(RegionLines, trees, rows);
  return rows;
}

std::string compareText(const TreeComparison& comparison) {
  std::vector<Row> rows = {{"quantity"}, {"method"}};
  for (const ComparedTree& tree : comparison.trees) {
    const std::string method = tree.opened.method();
    rows[0].push_back(tree.opened.label);
    rows[1].push_back(method.empty() ? "-" : method);
  }
  rows[0].insert(rows[0].end(), {"published", "source"});
  for (ComparisonRow& figure : comparisonRows(comparison)) {
    Row row = {std::move(figure.label)};
    std::ranges::move(figure.values, std::back_inserter(row));
    if (!figure.published.empty()) {
      row.insert(row.end(), {std::move(figure.published), std::move(figure.source)});
    }
    rows.push_back(std::move(row));
  }
  return textTable(rows) +
         "Summaries are mean +- sd. Published figures are those of both lungs of an adult.\n";
}

std::string compareCsv(const TreeComparison& comparison) {
  std::string csv = "region,quantity";
  std::set<Lobe> lobes;
  for (const ComparedTree& tree : comparison.trees) {
    csv.append(",").append(csvQuoted(tree.opened.label));
    for (const auto& [lobe, morphometry] : tree.measured.byLobe) lobes.insert(lobe);
  }
  csv += ",published_low,published_high,source\n";
  appendCsv("all", wholeFigures(comparison), publishedBands(), csv);
  for (const Lobe lobe : lobes) {
    std::vector<Figures> figures;
    for (const ComparedTree& tree : comparison.trees) {
      const auto found = tree.measured.byLobe.find(lobe);
      const bool has = found != tree.measured.byLobe.end();
      figures.push_back(has ? figuresOf(found->second) : Figures());
    }
    appendCsv(shortName(lobe), figures, {}, csv);
  }
  return csv;
}

}  // namespace pneuma
