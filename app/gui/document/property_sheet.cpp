#include "document/property_sheet.h"

#include "core/units.h"
#include "document/text.h"

namespace pneuma {

namespace {

using Kind = PropertyRow::Kind;

const char* nameOf(Origin origin) {
  switch (origin) {
    case Origin::Measured:
      return "measured";
    case Origin::Template:
      return "template";
    case Origin::Grown:
      break;
  }
  return "grown";
}

QString nameOf(Ending ending) {
  switch (ending) {
    case Ending::Flow:
      return QStringLiteral("small enough");
    case Ending::LeftRegion:
      return QStringLiteral("left its region");
    case Ending::Ratio:
      return QStringLiteral("could not be divided");
    case Ending::None:
      break;
  }
  return {};
}

QString nameOfRegion(Lobe lobe) {
  if (lobe == Lobe::Central) return QStringLiteral("Central airways");
  if (lobe == Lobe::Whole) return QStringLiteral("Not assigned");
  return capitalised(longName(lobe));
}

PropertyRow check(bool good, const QString& label) {
  return {label, {}, good ? Kind::Good : Kind::Look};
}

std::size_t at(const std::map<Lobe, std::size_t>& counts, Lobe lobe) {
  const auto found = counts.find(lobe);
  return found == counts.end() ? 0 : found->second;
}

QString shareText(double part, double whole, const char* of) {
  return QStringLiteral("%1 of %2")
      .arg(withUnit(100.0 * part / whole, 1, "%"), QString::fromUtf8(of));
}

}  // namespace

PropertySheet branchSheet(const Snapshot& snapshot, std::size_t branch) {
  const auto tree = treeOf(snapshot.model);
  const TreeFigures& figures = *snapshot.figures;
  const Branch& b = (*tree)[branch];
  const double length = lengthMm(b);
  const double diameter = 2.0 * b.radiusMm;

  PropertySheet sheet;
  sheet.title = QStringLiteral("Branch %1").arg(grouped(branch));
  sheet.headline = withUnit(diameter, 2, "mm");
  sheet.note = QStringLiteral("diameter");
  sheet.rows = {
      {QStringLiteral("Region"), nameOfRegion(b.lobe)},
      {QStringLiteral("Origin"), QString::fromUtf8(nameOf(b.origin))},
      {QStringLiteral("Generation"), QString::number(figures.generation[branch])},
      {QStringLiteral("Horsfield order"), QString::number(figures.horsfieldOrder[branch])},
      {QStringLiteral("Strahler order"), QString::number(figures.strahlerOrder[branch])},
      {QStringLiteral("Length"), withUnit(length, 2, "mm")},
      {QStringLiteral("Length / diameter"),
       diameter > 0.0 ? withUnit(length / diameter, 2, "") : QStringLiteral("-")},
  };
  if (b.parent >= 0) {
    const Branch& mother = (*tree)[static_cast<std::size_t>(b.parent)];
    const double angle = angleBetween(direction(mother), direction(b));
    sheet.rows.push_back({QStringLiteral("Angle to mother"), withUnit(degrees(angle), 1, "deg")});
  }
  sheet.rows.push_back(
      {QStringLiteral("Flow share"), withUnit(100.0 * figures.flowFraction[branch], 3, "%")});
  sheet.rows.push_back(
      {QStringLiteral("Path from trachea"), withUnit(figures.pathMm[branch], 1, "mm")});
  if (b.ending != Ending::None) {
    const bool good = b.ending == Ending::Flow;
    sheet.rows.push_back(
        {QStringLiteral("Ended"), nameOf(b.ending), good ? Kind::Figure : Kind::Look});
  }
  return sheet;
}

PropertySheet surfaceSheet(const Snapshot& snapshot, std::size_t surface) {
  const LobeSurface& lobe = (*snapshot.model.surfaces)[surface];
  const MeshReport& health = lobe.health;
  PropertySheet sheet;
  sheet.title = capitalised(longName(lobe.lobe));
  sheet.headline = withUnit(health.volumeMl, 0, "mL");
  const double lungs = lungVolumeMl(snapshot.model);
  if (lungs > 0.0) sheet.note = shareText(health.volumeMl, lungs, "lungs");
  sheet.rows = {
      {QStringLiteral("Surface"), withUnit(health.areaMm2 / 100.0, 0, "cm²")},
      {QStringLiteral("Triangles"), grouped(health.triangles)},
  };
  if (snapshot.figures) {
    sheet.rows.push_back(
        {QStringLiteral("Branches"), grouped(at(snapshot.figures->branchesIn, lobe.lobe))});
    sheet.rows.push_back(
        {QStringLiteral("Terminals"), grouped(at(snapshot.figures->terminalsIn, lobe.lobe))});
  }
  sheet.rows.push_back(
      check(health.closed && health.manifold, QStringLiteral("Closed and manifold")));
  sheet.rows.push_back(
      check(health.components == 1, health.components == 1
                                        ? QStringLiteral("One component")
                                        : QStringLiteral("%1 components").arg(health.components)));
  sheet.rows.push_back(check(health.orientedOutwards, QStringLiteral("Oriented outwards")));
  if (health.selfIntersectionsCounted) {
    sheet.rows.push_back(
        check(health.selfIntersections == 0,
              QStringLiteral("Self-intersections: %1").arg(grouped(health.selfIntersections))));
  }
  return sheet;
}

PropertySheet lungsSheet(const Snapshot& snapshot, Side which) {
  double volume = 0.0;
  double other = 0.0;
  std::size_t lobes = 0;
  bool fit = true;
  for (const auto& surface : *snapshot.model.surfaces) {
    if (which == Side::None || side(surface.lobe) == which) {
      volume += surface.health.volumeMl;
      ++lobes;
      fit = fit && surface.health.fitToGrow();
    } else {
      other += surface.health.volumeMl;
    }
  }
  PropertySheet sheet;
  sheet.title = which == Side::None ? QStringLiteral("Lungs")
                                    : capitalised(name(which)) + QStringLiteral(" lung");
  sheet.headline = withUnit(volume, 0, "mL");
  sheet.note = which == Side::None ? counted(lobes, "surface", "surfaces")
                                   : shareText(volume, volume + other, "lungs");
  sheet.rows = {check(fit, QStringLiteral("Every surface is fit to grow in"))};
  return sheet;
}

PropertySheet treeSheet(const Snapshot& snapshot) {
  const auto tree = treeOf(snapshot.model);
  const TreeFigures& figures = *snapshot.figures;
  PropertySheet sheet;
  sheet.title = QStringLiteral("Airways");
  sheet.headline = grouped(tree->size());
  sheet.note = tree->size() == 1 ? QStringLiteral("branch") : QStringLiteral("branches");
  sheet.rows = {
      {QStringLiteral("Grown"), grouped(figures.grown)},
      {QStringLiteral("Terminals"), grouped(figures.terminals)},
      {QStringLiteral("Generations"), QString::number(figures.branchesOfGeneration.size())},
  };
  const auto& growth = snapshot.model.growth;
  if (!growth) return sheet;
  sheet.rows.push_back({QStringLiteral("Method"), qtText(growthMethod(growth->options).title)});
  const Outside& outside = growth->outside;
  sheet.rows.push_back(check(
      outside.ends == 0, counted(outside.ends, "end outside its lobe", "ends outside their lobe")));
  sheet.rows.push_back(
      check(outside.segments == 0,
            counted(outside.segments, "segment outside its lobe", "segments outside their lobe")));
  return sheet;
}

PropertySheet foundLungsSheet(const Snapshot& snapshot) {
  PropertySheet sheet;
  if (!snapshot.model.lungs) return sheet;
  const LungSegmentation& found = *snapshot.model.lungs;
  const double right = found.right.volumeMl;
  const double left = found.left.volumeMl;
  sheet.title = QStringLiteral("Lungs");
  sheet.headline = withUnit(right + left, 0, "mL");
  sheet.note = QStringLiteral("both lungs");
  sheet.rows = {
      {QStringLiteral("Right lung"), withUnit(right, 0, "mL")},
      {QStringLiteral("Left lung"), withUnit(left, 0, "mL")},
      {QStringLiteral("Right to left"),
       left > 0.0 ? withUnit(right / left, 2, "") : QStringLiteral("-")},
      {QStringLiteral("Mean density"),
       QStringLiteral("%1 / %2").arg(withUnit(found.right.meanHu, 0, ""),
                                     withUnit(found.left.meanHu, 0, "HU"))},
      {QStringLiteral("Airways"), found.airways.found ? withUnit(found.airways.volumeMl, 1, "mL")
                                                      : QStringLiteral("not found")},
  };
  if (found.gasRemovedMl > 0.0) {
    sheet.rows.push_back(
        {QStringLiteral("Bowel gas left out"), withUnit(found.gasRemovedMl, 0, "mL")});
  }
  std::size_t passed = 0;
  for (const SegmentationCheck& one : found.checks) {
    if (one.ok()) {
      ++passed;
    } else {
      sheet.rows.push_back({capitalised(one.what),
                            withUnit(one.value, 1, one.unit == "cm2" ? "cm²" : one.unit.c_str()),
                            Kind::Look});
    }
  }
  sheet.rows.push_back(
      check(passed == found.checks.size(),
            QStringLiteral("%1 of %2 checks passed").arg(passed).arg(found.checks.size())));
  return sheet;
}

PropertySheet filesSheet(const Snapshot& snapshot) {
  PropertySheet sheet;
  const LungModel& model = snapshot.model;
  if (model.ct) {
    const ImageGeometry& geometry = model.ct->geometry;
    sheet.rows.push_back({QStringLiteral("CT"), sizeText(geometry), Kind::Good});
    sheet.rows.push_back({QStringLiteral("Voxel, mm"), QStringLiteral("%1×%2×%3")
                                                           .arg(geometry.spacing.x(), 0, 'f', 2)
                                                           .arg(geometry.spacing.y(), 0, 'f', 2)
                                                           .arg(geometry.spacing.z(), 0, 'f', 2)});
    sheet.rows.push_back({QStringLiteral("Memory"),
                          withUnit(static_cast<double>(2 * geometry.voxelCount()) / 1e6, 0, "MB")});
  }
  if (model.ctSource && !model.ct) {
    sheet.rows.push_back({QObject::tr("CT: not found where it was"), {}, Kind::Look});
  }
  if (model.labels) sheet.rows.push_back({QStringLiteral("Labels"), {}, Kind::Good});
  if (model.surfaces) {
    for (const LobeSurface& surface : *model.surfaces) {
      sheet.rows.push_back({fileNameOf(surface.name), withUnit(surface.health.volumeMl, 0, "mL"),
                            surface.health.fitToGrow() ? Kind::Good : Kind::Look});
    }
  }
  if (model.regions && !model.surfaces) {
    for (const LobeRegion& region : *model.regions) {
      const QString name =
          region.lobe == Lobe::Whole ? QStringLiteral("Organ") : capitalised(longName(region.lobe));
      sheet.rows.push_back(
          {name, withUnit(millilitres(region.domain->volumeMm3()), 0, "mL"), Kind::Good});
    }
  }
  if (model.central) {
    sheet.rows.push_back({QStringLiteral("Airways"),
                          counted(model.central->size(), "branch", "branches"), Kind::Good});
  }
  if (model.opened) {
    sheet.rows.push_back({QStringLiteral("Opened tree"),
                          counted(model.opened->size(), "branch", "branches"), Kind::Good});
  }
  return sheet;
}

}  // namespace pneuma
