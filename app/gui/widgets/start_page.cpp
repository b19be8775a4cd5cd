#include "widgets/start_page.h"

#include <QGridLayout>
#include <QHBoxLayout>
#include <QLabel>
#include <QPushButton>
#include <QVBoxLayout>
#include <QVariant>

#include "widgets/action_button.h"
#include "widgets/actions.h"

namespace pneuma {

namespace {

constexpr int FrameWidth = 640;

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
  frame->setMaximumWidth(FrameWidth);
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
  buttons_ = new QGridLayout;
  buttons_->setSpacing(8);
  ways_ = {actionButton(actions.open, "startOpen"),
           actionButton(actions.openFolder, "startOpenFolder"), organButton(actions, "startOrgan"),
           actionButton(actions.sample, "startSample", "primary")};
  arrange(static_cast<int>(ways_.size()));
  column->addLayout(buttons_);
  auto* tour = new QHBoxLayout;
  tour->addStretch();
  tour->addWidget(actionButton(actions.tour, "startTour", "quiet"));
  tour->addStretch();
  column->addLayout(tour);
  column->addSpacing(4);
  column->addWidget(
      line(tr("Nothing leaves this computer. Research use only; not a medical device."), "dim"));

  auto* whole = new QVBoxLayout(this);
  whole->addStretch(2);
  auto* middle = new QHBoxLayout;  // an alignment instead would cut the wrapped lines
  middle->addStretch(1);
  middle->addWidget(frame, 1000);
  middle->addStretch(1);
  whole->addLayout(middle);
  whole->addStretch(3);
}

void StartPage::resizeEvent(QResizeEvent* event) {
  QWidget::resizeEvent(event);
  const int ways = static_cast<int>(ways_.size());
  arrange(width() < FrameWidth + 8 ? ways / 2 : ways);
}

void StartPage::arrange(int columns) {
  if (columns == columns_) return;
  columns_ = columns;
  for (std::size_t i = 0; i < ways_.size(); ++i) {
    const int n = static_cast<int>(i);
    buttons_->addWidget(ways_[i], n / columns, n % columns);
  }
}

}  // namespace pneuma
