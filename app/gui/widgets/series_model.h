#pragma once

#include <QAbstractTableModel>
#include <QPixmap>
#include <vector>

#include "document/series_list.h"

namespace pneuma {

/// A series list as a table: a row per series, its picture as soon as that is drawn.
class SeriesModel : public QAbstractTableModel {
  Q_OBJECT

 public:
  enum Column { Picture, Description, Modality, Slices, Spacing, Size, Kernel, Why, ColumnCount };

  /// Logical pixels of the longer side of a picture.
  static constexpr int PictureSize = 64;

  using QAbstractTableModel::QAbstractTableModel;

  void show(const SeriesList& list);

  /// Nothing happens if another list is shown by now.
  void setPicture(const SeriesList& of, int row, const pneuma::Picture& picture);

  const SeriesList& list() const { return list_; }

  int rowCount(const QModelIndex& parent = {}) const override;
  int columnCount(const QModelIndex& parent = {}) const override;
  QVariant data(const QModelIndex& index, int role) const override;
  QVariant headerData(int section, Qt::Orientation orientation, int role) const override;

 private:
  SeriesList list_;
  std::vector<QPixmap> pictures_;
};

}  // namespace pneuma
