#include "widgets/growth_panel.h"

#include <QButtonGroup>
#include <QEvent>
#include <QGridLayout>
#include <QHBoxLayout>
#include <QLabel>
#include <QPushButton>
#include <QScrollArea>
#include <QScrollBar>
#include <QVBoxLayout>
#include <QVariant>

#include "document/document.h"
#include "document/efficiency_table.h"
#include "document/text.h"
#include "widgets/action_button.h"
#include "widgets/actions.h"
#include "widgets/efficiency_card.h"
#include "widgets/growth_form.h"
#include "widgets/heading.h"
#include "widgets/scrolled.h"

namespace pneuma {

namespace {

constexpr int TabsInARow = 2;

/// A lower panel has no room for the advanced options and the efficiency functions.
constexpr int HeightForBoth = 560;

constexpr int LowestForm = 72;

/// As high as what it holds where there is room, so that the buttons follow the form.
class FittingScrollArea : public QScrollArea {
 public:
  explicit FittingScrollArea(QWidget* content) {
    setWidget(content);
    setWidgetResizable(true);
    verticalScrollBar()->setObjectName(QStringLiteral("growthOptionsScroll"));
    setFrameShape(QFrame::NoFrame);
    setHorizontalScrollBarPolicy(Qt::ScrollBarAlwaysOff);
    setSizePolicy(QSizePolicy::Preferred, QSizePolicy::Maximum);
    setMinimumHeight(LowestForm);  // in a lower panel all of it scrolls
  }

  QSize sizeHint() const override { return widget()->sizeHint(); }

 protected:
  bool eventFilter(QObject* watched, QEvent* event) override {
    if (watched == widget() && event->type() == QEvent::LayoutRequest) updateGeometry();
    return QScrollArea::eventFilter(watched, event);
  }
};

}  // namespace

GrowthPanel::GrowthPanel(Document& document, const Actions& actions, QWidget* parent)
    : QWidget(parent), document_(document) {
  setObjectName(QStringLiteral("growthPanel"));
  auto* content = new QWidget;
  fillScrolling(this, content);
  auto* column = new QVBoxLayout(content);
  column->setContentsMargins(0, 0, 0, 0);
  column->setSpacing(8);
  column->addWidget(heading(tr("Grow airways")));
  column->addWidget(makeTabs());
  form_ = new GrowthForm(document_);
  column->addWidget(new FittingScrollArea(form_));
  column->addLayout(makeButtons(actions));
  note_ = new QLabel;
  note_->setObjectName(QStringLiteral("growthNote"));
  note_->setProperty("role", "dim");
  note_->setWordWrap(true);
  column->addWidget(note_);
  efficiency_ = new EfficiencyCard;
  efficiency_->setObjectName(QStringLiteral("efficiency"));
  efficiency_->setAccessibleName(tr("Efficiency functions"));
  column->addWidget(efficiency_);
  column->addStretch();

  connect(&document_, &Document::growthOptionsChanged, this, &GrowthPanel::follow);
  connect(&document_, &Document::changed, this, &GrowthPanel::follow);
  connect(form_, &GrowthForm::advancedToggled, this, &GrowthPanel::showEfficiency);
  follow();
}

QWidget* GrowthPanel::makeTabs() {
  auto* frame = new QFrame;
  frame->setProperty("role", "segmented");
  auto* grid = new QGridLayout(frame);
  grid->setContentsMargins(2, 2, 2, 2);
  grid->setSpacing(0);
  tabs_ = new QButtonGroup(this);
  const int methods = static_cast<int>(growthMethods().size());
  for (const GrowthMethod& method : growthMethods()) {
    const int index = static_cast<int>(tabs_->buttons().size());
    auto* tab = new QPushButton(qtText(method.title));
    tab->setObjectName(QStringLiteral("method_") + qtText(method.name));
    tab->setCheckable(true);
    tab->setToolTip(qtText(method.citation));
    tabs_->addButton(tab, index);
    // One that is alone in its row takes all of it.
    const bool alone = index % TabsInARow == 0 && index + 1 == methods;
    grid->addWidget(tab, index / TabsInARow, index % TabsInARow, 1, alone ? TabsInARow : 1);
    connect(tab, &QPushButton::clicked, this,
            [this, index] { document_.setGrowthMethod(static_cast<std::size_t>(index)); });
  }
  return frame;
}

QLayout* GrowthPanel::makeButtons(const Actions& actions) {
  auto* buttons = new QHBoxLayout;
  buttons->setSpacing(8);
  buttons->addWidget(actionButton(actions.grow, "grow", "primary"), 1);
  auto* compare = actionButton(actions.compareMethods, "compareMethods");
  compare->setText(tr("Compare"));
  connect(actions.compareMethods, &QAction::changed, compare,
          [compare] { compare->setText(tr("Compare")); });
  connect(&document_.jobs(), &JobQueue::busyChanged, compare, &QWidget::setHidden);
  buttons->addWidget(compare);
  auto* cancel = actionButton(actions.cancel, "growCancel");
  cancel->setText(tr("Cancel"));
  connect(&document_.jobs(), &JobQueue::busyChanged, cancel, &QWidget::setVisible);
  connect(actions.cancel, &QAction::changed, cancel, [cancel] { cancel->setText(tr("Cancel")); });
  cancel->hide();
  buttons->addWidget(cancel);
  return buttons;
}

void GrowthPanel::follow() {
  tabs_->button(static_cast<int>(document_.growthMethodIndex()))->setChecked(true);
  note_->setText(note());
  note_->setVisible(!note_->text().isEmpty());
  const EfficiencyTable table = efficiencyTable(document_.snapshot());
  efficiency_->show(table);
  grown_ = !table.rows.empty();
  showEfficiency();
}

void GrowthPanel::showEfficiency() {
  const bool room = height() >= HeightForBoth || !form_->advancedShown();
  efficiency_->setVisible(grown_ && room);
}

void GrowthPanel::resizeEvent(QResizeEvent* event) {
  QWidget::resizeEvent(event);
  showEfficiency();
}

QString GrowthPanel::note() const {
  if (!document_.canGrow()) {
    return tr("Open lobe surfaces or an organ first: there is nothing to grow in.");
  }
  if (document_.growthOutOfDate()) return tr("Changed since this tree was grown.");
  if (!document_.model().central) return tr("No central airways are open: a template is used.");
  return {};
}

}  // namespace pneuma
