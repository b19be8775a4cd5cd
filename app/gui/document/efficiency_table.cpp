#include "document/efficiency_table.h"

#include <QStringList>
#include <cmath>
#include <optional>
#include <string_view>

#include "document/text.h"

namespace pneuma {

namespace {

QString number(std::optional<double> value, int decimals) {
  return value.has_value() ? withUnit(*value, decimals, "") : QStringLiteral("-");
}

/// A row of which there is only one definition.
EfficiencyRow row(const char* symbol, const char* name, const QString& value,
                  const QString& meaning) {
  return {QString::fromUtf8(symbol), QString::fromUtf8(name), value, value, meaning};
}

EfficiencyRow row(const char* symbol, const char* name, const QString& paper, const QString& today,
                  const QString& meaning) {
  return {QString::fromUtf8(symbol), QString::fromUtf8(name), paper, today, meaning};
}

/// Branches that the method turned, shortened or led back instead of letting them fail.
std::size_t rescues(const GrowthResult& result) {
  double sum = 0.0;
  for (const auto& [name, value] : result.figures) {
    if (std::string_view(name).starts_with("rescued")) sum += value;
  }
  return static_cast<std::size_t>(std::lround(sum));
}

QString noteOn(const Snapshot& snapshot) {
  const Growth& growth = *snapshot.model.growth;
  QStringList parts = {counted(growth.efficiency.failed, "failed", "failed")};
  if (const std::size_t rescued = rescues(growth.result); rescued > 0) {
    parts << counted(rescued, "rescue", "rescues");
  }
  parts << counted(warningsOf(snapshot).size(), "warning", "warnings");
  return parts.join(QStringLiteral(", "));
}

}  // namespace

EfficiencyTable efficiencyTable(const Snapshot& snapshot) {
  EfficiencyTable table;
  if (!snapshot.model.growth) return table;
  const Efficiency& e = snapshot.model.growth->efficiency;
  const auto tr = [](const char* text) { return QString::fromUtf8(text); };
  table.rows = {
      row("N<sub>T</sub>", "N_T", grouped(e.branches), tr("All branches of the tree.")),
      row("Q<sub>f</sub>", "Q_f", number(e.qf, 4),
          tr("Share of the flow that ends in branches that failed: they left their region or could "
             "not divide it.")),
      row("C<sub>n</sub>", "C_n", number(e.paper.cn, 3), number(e.today.cn, 3),
          tr("How unevenly the terminals lie: coefficient of variation of their number in cubes "
             "all over the lungs.")),
      row("C<sub>a</sub>", "C_a", number(e.ca, 3),
          tr("How unequal the terminals' volumes are: coefficient of variation of the flows of "
             "those that did not fail.")),
      row("V<sub>r</sub>", "V_r", number(e.paper.vr, 4), number(e.today.vr, 4),
          tr("Volume of the airways as a share of the lungs' volume.")),
      row("EL", "EL", number(e.paper.el, 4), number(e.today.el, 4),
          tr("Energy that the flow loses to friction, per terminal.")),
      row("PI", "PI", number(e.paper.pi, 3), number(e.today.pi, 3),
          tr("Performance index: the sum of Q_f, C_n, C_a, V_r and EL.")),
  };
  table.paperMeaning =
      tr("As Kitaoka 1999 defines them: cubes of %1 mm, airways related to %2, friction with a "
         "constant of 4.")
          .arg(withUnit(e.paper.cubes.edgeMm, 0, ""), withUnit(e.paper.lungVolumeMl, 0, "mL"));
  table.todayMeaning =
      tr("As one would define them today: cubes of about %1 terminals (%2 mm), airways related to "
         "these lungs' %3, friction by Poiseuille's law.")
          .arg(withUnit(TerminalsPerCube, 0, ""), withUnit(e.today.cubes.edgeMm, 0, ""),
               withUnit(e.today.lungVolumeMl, 0, "mL"));
  table.note = noteOn(snapshot);
  return table;
}

}  // namespace pneuma
