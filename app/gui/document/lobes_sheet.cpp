#include "document/lobes_sheet.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "core/units.h"
#include "document/text.h"
#include "render/slice_plane.h"

namespace pneuma {

namespace {

using Kind = PropertyRow::Kind;

constexpr double MostPartitionError = 1e-12;
constexpr double MostMeanMm = 1.0;  ///< of points from their fissure

/// Shares of both lungs that most people's lobes have, %.
struct UsualShare {
  Lobe lobe;
  double low;
  double high;
};

constexpr std::array<UsualShare, 5> UsualSharesOfBoth = {{{Lobe::RightUpper, 15.0, 30.0},
                                                          {Lobe::RightMiddle, 5.0, 12.0},
                                                          {Lobe::RightLower, 20.0, 35.0},
                                                          {Lobe::LeftUpper, 18.0, 32.0},
                                                          {Lobe::LeftLower, 15.0, 35.0}}};

double sumOf(const std::map<Lobe, double>& volumes) {
  double sum = 0.0;
  for (const auto& [lobe, volume] : volumes) sum += volume;
  return sum;
}

PropertyRow check(bool good, const QString& label, const QString& value) {
  return {label, value, good ? Kind::Good : Kind::Look};
}

void addShares(const std::map<Lobe, double>& volumes, PropertySheet& sheet) {
  const double both = sumOf(volumes);
  bool good = true;
  for (const auto& [lobe, low, high] : UsualSharesOfBoth) {
    const double percent = 100.0 * volumes.at(lobe) / both;
    if (percent >= low && percent <= high) continue;
    good = false;
    sheet.rows.push_back(check(
        false,
        QStringLiteral("%1: usual %2 to %3 %").arg(qtText(shortName(lobe))).arg(low).arg(high),
        withUnit(percent, 1, "%")));
  }
  if (good) {
    sheet.rows.push_back(check(true, QStringLiteral("Usual shares of both"), {}));
  }
}

}  // namespace

PropertySheet lobeVolumesSheet(const FissureEditor& editor) {
  PropertySheet sheet;
  const std::map<Lobe, double> volumes = editor.volumesMm3();
  std::map<Side, double> lungs;
  for (const auto& [lobe, volume] : volumes) lungs[side(lobe)] += volume;
  for (const auto& [lobe, volume] : volumes) {
    sheet.rows.push_back(
        {qtText(shortName(lobe)),
         QStringLiteral("%1   %2").arg(withUnit(millilitres(volume), 0, "mL"),
                                       withUnit(100.0 * volume / lungs[side(lobe)], 1, "%"))});
  }
  return sheet;
}

PropertySheet lobeChecksSheet(const FissureEditor& editor, const Document& document) {
  PropertySheet sheet;
  if (!editor.exact()) return sheet;
  const LobesOfLungs& lobes = *document.model().lobes;
  double error = 0.0;
  for (const SplitLung& lung : lobes.lungs) {
    error = std::max(error, partitionError(lobes, lung.side));
  }
  sheet.rows.push_back(check(error <= MostPartitionError, QStringLiteral("Sum is the lung"),
                             QStringLiteral("≤ 1e-12")));
  const bool closed =
      std::ranges::all_of(lobes.shapes, [](const auto& entry) { return entry.second.faults == 0; });
  sheet.rows.push_back(
      check(closed, QStringLiteral("All closed"), closed ? QStringLiteral("0 faults") : QString()));
  double farthest = 0.0;
  bool points = false;
  for (const auto& [fissure, used] : lobes.fissures) {
    points = points || used.points > 0;
    farthest = std::max(farthest, used.meanMm);
  }
  if (points) {
    sheet.rows.push_back(check(farthest <= MostMeanMm, QStringLiteral("Points ≤ 1 mm off"),
                               withUnit(farthest, 1, "mm")));
  }
  if (lobes.lobeMm3.size() == FiveLobes.size()) addShares(lobes.lobeMm3, sheet);
  return sheet;
}

QString fissureLine(const FissureEditor& editor, Fissure fissure) {
  const QString problem = editor.problem(fissure);
  if (!problem.isEmpty()) return problem;
  const UsedFissure& used = editor.used(fissure);
  const std::size_t set = editor.edit(fissure).points.size();
  switch (used.source) {
    case FissureSource::Proposal:
      if (editor.edit(fissure).method == FissureMethod::Points && set > 0) {
        return QStringLiteral("Proposal; %1 of 3 points set").arg(set);
      }
      return used.surface.knots.empty() ? QStringLiteral("Proposed by the lung's shape")
                                        : QStringLiteral("Found in the CT near the proposal");
    case FissureSource::Plane:
      return QStringLiteral("Plane through three handles");
    case FissureSource::Equation:
      return QStringLiteral("Given by an equation");
    case FissureSource::Surface:
      return QStringLiteral("Surface from a file");
    case FissureSource::FoldingSurface:
      return QStringLiteral("Surface that folds: shown roughly until it is split");
    default: {
      const QString text =
          QStringLiteral("%1, mean %2")
              .arg(counted(used.points, "point", "points"), withUnit(used.meanMm, 1, "mm"));
      return used.source == FissureSource::BentProposal ? QStringLiteral("Bent: ") + text : text;
    }
  }
}

QString fissureBrief(const FissureEditor& editor, Fissure fissure) {
  if (!editor.problem(fissure).isEmpty()) return QStringLiteral("! look");
  const UsedFissure& used = editor.used(fissure);
  QString brief;
  switch (used.source) {
    case FissureSource::Proposal:
      brief = used.surface.knots.empty() ? QStringLiteral("proposed") : QStringLiteral("found");
      break;
    case FissureSource::Plane:
      brief = QStringLiteral("plane");
      break;
    case FissureSource::Equation:
      brief = QStringLiteral("equation");
      break;
    case FissureSource::Surface:
      brief = QStringLiteral("surface");
      break;
    default:
      brief = counted(used.points, "point", "points");
  }
  const TracedFissure* traced = editor.traced(fissure);
  if (traced == nullptr || !traced->complete) return brief;
  return brief + QStringLiteral("  ") + withUnit(100.0 * traced->complete->share, 0, "%");
}

QString fissureShows(const FissureEditor& editor, Fissure fissure) {
  const TracedFissure* traced = editor.traced(fissure);
  if (traced == nullptr || !traced->complete) return {};
  return QStringLiteral("%1 of it shows in the CT")
      .arg(withUnit(100.0 * traced->complete->share, 0, "%"));
}

std::vector<QString> fissurePointLines(const FissureEditor& editor, Fissure fissure) {
  std::vector<QString> lines;
  const std::vector<Vec3> points = editor.points(fissure);
  const UsedFissure& used = editor.used(fissure);
  const std::vector<std::size_t> standOut = suspects(used);
  for (std::size_t i = 0; i < points.size(); ++i) {
    QStringList place;
    for (int axis = 0; axis < 3; ++axis) {
      place << qtText(positionText(axis, std::round(points[i][axis])))
                   .section(QLatin1Char('.'), 0, 0);
    }
    QString line = QStringLiteral("%1   %2").arg(i + 1).arg(place.join(QLatin1Char(' ')));
    if (i < used.leftOutMm.size()) {
      line += QStringLiteral("   %1 mm").arg(used.leftOutMm[i], 0, 'f', 1);
    }
    const double weight = editor.edit(fissure).weights[i];
    if (weight != UsualWeight) line += QStringLiteral("   x%1").arg(weight);
    if (std::ranges::find(standOut, i) != standOut.end()) line += QStringLiteral("  ! look");
    lines.push_back(line);
  }
  return lines;
}

}  // namespace pneuma
