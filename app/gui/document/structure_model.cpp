#include "document/structure_model.h"

#include <algorithm>
#include <array>
#include <optional>
#include <utility>

#include "document/text.h"

namespace pneuma {

namespace {

using Structure = StructureModel::Structure;
using StructureKind = StructureModel::Kind;

/// Within "Right lung" the lobe needs no "right".
QString lobeName(Lobe lobe) {
  switch (lobe) {
    case Lobe::RightUpper:
    case Lobe::LeftUpper:
      return QStringLiteral("Upper lobe");
    case Lobe::RightMiddle:
      return QStringLiteral("Middle lobe");
    case Lobe::RightLower:
    case Lobe::LeftLower:
      return QStringLiteral("Lower lobe");
    default:
      return capitalised(longName(lobe));
  }
}

void addSide(std::vector<Structure>& structures, const std::vector<LobeSurface>& surfaces,
             Side which) {
  std::vector<Structure> below;
  double volume = 0.0;
  for (std::size_t i = 0; i < surfaces.size(); ++i) {
    if (side(surfaces[i].lobe) != which) continue;
    const double ml = surfaces[i].health.volumeMl;
    volume += ml;
    below.push_back({StructureKind::Surface, which == Side::None ? 1 : 2,
                     lobeName(surfaces[i].lobe), withUnit(ml, 0, "mL"), which, surfaces[i].lobe,
                     i});
  }
  if (below.empty()) return;
  std::sort(below.begin(), below.end(),
            [](const Structure& a, const Structure& b) { return a.lobe < b.lobe; });
  // A lung that is not split needs no heading of its own name.
  const bool whole = below.size() == 1 && (below.front().lobe == Lobe::RightLung ||
                                           below.front().lobe == Lobe::LeftLung);
  if (whole) {
    below.front().depth = 1;
  } else if (which != Side::None) {
    structures.push_back({StructureKind::Side, 1,
                          capitalised(name(which)) + QStringLiteral(" lung"),
                          withUnit(volume, 0, "mL"), which});
  }
  structures.insert(structures.end(), below.begin(), below.end());
}

}  // namespace

void StructureModel::show(const Snapshot& snapshot) {
  std::vector<Structure> next;
  if (snapshot.model.surfaces) {
    next.push_back(
        {StructureKind::Lungs, 0, tr("Lungs"), withUnit(lungVolumeMl(snapshot.model), 0, "mL")});
    for (const Side which : {Side::Right, Side::Left, Side::None}) {
      addSide(next, *snapshot.model.surfaces, which);
    }
  }
  if (const auto tree = treeOf(snapshot.model)) {
    next.push_back({StructureKind::Airways, 0, tr("Airways"),
                    counted(tree->size(), "branch", "branches"), Side::None, Lobe::Central});
  }
  for (Structure& structure : next) {
    const auto before =
        std::find_if(structures_.begin(), structures_.end(), [&](const Structure& old) {
          return old.kind == structure.kind && old.side == structure.side &&
                 old.lobe == structure.lobe;
        });
    if (before == structures_.end()) continue;
    structure.visible = before->visible;
    structure.density = before->density;
  }
  beginResetModel();
  structures_ = std::move(next);
  endResetModel();
}

std::optional<int> StructureModel::rowOfSurface(std::size_t surface) const {
  for (int i = 0; i < rowCount(); ++i) {
    if (structure(i).kind == StructureKind::Surface && structure(i).surface == surface) return i;
  }
  return std::nullopt;
}

std::optional<int> StructureModel::rowOfAirways() const {
  if (structures_.empty() || structures_.back().kind != StructureKind::Airways) return std::nullopt;
  return rowCount() - 1;
}

int StructureModel::rowCount(const QModelIndex& parent) const {
  return parent.isValid() ? 0 : static_cast<int>(structures_.size());
}

QVariant StructureModel::data(const QModelIndex& index, int role) const {
  if (!index.isValid() || index.row() >= rowCount()) return {};
  const Structure& entry = structure(index.row());
  const double density = densityOf(index.row());
  switch (role) {
    case Qt::DisplayRole:
      return entry.name;
    case Qt::AccessibleTextRole:
      return QStringLiteral("%1, %2, %3%4")
          .arg(entry.name, entry.value, entry.visible ? tr("shown") : tr("hidden"),
               density == 1.0 ? QString() : tr(", %1 times as dense").arg(density));
    case Qt::ToolTipRole:
      return entry.kind == StructureKind::Airways
                 ? tr("Click the eye, or press Space, to show or hide")
                 : tr("Click the eye, or press Space, to show or hide; ] and [ draw it denser or "
                      "fainter");
    case DensityRole:
      return density;
    case Qt::CheckStateRole:
    case VisibleRole:
      return entry.visible ? Qt::Checked : Qt::Unchecked;
    case ValueRole:
      return entry.value;
    case DepthRole:
      return entry.depth;
    case LobeRole:
      return static_cast<int>(entry.lobe);
    case KindRole:
      return static_cast<int>(entry.kind);
    default:
      return {};
  }
}

std::span<const double> StructureModel::densities() {
  static constexpr std::array<double, 5> factors = {0.25, 0.5, 1.0, 2.0, 4.0};
  return factors;
}

int StructureModel::lastBelow(int row) const {
  int last = row;
  while (last + 1 < rowCount() && structure(last + 1).depth > structure(row).depth) ++last;
  return last;
}

double StructureModel::densityOf(int row) const {
  std::optional<double> common;
  for (int i = row; i <= lastBelow(row); ++i) {
    if (structure(i).kind != StructureKind::Surface) continue;
    if (common && *common != structure(i).density) return 1.0;
    common = structure(i).density;
  }
  return common.value_or(1.0);
}

bool StructureModel::setDensity(int row, double density) {
  const auto known = std::ranges::find(densities(), density);
  if (known == densities().end() || structure(row).kind == StructureKind::Airways) return false;
  for (int i = row; i <= lastBelow(row); ++i) {
    Structure& below = structures_[static_cast<std::size_t>(i)];
    if (below.kind == StructureKind::Surface) below.density = density;
  }
  emit dataChanged(index(0), index(rowCount() - 1));
  emit visibilityChanged();
  return true;
}

bool StructureModel::setData(const QModelIndex& index, const QVariant& value, int role) {
  if (!index.isValid()) return false;
  if (role == DensityRole) return setDensity(index.row(), value.toDouble());
  if (role != Qt::CheckStateRole) return false;
  const bool visible = value.toInt() == Qt::Checked;
  const int depth = structure(index.row()).depth;
  const int last = lastBelow(index.row());
  for (int i = index.row(); i <= last; ++i)
    structures_[static_cast<std::size_t>(i)].visible = visible;
  // An opened eye below a shut parent opens the parents too: their lobes are what they show.
  for (int i = index.row(), above = depth; visible && i >= 0; --i) {
    if (structure(i).depth >= above) continue;
    above = structure(i).depth;
    structures_[static_cast<std::size_t>(i)].visible = true;
  }
  emit dataChanged(this->index(0), this->index(rowCount() - 1));
  emit visibilityChanged();
  return true;
}

}  // namespace pneuma
