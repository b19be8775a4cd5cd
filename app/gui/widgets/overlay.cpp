#include "widgets/overlay.h"

#include <QApplication>
#include <QFrame>
#include <QKeyEvent>
#include <QLineEdit>
#include <QMouseEvent>
#include <QPainter>
#include <QVBoxLayout>

namespace pneuma {

Overlay::Overlay(QWidget* window, const QString& name, const QString& placeholder)
    : QWidget(window) {
  card_ = new QFrame(this);
  card_->setObjectName(name);
  card_->setProperty("role", "overlay");
  column_ = new QVBoxLayout(card_);
  column_->setContentsMargins(12, 12, 12, 10);
  column_->setSpacing(8);
  field_ = new QLineEdit;
  field_->setObjectName(name + QStringLiteral("Search"));
  field_->setPlaceholderText(placeholder);
  field_->setAccessibleName(placeholder);
  field_->setProperty("role", "search");
  column_->addWidget(field_);
  field_->installEventFilter(this);
  window->installEventFilter(this);
  connect(field_, &QLineEdit::textChanged, this, [this](const QString& typed) {
    if (isVisible()) search(typed);
  });
  hide();
}

void Overlay::open() {
  if (!isVisible()) focusBefore_ = QApplication::focusWidget();
  field_->clear();
  search({});
  show();
  arrange();
  raise();
  field_->setFocus();
}

void Overlay::close() {
  hide();
  if (focusBefore_) focusBefore_->setFocus();
}

void Overlay::arrange() {
  setGeometry(parentWidget()->rect());
  card_->setGeometry(place(size()));
}

bool Overlay::eventFilter(QObject* watched, QEvent* event) {
  if (watched == parentWidget() && event->type() == QEvent::Resize && isVisible()) arrange();
  if (watched != field_) return QWidget::eventFilter(watched, event);
  if (event->type() == QEvent::ShortcutOverride) {
    event->accept();  // the keys of the window wait
    return true;
  }
  if (event->type() != QEvent::KeyPress) return QWidget::eventFilter(watched, event);
  const int key = static_cast<QKeyEvent*>(event)->key();
  if (key == Qt::Key_Escape) {
    close();
    return true;
  }
  return keyPressed(key) || QWidget::eventFilter(watched, event);
}

void Overlay::mousePressEvent(QMouseEvent* event) {
  if (!card_->geometry().contains(event->pos())) close();
}

void Overlay::paintEvent(QPaintEvent*) {
  QPainter painter(this);
  painter.fillRect(rect(), QColor(0, 0, 0, 120));
}

}  // namespace pneuma
