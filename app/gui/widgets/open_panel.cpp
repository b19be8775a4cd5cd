#include "widgets/open_panel.h"

#include <QLabel>
#include <QVBoxLayout>

#include "document/property_sheet.h"
#include "widgets/action_button.h"
#include "widgets/actions.h"
#include "widgets/heading.h"
#include "widgets/sheet_card.h"

namespace pneuma {

OpenPanel::OpenPanel(const Actions& actions, QWidget* parent) : QWidget(parent) {
  auto* column = new QVBoxLayout(this);
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
  column->addStretch();
}

void OpenPanel::show(const Snapshot& snapshot) {
  const PropertySheet sheet = filesSheet(snapshot);
  heading_->setVisible(!sheet.rows.empty());
  files_->setVisible(!sheet.rows.empty());
  files_->show(sheet);
}

}  // namespace pneuma
