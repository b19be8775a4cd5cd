#pragma once

#include <QDialog>

#include "widgets/actions.h"
#include "widgets/mouse_profile.h"

namespace pneuma {

/// What is chosen once, at the first start: the look and the habits of the mouse, both of which the
/// menu View changes later. What is pressed acts at once, by the window's actions.
class WelcomeDialog : public QDialog {
  Q_OBJECT

 public:
  explicit WelcomeDialog(const Actions& actions, QWidget* parent = nullptr);

 private:
  QWidget* makeLooks(const Actions& actions);
  QWidget* makeMice(const Actions& actions);
};

}  // namespace pneuma
