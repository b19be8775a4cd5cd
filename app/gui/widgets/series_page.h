#pragma once

#include <QWidget>

#include "widgets/series_model.h"

class QCheckBox;
class QLabel;
class QPushButton;
class QTableView;

namespace pneuma {

/// The series of a folder, to choose one of: a table, why the selected one suits lungs or does not,
/// and buttons. It stands where the views stand, and nothing waits for it.
class SeriesPage : public QWidget {
  Q_OBJECT

 public:
  explicit SeriesPage(QWidget* parent = nullptr);

  void show(const SeriesList& list);

  /// Forgets the list, and with it what was taken out of an archive.
  void clear();

  SeriesModel& model() { return model_; }

 signals:
  /// @param fillGaps missing slices are to be interpolated
  void chosen(const pneuma::SeriesList& list, int row, bool fillGaps);

  /// Nothing is to be opened.
  void left();

 protected:
  bool eventFilter(QObject* watched, QEvent* event) override;

 private:
  void follow();
  void open();
  void fitColumns();

  SeriesModel model_;
  QLabel* sentence_;
  QTableView* table_;
  QLabel* why_;
  QCheckBox* fill_;
  QPushButton* open_;
};

}  // namespace pneuma
