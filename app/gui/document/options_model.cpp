#include "document/options_model.h"

#include <algorithm>

#include "core/error.h"
#include "document/text.h"

namespace pneuma {

namespace {

QString rangeText(const OptionsModel::Row& row) {
  if (!row.choices.empty()) {
    QStringList names;
    for (const auto& choice : row.choices) names << qtText(choice);
    return names.join(QStringLiteral(", "));
  }
  return QStringLiteral("%1 to %2")
      .arg(qtText(textOf(row.range.low)), qtText(textOf(row.range.high)));
}

}  // namespace

std::optional<int> OptionsModel::rowOf(std::string_view name) const {
  const auto found =
      std::find_if(rows_.begin(), rows_.end(), [&](const Row& row) { return row.name == name; });
  if (found == rows_.end()) return std::nullopt;
  return static_cast<int>(found - rows_.begin());
}

int OptionsModel::rowCount(const QModelIndex& parent) const {
  return parent.isValid() ? 0 : static_cast<int>(rows_.size());
}

int OptionsModel::columnCount(const QModelIndex& parent) const {
  return parent.isValid() ? 0 : ColumnCount;
}

QVariant OptionsModel::data(const QModelIndex& index, int role) const {
  if (!index.isValid() || index.row() >= rowCount()) return {};
  const Row& entry = row(index.row());
  if (role == Qt::ToolTipRole) return qtText(entry.help);
  if (role != Qt::DisplayRole && role != Qt::EditRole) return {};
  switch (index.column()) {
    case NameColumn:
      return qtText(entry.name);
    case ValueColumn:
      return qtText(entry.value);
    case UnitColumn:
      return qtText(entry.unit);
    case RangeColumn:
      return rangeText(entry);
    case HelpColumn:
      return qtText(entry.help);
    default:
      return {};
  }
}

QVariant OptionsModel::headerData(int section, Qt::Orientation orientation, int role) const {
  if (orientation != Qt::Horizontal || role != Qt::DisplayRole) return {};
  static const std::vector<QString> titles = {tr("Option"), tr("Value"), tr("Unit"), tr("Range"),
                                              tr("Meaning")};
  const auto column = static_cast<std::size_t>(section);
  return column < titles.size() ? QVariant(titles[column]) : QVariant();
}

Qt::ItemFlags OptionsModel::flags(const QModelIndex& index) const {
  const Qt::ItemFlags usual = QAbstractTableModel::flags(index);
  return index.column() == ValueColumn ? usual | Qt::ItemIsEditable : usual;
}

bool OptionsModel::setData(const QModelIndex& index, const QVariant& value, int role) {
  if (!index.isValid() || index.column() != ValueColumn || role != Qt::EditRole) return false;
  try {
    set_(options_, row(index.row()).name, value.toString().trimmed().toStdString());
  } catch (const InvalidOption& error) {
    emit refused(QString::fromUtf8(error.what()));
    return false;
  }
  rows_ = read_(options_);
  emit dataChanged(index, index);
  return true;
}

}  // namespace pneuma
