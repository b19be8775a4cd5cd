#pragma once

#include <QWidget>

class QLabel;

namespace pneuma {

struct Actions;
struct Snapshot;
class SheetCard;

/// Step "Open": ways to open something, and what the mesh doctor says of each file.
class OpenPanel : public QWidget {
  Q_OBJECT

 public:
  explicit OpenPanel(const Actions& actions, QWidget* parent = nullptr);

  void show(const Snapshot& snapshot);

 private:
  QLabel* heading_;
  SheetCard* files_;
};

}  // namespace pneuma
