#include "widgets/tour_card.h"

#include <QEvent>
#include <QHBoxLayout>
#include <QKeyEvent>
#include <QLabel>
#include <QPushButton>
#include <QVBoxLayout>
#include <QVariant>
#include <algorithm>

namespace pneuma {

namespace {

constexpr int CardWidth = 380;
constexpr int Apart = 14;

}  // namespace

TourCard::TourCard(QWidget* window) : QFrame(window), frame_(new QFrame(window)) {
  setObjectName(QStringLiteral("tourCard"));
  setProperty("role", "overlay");
  setAttribute(Qt::WA_StyledBackground);
  setFixedWidth(CardWidth);
  frame_->setObjectName(QStringLiteral("tourFrame"));
  frame_->setAttribute(Qt::WA_TransparentForMouseEvents);
  auto* column = new QVBoxLayout(this);
  column->setContentsMargins(18, 16, 18, 14);
  column->setSpacing(12);
  text_ = new QLabel;
  text_->setObjectName(QStringLiteral("tourText"));
  text_->setTextFormat(Qt::PlainText);
  text_->setWordWrap(true);
  column->addWidget(text_);
  auto* row = new QHBoxLayout;
  count_ = new QLabel;
  count_->setObjectName(QStringLiteral("tourCount"));
  count_->setProperty("role", "dim");
  leave_ = new QPushButton(tr("Leave the tour"));
  leave_->setObjectName(QStringLiteral("tourLeave"));
  next_ = new QPushButton;
  next_->setObjectName(QStringLiteral("tourNext"));
  next_->setProperty("role", "primary");
  row->addWidget(count_);
  row->addStretch();
  row->addWidget(leave_);
  row->addWidget(next_);
  column->addLayout(row);
  window->installEventFilter(this);
  connect(next_, &QPushButton::clicked, this, &TourCard::next);
  connect(leave_, &QPushButton::clicked, this, &TourCard::left);
}

TourCard::~TourCard() { delete frame_; }

void TourCard::tell(QWidget* about, const QString& text, int number, int count) {
  if (about_ != nullptr) about_->removeEventFilter(this);
  about_ = about;
  about->installEventFilter(this);
  text_->setText(text);
  count_->setText(tr("%1 of %2").arg(number).arg(count));
  next_->setText(number < count ? tr("Next") : tr("Done"));
  next_->setEnabled(true);
  leave_->setVisible(number < count);
  arrange();
  next_->setFocus();
}

void TourCard::waitFor(const QString& what) {
  text_->setText(what);
  next_->setEnabled(false);
  arrange();
}

void TourCard::arrange() {
  const QRect room = parentWidget()->rect().adjusted(Apart, Apart, -Apart, -Apart);
  const int height = heightForWidth(CardWidth);
  QRect card(0, 0, CardWidth, height > 0 ? height : sizeHint().height());
  if (about_ != nullptr && about_->isVisible()) {
    const QRect there(about_->mapTo(parentWidget(), QPoint()), about_->size());
    frame_->setGeometry(there.adjusted(-3, -3, 3, 3).intersected(parentWidget()->rect()));
    // To the right of it, else to the left, else in its lower part.
    card.moveTopLeft({there.right() + Apart, there.top()});
    if (card.right() > room.right()) card.moveRight(there.left() - Apart);
    if (card.left() < room.left()) {
      card.moveCenter({there.center().x(), there.bottom() - card.height()});
    }
    frame_->show();
    frame_->raise();
  } else {
    card.moveCenter(room.center());
    frame_->hide();
  }
  card.moveLeft(std::clamp(card.left(), room.left(), room.right() - card.width()));
  card.moveTop(
      std::clamp(card.top(), room.top(), std::max(room.top(), room.bottom() - card.height())));
  setGeometry(card);
  show();
  raise();
}

bool TourCard::eventFilter(QObject* watched, QEvent* event) {
  // What the card tells of may find its size later.
  const bool moved = event->type() == QEvent::Resize || event->type() == QEvent::Move;
  if (moved && isVisible()) arrange();
  return QFrame::eventFilter(watched, event);
}

void TourCard::keyPressEvent(QKeyEvent* event) {
  if (event->key() == Qt::Key_Escape) {
    emit left();
  } else {
    QFrame::keyPressEvent(event);
  }
}

}  // namespace pneuma
