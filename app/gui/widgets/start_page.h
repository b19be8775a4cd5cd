#pragma once

#include <QWidget>

namespace pneuma {

struct Actions;

/// What the window shows before anything is open: where to drop, what to press.
class StartPage : public QWidget {
  Q_OBJECT

 public:
  explicit StartPage(const Actions& actions, QWidget* parent = nullptr);
};

}  // namespace pneuma
