#include "widgets/room.h"

#include <QResizeEvent>
#include <QWidget>
#include <vector>

namespace pneuma {

namespace {

class NarrowBar : public QObject {
 public:
  NarrowBar(QWidget* bar, std::initializer_list<QWidget*> parts, int width)
      : QObject(bar), parts_(parts), width_(width) {
    bar->installEventFilter(this);
  }

 protected:
  bool eventFilter(QObject* watched, QEvent* event) override {
    if (event->type() == QEvent::Resize) {
      const bool room = static_cast<QResizeEvent*>(event)->size().width() >= width_;
      for (QWidget* part : parts_) part->setVisible(room);
    }
    return QObject::eventFilter(watched, event);
  }

 private:
  std::vector<QWidget*> parts_;
  int width_;
};

}  // namespace

void hideWhenNarrow(QWidget* bar, std::initializer_list<QWidget*> parts, int width) {
  new NarrowBar(bar, parts, width);
}

}  // namespace pneuma
