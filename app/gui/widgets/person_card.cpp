#include "widgets/person_card.h"

#include <QGridLayout>
#include <QLabel>
#include <QPushButton>
#include <QToolButton>
#include <tuple>

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
  grid->setColumnMinimumWidth(0, NarrowLabelWidth);
  breath_ = addRow(
      *grid, tr("Breath"),
      tr("A table of seconds, pressure and volume of one breath, to which the equation of pressure "
         "and volume is fitted (Santhanam 2008)"),
      QStringLiteral("MeasuredBreath"),
      [this](const std::filesystem::path& path) { document_.openMeasuredBreath(path); },
      tr("Measured breaths (*.csv)"));
  connect(breath_.forget, &QToolButton::clicked, this,
          [this] { document_.forgetMeasuredBreath(); });
  constants_ = addRow(
      *grid, tr("Constants"),
      tr("Constants that 'pneuma estimate' fitted to landmarks in two scans of this person"),
      QStringLiteral("Constants"),
      [this](const std::filesystem::path& path) { document_.openConstants(path); },
      tr("Fitted constants (*.json)"));
  connect(constants_.forget, &QToolButton::clicked, this, [this] { document_.forgetConstants(); });
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
  row.open = new QPushButton;
  row.open->setObjectName(QStringLiteral("open") + suffix);
  row.open->setAccessibleName(label);
  row.open->setSizePolicy(QSizePolicy::Ignored, QSizePolicy::Fixed);
  name->setBuddy(row.open);
  name->setToolTip(tip);
  connect(row.open, &QPushButton::clicked, this, [this, label, filter, read = std::move(read)] {
    askForFile(window(), label, {filter, tr("All files (*)")},
               [read](const QString& file) { read(std::filesystem::path(file.toStdString())); });
  });
  row.forget = new QToolButton;
  row.forget->setText(QStringLiteral("\u00d7"));
  row.forget->setObjectName(QStringLiteral("forget") + suffix);
  row.forget->setToolTip(tr("Breathe as the scenario says again"));
  row.forget->setAccessibleName(tr("Give up: %1").arg(label));
  row.forget->setProperty("role", "quiet");
  grid.addWidget(name, at, 0);
  grid.addWidget(row.open, at, 1);
  grid.addWidget(row.forget, at, 2);
  row.tip = tip;
  return row;
}

void PersonCard::show(const Row& row, const QString& used, const QString& about) {
  constexpr int MostWidth = 68;  // beside the cross
  const QString text = row.open->fontMetrics().elidedText(used, Qt::ElideMiddle, MostWidth);
  row.open->setText(used.isEmpty() ? tr("Open...") : text);
  row.open->setToolTip(used.isEmpty() ? row.tip : used + QLatin1Char('\n') + about);
  row.forget->setVisible(!used.isEmpty());
}

void PersonCard::follow() {
  const BreatheOptions& options = document_.breatheOptions();
  const auto& [fit, person] = std::tie(options.fit, options.person);
  if (fit) {
    show(breath_, withUnit(1000.0 * fit->tidal, 0, "mL"),
         tr("A breath of %1, fitted to %2 % of its volume")
             .arg(withUnit(fit->period, 2, "s"))
             .arg(100.0 * fit->rms, 0, 'f', 2));
  } else {
    show(breath_, {}, {});
  }
  if (person) {
    show(constants_, qtText(person->name), qtText(basisOf(*person)));
  } else {
    show(constants_, {}, {});
  }
}

}  // namespace pneuma
