#include "widgets/efficiency_card.h"

#include <QGridLayout>
#include <QLabel>
#include <QVBoxLayout>
#include <QVariant>

#include "document/efficiency_table.h"

namespace pneuma {

namespace {

QLabel* cell(const QString& text, const QString& tip, const char* role) {
  auto* label = new QLabel(text);
  label->setProperty("role", role);
  label->setToolTip(tip);
  return label;
}

}  // namespace

EfficiencyCard::EfficiencyCard(QWidget* parent) : QFrame(parent) {
  setProperty("role", "card");
  auto* column = new QVBoxLayout(this);
  column->setContentsMargins(10, 5, 10, 6);
  column->setSpacing(4);
  grid_ = new QGridLayout;
  grid_->setHorizontalSpacing(14);
  grid_->setVerticalSpacing(0);
  grid_->setColumnStretch(0, 1);
  column->addLayout(grid_);
  note_ = new QLabel;
  note_->setProperty("role", "dim");
  note_->setWordWrap(true);
  column->addWidget(note_);
}

void EfficiencyCard::show(const EfficiencyTable& table) {
  while (QLayoutItem* item = grid_->takeAt(0)) {
    delete item->widget();
    delete item;
  }
  grid_->addWidget(cell(tr("Efficiency"), {}, "dim"), 0, 0);
  grid_->addWidget(cell(tr("Paper"), table.paperMeaning, "dim"), 0, 1, Qt::AlignRight);
  grid_->addWidget(cell(tr("Today"), table.todayMeaning, "dim"), 0, 2, Qt::AlignRight);
  QStringList lines;
  int line = 1;
  for (const EfficiencyRow& row : table.rows) {
    grid_->addWidget(cell(row.symbol, row.meaning, "small"), line, 0);
    const auto value = [&](const QString& text, int column) {
      QLabel* label = cell(text, row.meaning, "small");
      label->setTextInteractionFlags(Qt::TextSelectableByMouse);
      grid_->addWidget(label, line, column, Qt::AlignRight);
    };
    value(row.paper, 1);
    value(row.today, 2);
    lines << QStringLiteral("%1: %2, %3").arg(row.name, row.paper, row.today);
    ++line;
  }
  note_->setText(table.note);
  lines << table.note;
  text_ = lines.join(QLatin1Char('\n'));
  setAccessibleDescription(text_);
}

}  // namespace pneuma
