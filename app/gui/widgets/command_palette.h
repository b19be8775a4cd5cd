#pragma once

#include <vector>

#include "widgets/commands.h"
#include "widgets/overlay.h"

class QListWidget;

namespace pneuma {

/// Finds what the window can do by a few letters of its name, and does it: Up and Down choose,
/// Return runs. What cannot be done now is there too, and says why.
class CommandPalette : public Overlay {
  Q_OBJECT

 public:
  explicit CommandPalette(QWidget* window);

  /// Opens with these, in their order.
  void offer(std::vector<Command> commands);

 protected:
  void search(const QString& typed) override;
  bool keyPressed(int key) override;
  QRect place(const QSize& window) const override;

 private:
  void run();
  void move(int rows);

  std::vector<Command> commands_;
  std::vector<std::size_t> shown_;  ///< in commands_
  QListWidget* list_;
  QLabel* nothing_;
};

}  // namespace pneuma
