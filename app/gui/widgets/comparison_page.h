#pragma once

#include <QWidget>
#include <array>
#include <memory>
#include <vector>

#include "document/document.h"
#include "render/scene.h"

class QCheckBox;
class QHBoxLayout;
class QLabel;
class QPushButton;
class QTableWidget;

namespace pneuma {

struct Actions;
class LinkedCameras;
class SceneView;

/// Trees of all growth methods beside each other: a 3-D view of each, which turn together, a table
/// of figures beside published ones, and a choice of which tree to keep.
class ComparisonPage : public QWidget {
  Q_OBJECT
  Q_PROPERTY(QString text READ text)
  Q_PROPERTY(QString lookingFrom READ lookingFrom)

 public:
  ComparisonPage(Document& document, const Actions& actions, QWidget* parent = nullptr);
  ~ComparisonPage() override;

  /// Shows the document's comparison.
  /// @pre there is one
  void show(const std::vector<SceneSurface>& surfaces, const SceneOptions& options,
            ViewDirection from);

  /// Lets go of what the views hold.
  void clear();

  /// How the trees look; the same in all views.
  void setOptions(const SceneOptions& options);

  /// The table as lines of "label: value, value, value", for screen readers and scripts.
  QString text() const { return text_; }

  /// From where each view looks, in words.
  QString lookingFrom() const;

 signals:
  void closed();
  void tableWanted();

 protected:
  void resizeEvent(QResizeEvent* event) override;

 private:
  /// One method's view with what is above it.
  struct Column {
    QLabel* title = nullptr;
    QLabel* count = nullptr;
    QPushButton* keep = nullptr;
    SceneView* view = nullptr;
  };

  Column makeColumn(std::size_t method);
  QWidget* makeFoot(const Actions& actions);
  void fillTable();
  static void elideTitle(const Column& column);

  Document& document_;
  QHBoxLayout* row_;
  std::vector<Column> columns_;
  LinkedCameras* linked_ = nullptr;
  QTableWidget* table_;
  QCheckBox* all_;
  QLabel* note_;
  QString text_;
  bool shown_ = false;
};

}  // namespace pneuma
