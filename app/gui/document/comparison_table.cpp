#include "document/comparison_table.h"

#include <QObject>
#include <QRegularExpression>
#include <algorithm>
#include <array>

#include "document/text.h"

namespace pneuma {

namespace {

/// What tells methods apart; keys of comparisonRows().
constexpr std::array<std::string_view, 11> MainKeys = {
    "branches",
    "terminals",
    "length_m",
    "terminal_generation",
    "branching_angle_deg",
    "length_to_diameter",
    "strahler/Rb",
    "strahler/Rl",
    "strahler/Rd",
    "gap_mean",
    "efficiency/today/V_r",
};

ComparisonLine lineOf(const MethodComparison& comparison, const QString& label) {
  ComparisonLine line;
  line.label = label;
  line.sides.assign(comparison.growths.size(), BandSide::NoBand);
  return line;
}

ComparisonLine secondsLine(const MethodComparison& comparison) {
  ComparisonLine line = lineOf(comparison, QObject::tr("time to grow"));
  for (const auto& growth : comparison.growths) {
    line.values << secondsText(growth->growSeconds);
  }
  return line;
}

ComparisonLine outsideLine(const MethodComparison& comparison) {
  ComparisonLine line = lineOf(comparison, QObject::tr("ends outside their lobe"));
  for (std::size_t i = 0; i < comparison.growths.size(); ++i) {
    const std::size_t ends = comparison.growths[i]->outside.ends;
    const auto all = static_cast<double>(comparison.measured.trees[i].measured.whole.terminals);
    line.values << QStringLiteral("%1 (%2)").arg(
        grouped(ends), withUnit(all > 0.0 ? 100.0 * static_cast<double>(ends) / all : 0.0, 2, "%"));
  }
  return line;
}

/// "26000 to 32000" -> "26,000 to 32,000", "1.2 +- 0.1" -> "1.2 ± 0.1"
QString readable(const std::string& figure) {
  QString text = qtText(figure).replace(QStringLiteral("+-"), QStringLiteral("±"));
  static const QRegularExpression whole(QStringLiteral("(?<![.\\d])\\d{4,}"));
  for (auto found = whole.match(text); found.hasMatch(); found = whole.match(text)) {
    text.replace(found.capturedStart(), found.capturedLength(),
                 grouped(found.captured().toULongLong()));
  }
  return text;
}

/// "V_r" says nothing to those who have not read the paper.
QString labelOf(const ComparisonRow& row, ComparisonFigures figures) {
  if (figures == ComparisonFigures::Main && row.key == "efficiency/today/V_r") {
    return QObject::tr("airway volume / lung volume, V_r");
  }
  return qtText(row.label);
}

}  // namespace

QString secondsText(double seconds) { return withUnit(seconds, seconds < 10.0 ? 2 : 1, "s"); }

std::vector<ComparisonLine> comparisonLines(const MethodComparison& comparison,
                                            ComparisonFigures figures) {
  std::vector<ComparisonLine> lines = {secondsLine(comparison), outsideLine(comparison)};
  for (const ComparisonRow& row : comparisonRows(comparison.measured)) {
    const bool main = std::ranges::find(MainKeys, row.key) != MainKeys.end();
    if (figures == ComparisonFigures::Main && !main) continue;
    if (row.key == "outside/ends") continue;  // told above, with its share
    ComparisonLine line;
    line.label = labelOf(row, figures);
    for (const std::string& value : row.values) {
      line.values << readable(value);
    }
    line.sides = row.sides;
    line.published = readable(row.published);
    line.source = qtText(row.source);
    lines.push_back(std::move(line));
  }
  return lines;
}

}  // namespace pneuma
