#pragma once

#include <QListView>

namespace pneuma {

/// The list of structures: an eye, the colour it is drawn in, name, how dense it is drawn if not as
/// usual, and size. A click on the eye, or Space, shows or hides; ] and [, or the menu of a row,
/// draw it denser or fainter; a click on the row selects.
class StructureView : public QListView {
  Q_OBJECT

 public:
  explicit StructureView(QWidget* parent = nullptr);

  void setModel(QAbstractItemModel* model) override;

  QSize sizeHint() const override;

  QSize minimumSizeHint() const override { return sizeHint(); }

 protected:
  void mousePressEvent(QMouseEvent* event) override;
  void keyPressEvent(QKeyEvent* event) override;
  void contextMenuEvent(QContextMenuEvent* event) override;

 private:
  /// @param steps through the densities that there are; 0: as usual
  void makeDenser(const QModelIndex& index, int steps);
  void toggle(const QModelIndex& index);
};

}  // namespace pneuma
