#include "widgets/start_page.h"

#include <QHBoxLayout>
#include <QLabel>
#include <QPushButton>
#include <QVBoxLayout>
#include <QVariant>

#include "widgets/action_button.h"
#include "widgets/actions.h"

namespace pneuma {

namespace {

QLabel* line(const QString& text, const char* role) {
  auto* label = new QLabel(text);
  label->setProperty("role", role);
  label->setAlignment(Qt::AlignHCenter);
  label->setWordWrap(true);
  return label;
}

}  // namespace

StartPage::StartPage(const Actions& actions, QWidget* parent) : QWidget(parent) {
  setObjectName(QStringLiteral("startPage"));
  setAttribute(Qt::WA_StyledBackground);
  auto* frame = new QFrame;
  frame->setObjectName(QStringLiteral("dropFrame"));
  frame->setFixedWidth(640);
  auto* column = new QVBoxLayout(frame);
  column->setContentsMargins(36, 32, 36, 30);
  column->setSpacing(10);
  column->addWidget(line(tr("Drop a project, a CT or lobe surfaces here"), "title"));
  column->addWidget(line(
      tr("A chest CT as a folder of DICOM, or as NIfTI, NRRD or MetaImage; or a folder of "
         "surfaces, or STL, OBJ, PLY and "
         "VTP files, whose names carry rul, rml, rll, lul, lll. Add the central airways as VTP, "
         "VTU, SWC or CSV if you "
         "have them; without them a template is used. No data at hand? Take a built-in "
         "organ."),
      "dim"));
  column->addSpacing(8);
  auto* buttons = new QHBoxLayout;
  buttons->setSpacing(8);
  buttons->addWidget(actionButton(actions.open, "startOpen"));
  buttons->addWidget(actionButton(actions.openFolder, "startOpenFolder"));
  buttons->addWidget(organButton(actions, "startOrgan"));
  buttons->addWidget(actionButton(actions.sample, "startSample", "primary"));
  column->addLayout(buttons);
  column->addSpacing(4);
  column->addWidget(
      line(tr("Nothing leaves this computer. Research use only; not a medical device."), "dim"));

  auto* whole = new QVBoxLayout(this);
  whole->addStretch(2);
  auto* middle = new QHBoxLayout;  // an alignment instead would cut the wrapped lines
  middle->addStretch();
  middle->addWidget(frame);
  middle->addStretch();
  whole->addLayout(middle);
  whole->addStretch(3);
}

}  // namespace pneuma
