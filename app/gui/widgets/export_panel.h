#pragma once

#include <QWidget>
#include <array>

#include "document/export_list.h"

class QButtonGroup;
class QCheckBox;
class QComboBox;
class QLabel;

namespace pneuma {

struct Actions;
class Document;

/// Step "Export": what the case is exported for, each with what it keeps or what is missing; the
/// tree alone in a format; the project.
class ExportPanel : public QWidget {
  Q_OBJECT

 public:
  ExportPanel(Document& document, const Actions& actions, QWidget* parent = nullptr);

  /// What is chosen, whether or not the case has it.
  ExportKind kind() const;

  /// Why what is chosen cannot be exported; empty if it can.
  QString lack() const { return rows_[static_cast<std::size_t>(kind())].lack; }

  /// True if the report may name the case and its files.
  bool identify() const;

  /// Of the preset that is chosen; empty where it has no choice.
  QString presetFormat() const;

  /// Of the tree alone: "vtp", "swc", "csv" or "json"
  QString format() const;

 signals:
  void kindChanged();

 private:
  void follow();
  void offerFormats();
  void showKeeps();
  QWidget* makeKinds();
  QWidget* makeFormats();

  Document& document_;
  std::vector<ExportRow> rows_;
  QButtonGroup* kinds_;
  std::array<QLabel*, ExportKinds> notes_{};
  QComboBox* presetFormat_;
  QCheckBox* identify_;
  QButtonGroup* formats_;
  QLabel* keeps_;
};

}  // namespace pneuma
