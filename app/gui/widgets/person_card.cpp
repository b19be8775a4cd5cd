#include "widgets/person_card.h"

#include <QGridLayout>
#include <QLabel>
#include <QPushButton>

#include "document/document.h"
#include "document/text.h"
#include "pipeline/person_motion.h"
#include "widgets/dialogs.h"
#include "widgets/options_form.h"

namespace pneuma {

PersonCard::PersonCard(Document& document, QWidget* parent) : QWidget(parent), document_(document) {
  auto* grid = new QGridLayout(this);
  grid->setContentsMargins(0, 0, 0, 0);
  grid->setHorizontalSpacing(6);
  grid->setVerticalSpacing(5);
  grid->setColumnStretch(1, 1);
  grid->setColumnMinimumWidth(0, FormLabelWidth);
  breath_ = addRow(
      *grid, tr("Breath"),
      tr("A table of seconds, pressure and volume of one breath, to which the equation of pressure "
         "and volume is fitted (Santhanam 2008)"),
      QStringLiteral("MeasuredBreath"),
      [this](const std::filesystem::path& path) { document_.openMeasuredBreath(path); },
      tr("Measured breaths (*.csv)"));
  connect(breath_.forget, &QPushButton::clicked, this,
          [this] { document_.forgetMeasuredBreath(); });
  constants_ = addRow(
      *grid, tr("Constants"),
      tr("Constants that 'pneuma estimate' fitted to landmarks in two scans of this person"),
      QStringLiteral("Constants"),
      [this](const std::filesystem::path& path) { document_.openConstants(path); },
      tr("Fitted constants (*.json)"));
  connect(constants_.forget, &QPushButton::clicked, this, [this] { document_.forgetConstants(); });
  follow();
}

PersonCard::Row PersonCard::addRow(QGridLayout& grid, const QString& label, const QString& tip,
                                   const QString& suffix,
                                   std::function<void(const std::filesystem::path&)> read,
                                   const QString& filter) {
  const int at = grid.rowCount();
  auto* name = new QLabel(label);
  name->setProperty("role", "dim");
  Row row;
  row.value = new QLabel;
  row.value->setObjectName(QStringLiteral("used") + suffix);
  row.value->setAccessibleName(label);
  row.value->setWordWrap(true);
  row.open = new QPushButton(tr("Open..."));
  row.open->setObjectName(QStringLiteral("open") + suffix);
  row.open->setToolTip(tip);
  row.open->setProperty("role", "quiet");
  connect(row.open, &QPushButton::clicked, this, [this, label, filter, read = std::move(read)] {
    askForFile(window(), label, {filter, tr("All files (*)")},
               [read](const QString& file) { read(std::filesystem::path(file.toStdString())); });
  });
  row.forget = new QPushButton(tr("Give up"));
  row.forget->setObjectName(QStringLiteral("forget") + suffix);
  row.forget->setToolTip(tr("Breathe as the scenario says again"));
  row.forget->setProperty("role", "quiet");
  grid.addWidget(name, at, 0);
  grid.addWidget(row.value, at, 1);
  grid.addWidget(row.open, at, 2);
  grid.addWidget(row.forget, at, 2);  // one of the two is there
  return row;
}

void PersonCard::follow() {
  const BreatheOptions& options = document_.breatheOptions();
  const QString none = tr("the scenario's");
  breath_.value->setText(options.fit ? tr("%1 in %2")
                                           .arg(withUnit(1000.0 * options.fit->tidal, 0, "mL"),
                                                withUnit(options.fit->period, 2, "s"))
                                     : none);
  breath_.value->setToolTip(
      options.fit
          ? tr("Fitted to %1 % of the breath's volume").arg(100.0 * options.fit->rms, 0, 'f', 2)
          : QString());
  constants_.value->setText(options.person ? qtText(options.person->name) : none);
  constants_.value->setToolTip(options.person ? qtText(basisOf(*options.person)) : QString());
  for (const auto& [row, has] :
       {std::pair{&breath_, options.fit != nullptr}, {&constants_, options.person != nullptr}}) {
    row->open->setVisible(!has);
    row->forget->setVisible(has);
  }
}

}  // namespace pneuma
