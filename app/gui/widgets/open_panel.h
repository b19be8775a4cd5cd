#pragma once

#include <QWidget>

class QLabel;
class QPushButton;

namespace pneuma {

struct Actions;
class Document;
class SheetCard;

/// Step "Open": ways to open something, and what the mesh doctor says of each file.
class OpenPanel : public QWidget {
  Q_OBJECT

 public:
  explicit OpenPanel(const Actions& actions, QWidget* parent = nullptr);

  void show(const Document& document);

 private:
  QLabel* heading_;
  SheetCard* files_;
  QPushButton* otherSeries_;
  QPushButton* locate_;
};

}  // namespace pneuma
