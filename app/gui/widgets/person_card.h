#pragma once

#include <QString>
#include <QWidget>
#include <filesystem>
#include <functional>

class QGridLayout;
class QPushButton;
class QToolButton;

namespace pneuma {

class Document;

/// What was measured of the person who breathes: a breath of pressure and volume, and the constants
/// of the motion. Each is read from a file, and given up for the scenario's again.
class PersonCard : public QWidget {
  Q_OBJECT

 public:
  explicit PersonCard(Document& document, QWidget* parent = nullptr);

  /// Shows what the document has.
  void follow();

 private:
  struct Row {
    QPushButton* open = nullptr;  ///< says what is used
    QToolButton* forget = nullptr;
    QString tip;  ///< what can be opened
  };

  /// @param suffix of object names: open<suffix>, forget<suffix>
  Row addRow(QGridLayout& grid, const QString& label, const QString& tip, const QString& suffix,
             std::function<void(const std::filesystem::path&)> read, const QString& filter);

  /// @param used empty: nothing is
  void show(const Row& row, const QString& used, const QString& about);

  Document& document_;
  Row breath_;
  Row constants_;
};

}  // namespace pneuma
