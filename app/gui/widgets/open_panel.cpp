#include "widgets/open_panel.h"

#include <QLabel>
#include <QPushButton>
#include <QVBoxLayout>

#include "document/document.h"
#include "document/property_sheet.h"
#include "widgets/action_button.h"
#include "widgets/actions.h"
#include "widgets/heading.h"
#include "widgets/scrolled.h"
#include "widgets/sheet_card.h"

namespace pneuma {

OpenPanel::OpenPanel(const Actions& actions, QWidget* parent) : QWidget(parent) {
  auto* content = new QWidget;
  fillScrolling(this, content);
  auto* column = new QVBoxLayout(content);
  column->setContentsMargins(0, 0, 0, 0);
  column->setSpacing(8);
  column->addWidget(heading(tr("Open")));
  column->addWidget(actionButton(actions.open, "openFiles", "primary"));
  column->addWidget(actionButton(actions.openFolder, "openFolder"));
  column->addWidget(actionButton(actions.sample, "openSample"));
  column->addWidget(organButton(actions, "openOrgan"));
  column->addSpacing(10);
  heading_ = heading(tr("Opened"));
  column->addWidget(heading_);
  files_ = new SheetCard;
  files_->setObjectName(QStringLiteral("openedFiles"));
  files_->setAccessibleName(tr("Opened files"));
  column->addWidget(files_);
  otherSeries_ = actionButton(actions.otherSeries, "otherSeries");
  locate_ = actionButton(actions.locateCt, "locateCt");
  column->addWidget(otherSeries_);
  column->addWidget(locate_);
  column->addStretch();
}

void OpenPanel::show(const Document& document) {
  const PropertySheet sheet = filesSheet(document.snapshot());
  otherSeries_->setVisible(document.hasOtherSeries());
  locate_->setVisible(document.ctMissing());
  heading_->setVisible(!sheet.rows.empty());
  files_->setVisible(!sheet.rows.empty());
  files_->show(sheet);
}

}  // namespace pneuma
