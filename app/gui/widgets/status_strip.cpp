#include "widgets/status_strip.h"

#include <QHBoxLayout>
#include <QLabel>
#include <QProgressBar>
#include <QPushButton>
#include <QToolButton>
#include <QVBoxLayout>
#include <QVariant>
#include <algorithm>
#include <utility>

#include "document/job_queue.h"
#include "document/text.h"
#include "widgets/actions.h"
#include "widgets/icons.h"

namespace pneuma {

StatusStrip::StatusStrip(const JobQueue& jobs, const Actions& actions, QWidget* parent)
    : QFrame(parent) {
  setObjectName(QStringLiteral("statusStrip"));
  setFixedHeight(34);
  auto* row = new QHBoxLayout(this);
  row->setContentsMargins(14, 0, 10, 0);
  row->setSpacing(10);

  message_ = new QLabel;
  message_->setObjectName(QStringLiteral("statusMessage"));
  message_->setAccessibleName(tr("Status"));
  message_->setSizePolicy(QSizePolicy::Ignored, QSizePolicy::Preferred);
  job_ = new QLabel;
  job_->setObjectName(QStringLiteral("jobTitle"));
  job_->setProperty("role", "dim");
  bar_ = new QProgressBar;
  bar_->setObjectName(QStringLiteral("jobProgress"));
  bar_->setAccessibleName(tr("Progress of the running job"));
  bar_->setRange(0, 1000);
  bar_->setTextVisible(false);
  bar_->setFixedWidth(160);
  cancel_ = new QToolButton;
  cancel_->setObjectName(QStringLiteral("cancelJob"));
  cancel_->setDefaultAction(actions.cancel);
  cancel_->setProperty("role", "quiet");
  cancel_->setToolTip(tr("Cancel (Esc)"));
  cancel_->setAccessibleName(tr("Cancel the running job"));
  warningButton_ = new QPushButton;
  warningButton_->setObjectName(QStringLiteral("warnings"));
  warningButton_->setProperty("role", "warning");
  row->addWidget(message_, 1);
  row->addWidget(job_);
  row->addWidget(bar_);
  row->addWidget(cancel_);
  row->addWidget(warningButton_);
  connect(warningButton_, &QPushButton::clicked, this, &StatusStrip::showWarnings);
  connect(&jobs, &JobQueue::busyChanged, this, &StatusStrip::showJob);
  connect(&jobs, &JobQueue::progressed, this, &StatusStrip::showProgress);
  showJob(false);
  setWarnings({});
}

void StatusStrip::say(const QString& sentence) {
  sentence_ = sentence;
  updateMessage();
}

void StatusStrip::probe(const QString& text) {
  probe_ = text;
  updateMessage();
}

void StatusStrip::updateMessage() { message_->setText(probe_.isEmpty() ? sentence_ : probe_); }

void StatusStrip::showJob(bool busy) {
  for (QWidget* widget :
       {static_cast<QWidget*>(job_), static_cast<QWidget*>(bar_), static_cast<QWidget*>(cancel_)}) {
    widget->setVisible(busy);
  }
  if (!busy) return;
  job_->setText({});
  bar_->setValue(0);
}

void StatusStrip::showProgress(const QString& title, double fraction, const QString& what) {
  const int percent = static_cast<int>(100.0 * fraction);
  const QString step = what.isEmpty() ? QString() : QStringLiteral(": ") + what;
  job_->setText(QStringLiteral("%1%2   %3 %").arg(title, step).arg(percent));
  bar_->setValue(static_cast<int>(1000.0 * fraction));
}

void StatusStrip::setWarnings(std::vector<QString> warnings) {
  warnings_ = std::move(warnings);
  warningButton_->setVisible(!warnings_.empty());
  warningButton_->setText(counted(warnings_.size(), "warning", "warnings"));
  warningButton_->setToolTip(tr("Show what to look at"));
}

void StatusStrip::showWarnings() {
  auto* list = new QFrame(this, Qt::Popup);
  list->setObjectName(QStringLiteral("warningList"));
  list->setAttribute(Qt::WA_DeleteOnClose);
  auto* column = new QVBoxLayout(list);
  column->setContentsMargins(14, 12, 14, 12);
  column->setSpacing(8);
  for (const QString& warning : warnings_) {
    auto* line = new QLabel(warning);
    line->setWordWrap(true);
    line->setTextFormat(Qt::PlainText);
    line->setFixedWidth(420);
    column->addWidget(line);
  }
  list->adjustSize();
  const QPoint corner = mapToGlobal(QPoint(width() - list->width() - 8, -list->height() - 6));
  list->move(std::max(0, corner.x()), std::max(0, corner.y()));
  list->show();
}

}  // namespace pneuma
