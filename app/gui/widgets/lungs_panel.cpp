#include "widgets/lungs_panel.h"

#include <QCheckBox>
#include <QHBoxLayout>
#include <QLabel>
#include <QSignalBlocker>
#include <QSlider>
#include <QVBoxLayout>
#include <QVariant>

#include "document/document.h"
#include "document/property_sheet.h"
#include "document/slice_views.h"
#include "widgets/action_button.h"
#include "widgets/actions.h"
#include "widgets/heading.h"
#include "widgets/lung_tools_card.h"
#include "widgets/options_form.h"
#include "widgets/scrolled.h"
#include "widgets/sheet_card.h"

namespace pneuma {

LungsPanel::LungsPanel(Document& document, LungEditor& editor, SliceViews& slices,
                       const Actions& actions, QWidget* parent)
    : QWidget(parent), document_(document), slices_(slices) {
  // What was found is taller than a small window.
  auto* content = new QWidget;
  auto* column = new QVBoxLayout(content);
  column->setContentsMargins(0, 0, 0, 0);
  column->setSpacing(8);
  column->addWidget(heading(tr("Find lungs")));
  model_.bind(document_.lungOptions());
  column->addWidget(new OptionsForm(model_, {"threshold"}));
  const OptionsModel::Row& row = model_.row(*model_.rowOf("threshold"));
  threshold_ = new QSlider(Qt::Horizontal);
  threshold_->setObjectName(QStringLiteral("threshold"));
  threshold_->setAccessibleName(tr("Threshold of air"));
  threshold_->setToolTip(tr("Drag: what is less dense is coloured on the slices"));
  threshold_->setRange(static_cast<int>(row.range.low), static_cast<int>(row.range.high));
  threshold_->setPageStep(25);
  column->addWidget(threshold_);
  preview_ = new QCheckBox(tr("Show it on the slices"));
  preview_->setObjectName(QStringLiteral("showThreshold"));
  preview_->setToolTip(tr("Colour every voxel that is less dense than the threshold"));
  column->addWidget(preview_);
  column->addWidget(new OptionsForm(model_, {"closing", "repair"}));
  column->addWidget(actionButton(actions.findLungs, "findLungs", "primary"));
  note_ = new QLabel;
  note_->setObjectName(QStringLiteral("lungsNote"));
  note_->setProperty("role", "dim");
  note_->setWordWrap(true);
  column->addWidget(note_);
  column->addSpacing(6);
  column->addWidget(new LungToolsCard(document_, editor, actions));
  column->addSpacing(6);
  heading_ = heading(tr("Found"));
  column->addWidget(heading_);
  found_ = new SheetCard;
  found_->setObjectName(QStringLiteral("foundLungs"));
  found_->setAccessibleName(tr("Lungs that were found"));
  column->addWidget(found_);
  column->addStretch();
  fillScrolling(this, content);

  connect(&model_, &QAbstractItemModel::dataChanged, this, &LungsPanel::takeOptions);
  connect(threshold_, &QSlider::valueChanged, this, [this](int hu) {
    LungOptions options = document_.lungOptions();
    options.thresholdHu = hu;
    preview_->setChecked(true);
    document_.setLungOptions(options);
  });
  connect(preview_, &QCheckBox::toggled, this, &LungsPanel::showThreshold);
  connect(actions.findLungs, &QAction::triggered, this, &LungsPanel::endPreview);
  connect(&document_, &Document::lungOptionsChanged, this, &LungsPanel::follow);
  connect(&document_, &Document::changed, this, &LungsPanel::follow);
  follow();
}

void LungsPanel::takeOptions() {
  const auto options = model_.options<LungOptions>();
  if (options.thresholdHu != document_.lungOptions().thresholdHu) preview_->setChecked(true);
  document_.setLungOptions(options);
}

void LungsPanel::follow() {
  const LungOptions& options = document_.lungOptions();
  if (!(model_.options<LungOptions>() == options)) model_.bind(options);
  const QSignalBlocker quiet(threshold_);
  threshold_->setValue(static_cast<int>(options.thresholdHu));
  showThreshold();
  note_->setText(note());
  note_->setVisible(!note_->text().isEmpty());
  const PropertySheet sheet = foundLungsSheet(document_.snapshot());
  heading_->setVisible(!sheet.rows.empty());
  found_->setVisible(!sheet.rows.empty());
  found_->show(sheet);
}

void LungsPanel::showThreshold() {
  SliceLook look = slices_.look();
  look.highlight.reset();
  if (preview_->isChecked()) {
    look.highlight = HuBand{PaddingHu + 1.0, document_.lungOptions().thresholdHu};
  }
  slices_.setLook(look);
}

void LungsPanel::endPreview() { preview_->setChecked(false); }

QString LungsPanel::note() const {
  if (!document_.model().ct) return tr("Open a CT first: there is nothing to look in.");
  if (document_.lungsOutOfDate()) return tr("Changed since these lungs were found.");
  if (document_.model().corrections) {
    return tr("Finding the lungs again leaves the corrections out; undo brings them back.");
  }
  return {};
}

}  // namespace pneuma
