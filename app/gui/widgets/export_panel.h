#pragma once

#include <QWidget>

class QButtonGroup;

namespace pneuma {

struct Actions;

/// Step "Export": the format with what it keeps and loses, and the two things that can be saved.
class ExportPanel : public QWidget {
  Q_OBJECT

 public:
  explicit ExportPanel(const Actions& actions, QWidget* parent = nullptr);

  /// "vtp", "swc", "csv" or "json"
  QString format() const;

 private:
  QButtonGroup* formats_;
};

}  // namespace pneuma
