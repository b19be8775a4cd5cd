#pragma once

#include <QAbstractListModel>
#include <optional>
#include <span>
#include <vector>

#include "document/snapshot.h"

namespace pneuma {

/// What there is to see: lungs, right and left, their lobes with volumes, the airways. A flat list
/// with a depth, because nothing is ever folded; a parent's eye opens and shuts those below it.
class StructureModel : public QAbstractListModel {
  Q_OBJECT

 public:
  enum class Kind { Lungs, Side, Surface, Airways };

  struct Structure {
    Kind kind = Kind::Lungs;
    int depth = 0;
    QString name;
    QString value;
    pneuma::Side side = pneuma::Side::None;
    Lobe lobe = Lobe::Whole;
    std::size_t surface = 0;  ///< index in the model's surfaces, for Kind::Surface
    bool visible = true;
    double density = 1.0;  ///< one of densities(), times how dense all surfaces are drawn
  };

  enum Role {
    ValueRole = Qt::UserRole + 1,
    DepthRole,
    VisibleRole,
    LobeRole,
    KindRole,
    DensityRole
  };

  /// How much denser a surface can be drawn than it is usual, from faint to dense; 1 among them.
  static std::span<const double> densities();

  using QAbstractListModel::QAbstractListModel;

  /// Shows another snapshot; eyes keep their state where the structure is still there.
  void show(const Snapshot& snapshot);

  const Structure& structure(int row) const { return structures_[static_cast<std::size_t>(row)]; }

  std::optional<int> rowOfSurface(std::size_t surface) const;
  std::optional<int> rowOfAirways() const;

  int rowCount(const QModelIndex& parent = {}) const override;
  QVariant data(const QModelIndex& index, int role) const override;

  /// Qt::CheckStateRole opens or shuts the eye of a row and of those below it, DensityRole sets how
  /// dense its surface and those below it are drawn.
  bool setData(const QModelIndex& index, const QVariant& value, int role) override;

 signals:
  /// Some eye was opened or shut, or some surface is drawn denser or fainter.
  void visibilityChanged();

 private:
  /// The last row below this one.
  int lastBelow(int row) const;

  /// Its own, or that of all below it where they agree.
  double densityOf(int row) const;
  bool setDensity(int row, double density);

  std::vector<Structure> structures_;
};

}  // namespace pneuma
