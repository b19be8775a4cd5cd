#include "widgets/series_model.h"

#include <QFont>
#include <QImage>
#include <algorithm>
#include <utility>

#include "widgets/theme.h"

namespace pneuma {

namespace {

QString textOf(const SeriesRow& row, int column) {
  switch (column) {
    case SeriesModel::Description:
      return row.opened ? SeriesModel::tr("%1 (open now)").arg(row.description) : row.description;
    case SeriesModel::Modality:
      return row.modality;
    case SeriesModel::Slices:
      return row.slices;
    case SeriesModel::Spacing:
      return row.spacing;
    case SeriesModel::Size:
      return row.size;
    case SeriesModel::Kernel:
      return row.kernel.isEmpty() ? QStringLiteral("-") : row.kernel;
    case SeriesModel::Why:
      return row.why;
    default:
      return {};
  }
}

}  // namespace

void SeriesModel::show(const SeriesList& list) {
  beginResetModel();
  list_ = list;
  pictures_.assign(list.rows.size(), QPixmap());
  endResetModel();
}

void SeriesModel::setPicture(const SeriesList& of, int row, const pneuma::Picture& picture) {
  if (of.series != list_.series || picture.rgb.empty()) return;
  const QImage image(picture.rgb.data(), picture.width, picture.height, 3 * picture.width,
                     QImage::Format_RGB888);
  QPixmap pixmap = QPixmap::fromImage(image.copy());
  pixmap.setDevicePixelRatio(std::max(picture.width, picture.height) /
                             static_cast<double>(PictureSize));
  pictures_[static_cast<std::size_t>(row)] = std::move(pixmap);
  emit dataChanged(index(row, Picture), index(row, Picture), {Qt::DecorationRole});
}

int SeriesModel::rowCount(const QModelIndex& parent) const {
  return parent.isValid() ? 0 : static_cast<int>(list_.rows.size());
}

int SeriesModel::columnCount(const QModelIndex& parent) const {
  return parent.isValid() ? 0 : ColumnCount;
}

QVariant SeriesModel::data(const QModelIndex& index, int role) const {
  if (!index.isValid()) return {};
  const auto i = static_cast<std::size_t>(index.row());
  const SeriesRow& row = list_.rows[i];
  switch (role) {
    case Qt::DisplayRole:
      return textOf(row, index.column());
    case Qt::DecorationRole:
      if (index.column() != Picture || pictures_[i].isNull()) return {};
      return pictures_[i];
    case Qt::ToolTipRole:
      return index.column() == Picture ? QVariant(tr("The slice in the middle"))
                                       : QVariant(row.why);
    case Qt::AccessibleTextRole:
      return index.column() == Picture ? tr("The slice in the middle of %1").arg(row.description)
                                       : textOf(row, index.column());
    case Qt::TextAlignmentRole:
      return static_cast<int>(Qt::AlignVCenter | Qt::AlignLeft);
    case Qt::ForegroundRole:
      return row.canOpen() ? currentTheme().text : currentTheme().dim;
    case Qt::FontRole: {
      if (index.column() != Description || row.use != SeriesRow::Use::Recommended) return {};
      QFont bold;
      bold.setWeight(QFont::DemiBold);
      return bold;
    }
    default:
      return {};
  }
}

QVariant SeriesModel::headerData(int section, Qt::Orientation orientation, int role) const {
  if (orientation != Qt::Horizontal || role != Qt::DisplayRole) return {};
  switch (section) {
    case Picture:
      return tr("Middle");
    case Description:
      return tr("Series");
    case Modality:
      return tr("Kind");
    case Slices:
      return tr("Slices");
    case Spacing:
      return tr("Apart / thick, mm");
    case Size:
      return tr("Voxels");
    case Kernel:
      return tr("Kernel");
    default:
      return tr("Why");
  }
}

}  // namespace pneuma
