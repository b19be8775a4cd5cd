#include "widgets/breathing_panel.h"

#include <QDoubleSpinBox>
#include <QLabel>
#include <QVBoxLayout>
#include <QVariant>

#include "document/breath.h"
#include "document/document.h"
#include "document/text.h"
#include "widgets/action_button.h"
#include "widgets/actions.h"
#include "widgets/heading.h"
#include "widgets/options_form.h"
#include "widgets/person_card.h"
#include "widgets/regions_card.h"
#include "widgets/scrolled.h"
#include "widgets/sheet_card.h"

namespace pneuma {

BreathingPanel::BreathingPanel(Document& document, RegionEditor& regions, const Actions& actions,
                               QWidget* parent)
    : QWidget(parent), document_(document) {
  auto* content = new QWidget;
  auto* column = new QVBoxLayout(content);
  column->setContentsMargins(0, 0, 0, 0);
  column->setSpacing(8);
  column->addWidget(heading(tr("Breathe")));
  model_.bind(document_.breatheOptions());
  auto* form = new OptionsForm(
      model_, {"scenario", "posture", "tidal", "period", "motion", "model", "affected", "frames"},
      tr("After Santhanam 2003 and 2008; what is measured and what is reasoned stands below the "
         "breath and in its report"),
      NarrowLabelWidth);
  for (const char* name : {"option_tidal", "option_period"}) {
    form->findChild<QDoubleSpinBox*>(QString::fromUtf8(name))
        ->setSpecialValueText(tr("scenario's"));
  }
  column->addWidget(form);
  column->addWidget(actionButton(actions.breathe, "breathe", "primary"));
  column->addSpacing(4);
  column->addWidget(heading(tr("Of this person")));
  person_ = new PersonCard(document_);
  column->addWidget(person_);
  column->addSpacing(4);
  column->addWidget(heading(tr("Stiff and soft parts")));
  regions_ = new RegionsCard(regions);
  column->addWidget(regions_);
  note_ = new QLabel;
  note_->setObjectName(QStringLiteral("breathingNote"));
  note_->setProperty("role", "dim");
  note_->setWordWrap(true);
  column->addWidget(note_);
  column->addSpacing(6);
  heading_ = heading({});
  column->addWidget(heading_);
  breath_ = new SheetCard;
  breath_->setObjectName(QStringLiteral("breathSheet"));
  breath_->setAccessibleName(tr("The breath"));
  column->addWidget(breath_);
  column->addWidget(actionButton(actions.saveBreath, "saveBreath"));
  column->addStretch();
  fillScrolling(this, content);

  connect(&model_, &QAbstractItemModel::dataChanged, this,
          [this] { document_.setBreatheOptions(model_.options<BreatheOptions>()); });
  connect(&document_, &Document::breatheOptionsChanged, this, &BreathingPanel::follow);
  connect(&document_, &Document::changed, this, &BreathingPanel::follow);
  connect(&document_.jobs(), &JobQueue::busyChanged, this, &BreathingPanel::follow);
  follow();
}

void BreathingPanel::follow() {
  const BreatheOptions& options = document_.breatheOptions();
  if (!(model_.options<BreatheOptions>() == options)) model_.bind(options);
  person_->follow();
  person_->setEnabled(!document_.jobs().busy());
  regions_->setChangeable(document_.canBreathe() && !document_.jobs().busy());
  note_->setText(note());
  note_->setVisible(!note_->text().isEmpty());
  const auto& breath = document_.snapshot().breath;
  const PropertySheet sheet = breath ? breathSheet(*breath) : PropertySheet{};
  setHeading(*heading_, sheet.title);
  heading_->setVisible(breath != nullptr);
  breath_->setVisible(breath != nullptr);
  breath_->show(sheet);
}

QString BreathingPanel::note() const {
  if (!document_.canBreathe()) return tr("Open lobes or lungs first: there is nothing to move.");
  if (document_.breathOutOfDate()) return tr("Changed since this breath was made.");
  const auto& breath = document_.snapshot().breath;
  if (breath) return qtText(breath->report.at("basis").get<std::string>());
  return {};
}

}  // namespace pneuma
