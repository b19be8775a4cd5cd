#include "widgets/error_card.h"

#include <QAction>
#include <QApplication>
#include <QClipboard>
#include <QEvent>
#include <QHBoxLayout>
#include <QLabel>
#include <QPushButton>
#include <QVBoxLayout>
#include <QVariant>
#include <algorithm>

#include "document/text.h"

namespace pneuma {

namespace {

constexpr int DistanceFromTop = 56;  // below the bar of the 3-D view

}  // namespace

ErrorCard::ErrorCard(QWidget* parent) : QFrame(parent) {
  setObjectName(QStringLiteral("errorCard"));
  setAttribute(Qt::WA_StyledBackground);
  auto* column = new QVBoxLayout(this);
  column->setContentsMargins(16, 12, 16, 12);
  column->setSpacing(8);
  title_ = new QLabel;
  title_->setObjectName(QStringLiteral("errorTitle"));
  title_->setTextFormat(Qt::PlainText);
  sentence_ = new QLabel;
  sentence_->setObjectName(QStringLiteral("errorSentence"));
  sentence_->setTextFormat(Qt::PlainText);
  sentence_->setWordWrap(true);
  sentence_->setTextInteractionFlags(Qt::TextSelectableByMouse);
  auto* buttons = new QHBoxLayout;
  copy_ = new QPushButton(tr("Copy text"));
  copy_->setObjectName(QStringLiteral("errorCopy"));
  auto* dismiss = new QPushButton(tr("Close"));
  dismiss->setObjectName(QStringLiteral("errorClose"));
  help_ = new QPushButton;
  help_->setObjectName(QStringLiteral("errorHelp"));
  help_->setProperty("role", "primary");
  help_->setAccessibleName(tr("What helps"));
  buttons->addStretch();
  buttons->addWidget(help_);
  buttons->addWidget(copy_);
  buttons->addWidget(dismiss);
  column->addWidget(title_);
  column->addWidget(sentence_);
  column->addLayout(buttons);
  connect(dismiss, &QPushButton::clicked, this, &QWidget::hide);
  connect(copy_, &QPushButton::clicked, this, [this] {
    QApplication::clipboard()->setText(title_->text() + QStringLiteral(": ") + sentence_->text());
  });
  connect(help_, &QPushButton::clicked, this, [this] {
    if (action_ != nullptr) action_->trigger();
  });
  parent->installEventFilter(this);
  hide();
}

void ErrorCard::show(const QString& title, const QString& sentence, QAction& help) {
  show(title, sentence);
  action_ = &help;
  help_->setText(help.text().remove(QLatin1Char('&')));
  help_->setAccessibleName(help_->text());
  help_->show();
  place();
}

void ErrorCard::show(const QString& title, const QString& sentence) {
  action_ = nullptr;
  help_->hide();
  title_->setText(title);
  sentence_->setText(capitalised(sentence.toStdString()));
  setAccessibleName(tr("Problem: %1").arg(title));
  setAccessibleDescription(sentence);
  place();
  QFrame::show();
  raise();
}

void ErrorCard::place() {
  const int width = std::min(560, parentWidget()->width() - 48);
  setFixedWidth(width);
  sentence_->setFixedHeight(sentence_->heightForWidth(width - 34));
  layout()->activate();  // or a long sentence before leaves its height
  adjustSize();
  move((parentWidget()->width() - width) / 2, DistanceFromTop);
}

bool ErrorCard::eventFilter(QObject* watched, QEvent* event) {
  if (watched == parentWidget() && event->type() == QEvent::Resize && isVisible()) place();
  return QFrame::eventFilter(watched, event);
}

}  // namespace pneuma
