#pragma once

#include <QWidget>
#include <vector>

class QGridLayout;

namespace pneuma {

struct Actions;

/// What the window shows before anything is open: where to drop, what to press.
class StartPage : public QWidget {
  Q_OBJECT

 public:
  explicit StartPage(const Actions& actions, QWidget* parent = nullptr);

 protected:
  void resizeEvent(QResizeEvent* event) override;

 private:
  /// Puts the buttons into rows of so many.
  void arrange(int columns);

  QGridLayout* buttons_;
  std::vector<QWidget*> ways_;  ///< to open something
  int columns_ = 0;
};

}  // namespace pneuma
