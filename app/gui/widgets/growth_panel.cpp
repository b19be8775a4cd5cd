#include "widgets/growth_panel.h"

#include <QComboBox>
#include <QEvent>
#include <QHBoxLayout>
#include <QLabel>
#include <QPushButton>
#include <QScrollArea>
#include <QVBoxLayout>
#include <QVariant>
#include <variant>

#include "document/document.h"
#include "document/text.h"
#include "widgets/action_button.h"
#include "widgets/actions.h"
#include "widgets/heading.h"
#include "widgets/options_form.h"

namespace pneuma {

namespace {

/// The options that are shown at once; what a method has besides is under "Advanced".
const std::set<std::string>& usualOptions() {
  static const std::set<std::string> names = {"terminals", "ratio", "containment", "seed"};
  return names;
}

/// As high as what it holds where there is room, so that the buttons follow the form.
class FittingScrollArea : public QScrollArea {
 public:
  explicit FittingScrollArea(QWidget* content) {
    setWidget(content);
    setWidgetResizable(true);
    setFrameShape(QFrame::NoFrame);
    setHorizontalScrollBarPolicy(Qt::ScrollBarAlwaysOff);
    setSizePolicy(QSizePolicy::Preferred, QSizePolicy::Maximum);
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
  auto* column = new QVBoxLayout(this);
  column->setContentsMargins(0, 0, 0, 0);
  column->setSpacing(8);
  column->addWidget(heading(tr("Grow airways")));
  column->addWidget(makeForm());

  auto* buttons = new QHBoxLayout;
  buttons->setSpacing(8);
  buttons->addWidget(actionButton(actions.grow, "grow", "primary"), 1);
  auto* cancel = actionButton(actions.cancel, "growCancel");
  cancel->setText(tr("Cancel"));
  connect(&document_.jobs(), &JobQueue::busyChanged, cancel, &QWidget::setVisible);
  connect(actions.cancel, &QAction::changed, cancel, [cancel] { cancel->setText(tr("Cancel")); });
  cancel->hide();
  buttons->addWidget(cancel);
  column->addLayout(buttons);
  note_ = new QLabel;
  note_->setObjectName(QStringLiteral("growthNote"));
  note_->setProperty("role", "dim");
  note_->setWordWrap(true);
  column->addWidget(note_);
  column->addStretch();

  bindOptions();
  connect(&model_, &QAbstractItemModel::dataChanged, this, &GrowthPanel::takeOptions);
  connect(&document_, &Document::growthOptionsChanged, this, &GrowthPanel::updateNote);
  connect(&document_, &Document::changed, this, &GrowthPanel::updateNote);
  updateNote();
}

QWidget* GrowthPanel::makeForm() {
  auto* content = new QWidget;
  auto* column = new QVBoxLayout(content);
  column->setContentsMargins(0, 0, 0, 0);
  column->setSpacing(8);
  method_ = new QComboBox;
  method_->setObjectName(QStringLiteral("method"));
  method_->setAccessibleName(tr("Method"));
  for (const GrowthMethod& method : growthMethods()) {
    method_->addItem(qtText(method.title));
    method_->setItemData(method_->count() - 1, qtText(method.citation), Qt::ToolTipRole);
  }
  method_->setToolTip(qtText(growthMethods().front().citation));
  connect(method_, QOverload<int>::of(&QComboBox::currentIndexChanged), this, [this](int index) {
    const GrowthMethod& method = growthMethods()[static_cast<std::size_t>(index)];
    method_->setToolTip(qtText(method.citation));
    document_.setGrowthOptions(method.defaults);
    bindOptions();
  });
  column->addWidget(method_);
  column->addWidget(new OptionsForm(model_, usualOptions(), false));

  auto* below = new QHBoxLayout;
  advanced_ = new QPushButton(tr("Advanced"));
  advanced_->setObjectName(QStringLiteral("advanced"));
  advanced_->setProperty("role", "link");
  advanced_->setCheckable(true);
  auto* defaults = new QPushButton(tr("Defaults"));
  defaults->setObjectName(QStringLiteral("defaults"));
  defaults->setProperty("role", "link");
  defaults->setToolTip(tr("The values of the method's paper"));
  below->addWidget(advanced_);
  below->addStretch();
  below->addWidget(defaults);
  column->addLayout(below);
  advancedForm_ = new OptionsForm(model_, usualOptions(), true);
  advancedForm_->setObjectName(QStringLiteral("advancedForm"));
  advancedForm_->hide();
  column->addWidget(advancedForm_);
  connect(advanced_, &QPushButton::toggled, this, [this](bool on) {
    advancedForm_->setVisible(on);
    advanced_->setText(on ? tr("Hide advanced") : tr("Advanced"));
  });
  connect(defaults, &QPushButton::clicked, this, [this] {
    document_.setGrowthOptions(growthMethod(document_.growthOptions()).defaults);
    bindOptions();
  });

  return new FittingScrollArea(content);
}

void GrowthPanel::bindOptions() {
  std::visit([this](const auto& options) { model_.bind(options); }, document_.growthOptions());
}

void GrowthPanel::takeOptions() {
  GrowthOptions options = document_.growthOptions();
  std::visit(
      [this](auto& chosen) { chosen = model_.options<std::remove_cvref_t<decltype(chosen)>>(); },
      options);
  document_.setGrowthOptions(options);
}

void GrowthPanel::updateNote() {
  if (!document_.canGrow()) {
    note_->setText(tr("Open lobe surfaces first: there is nothing to grow in."));
  } else if (document_.growthOutOfDate()) {
    note_->setText(tr("Options were changed since this tree was grown."));
  } else if (!document_.model().central) {
    note_->setText(tr("No central airways are open: a template is used."));
  } else {
    note_->setText({});
  }
  note_->setVisible(!note_->text().isEmpty());
}

}  // namespace pneuma
