#include "widgets/scrolled.h"

#include <QScrollArea>
#include <QVBoxLayout>

namespace pneuma {

QScrollArea* fillScrolling(QWidget* panel, QWidget* content) {
  auto* scroll = new QScrollArea;
  scroll->setWidget(content);
  scroll->setWidgetResizable(true);
  scroll->setFrameShape(QFrame::NoFrame);
  scroll->setHorizontalScrollBarPolicy(Qt::ScrollBarAlwaysOff);
  scroll->setFocusPolicy(Qt::NoFocus);
  auto* whole = new QVBoxLayout(panel);
  whole->setContentsMargins(0, 0, 0, 0);
  whole->addWidget(scroll);
  return scroll;
}

}  // namespace pneuma
