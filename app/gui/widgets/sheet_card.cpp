#include "widgets/sheet_card.h"

#include <QGridLayout>
#include <QHBoxLayout>
#include <QLabel>
#include <QPainter>
#include <QVBoxLayout>
#include <QVariant>

#include "widgets/theme.h"

namespace pneuma {

namespace {

/// The answer to a check: a tick or an exclamation mark, told apart without colour.
class CheckMark : public QWidget {
 public:
  explicit CheckMark(bool good) : good_(good) { setFixedSize(16, 16); }

 protected:
  void paintEvent(QPaintEvent*) override {
    const Theme& theme = currentTheme();
    QPainter painter(this);
    painter.setRenderHint(QPainter::Antialiasing);
    painter.setPen(Qt::NoPen);
    painter.setBrush(good_ ? theme.good : theme.look);
    painter.drawRoundedRect(QRectF(1, 1, 14, 14), 4, 4);
    painter.setPen(QPen(theme.card, 1.8, Qt::SolidLine, Qt::RoundCap, Qt::RoundJoin));
    if (good_) {
      painter.drawPolyline(QPolygonF({{4.6, 8.2}, {7.0, 10.6}, {11.4, 5.4}}));
    } else {
      painter.drawLine(QPointF(8, 4.4), QPointF(8, 8.6));
      painter.drawPoint(QPointF(8, 11.6));
    }
  }

 private:
  bool good_;
};

QLabel* label(const QString& text, const char* role) {
  auto* made = new QLabel(text);
  if (role != nullptr) made->setProperty("role", role);
  return made;
}

}  // namespace

SheetCard::SheetCard(QWidget* parent) : QFrame(parent) {
  setProperty("role", "card");
  auto* column = new QVBoxLayout(this);
  column->setContentsMargins(12, 9, 12, 10);
  column->setSpacing(7);
  auto* top = new QHBoxLayout;
  headline_ = label({}, "headline");
  note_ = label({}, "dim");
  top->addWidget(headline_);
  top->addStretch();
  top->addWidget(note_, 0, Qt::AlignBottom);
  column->addLayout(top);
  rows_ = new QGridLayout;
  rows_->setHorizontalSpacing(8);
  rows_->setVerticalSpacing(4);
  rows_->setColumnStretch(1, 1);
  column->addLayout(rows_);
}

void SheetCard::show(const PropertySheet& sheet) {
  headline_->setText(sheet.headline);
  headline_->setVisible(!sheet.headline.isEmpty());
  note_->setText(sheet.note);
  note_->setVisible(!sheet.note.isEmpty());
  while (QLayoutItem* item = rows_->takeAt(0)) {
    delete item->widget();
    delete item;
  }
  QStringList lines;
  if (!sheet.headline.isEmpty()) lines << sheet.headline + QStringLiteral(" ") + sheet.note;
  int line = 0;
  for (const PropertyRow& row : sheet.rows) {
    const bool isCheck = row.kind != PropertyRow::Kind::Figure;
    if (isCheck) {
      rows_->addWidget(new CheckMark(row.kind == PropertyRow::Kind::Good), line, 0);
      QLabel* what = label(row.label, nullptr);
      what->setWordWrap(row.kind == PropertyRow::Kind::Look);
      rows_->addWidget(what, line, 1, 1, row.value.isEmpty() ? 2 : 1);
    } else {
      rows_->addWidget(label(row.label, "dim"), line, 0, 1, 2);
    }
    if (!row.value.isEmpty()) {
      auto* value = label(row.value, isCheck ? "dim" : nullptr);
      value->setTextInteractionFlags(Qt::TextSelectableByMouse);
      rows_->addWidget(value, line, 2, Qt::AlignRight);
    }
    const char* answer = row.kind == PropertyRow::Kind::Look ? "look: " : isCheck ? "good: " : "";
    lines << QString::fromUtf8(answer) + row.label +
                 (row.value.isEmpty() ? QString() : QStringLiteral(": ") + row.value);
    ++line;
  }
  // A layout would show them only later, and until then the card would have no height.
  for (int i = 0; i < rows_->count(); ++i) rows_->itemAt(i)->widget()->show();
  text_ = lines.join(QLatin1Char('\n'));
  setAccessibleDescription(text_);
}

}  // namespace pneuma
