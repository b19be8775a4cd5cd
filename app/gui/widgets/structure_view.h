#pragma once

#include <QListView>

namespace pneuma {

/// The list of structures: an eye, the colour it is drawn in, name and size. A click on the eye, or
/// Space, shows or hides; a click on the row selects.
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

 private:
  void toggle(const QModelIndex& index);
};

}  // namespace pneuma
