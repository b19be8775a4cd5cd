#include "widgets/view_bar.h"

#include <QComboBox>
#include <QFrame>
#include <QHBoxLayout>
#include <QLabel>
#include <QSlider>
#include <QToolButton>
#include <QVariant>

#include "widgets/room.h"

namespace pneuma {

namespace {

struct Colouring {
  ColourBy by;
  const char* name;
};

constexpr std::array<Colouring, 6> Colourings = {
    {{ColourBy::Lobe, QT_TR_NOOP("Lobe")},
     {ColourBy::Segment, QT_TR_NOOP("Segment")},
     {ColourBy::Generation, QT_TR_NOOP("Generation")},
     {ColourBy::Strahler, QT_TR_NOOP("Strahler order")},
     {ColourBy::Diameter, QT_TR_NOOP("Diameter")},
     {ColourBy::Flow, QT_TR_NOOP("Flow share")}}};

QSlider* slider(const char* name, const QString& spoken) {
  auto* made = new QSlider(Qt::Horizontal);
  made->setObjectName(QString::fromUtf8(name));
  made->setAccessibleName(spoken);
  made->setToolTip(spoken);
  made->setMinimumWidth(56);
  made->setMaximumWidth(150);
  return made;
}

QLabel* fixedLabel(const QString& widest) {
  auto* label = new QLabel(widest);
  label->setMinimumWidth(label->fontMetrics().horizontalAdvance(widest) + 4);
  return label;
}

}  // namespace

ViewBar::ViewBar(const Actions& actions, QWidget* parent) : QWidget(parent) {
  setObjectName(QStringLiteral("viewBar"));
  setAttribute(Qt::WA_StyledBackground);
  setFixedHeight(42);
  auto* row = new QHBoxLayout(this);
  row->setContentsMargins(12, 0, 10, 0);
  row->setSpacing(8);

  colourBy_ = new QComboBox;
  colourBy_->setObjectName(QStringLiteral("colourBy"));
  colourBy_->setAccessibleName(tr("Colour airways by"));
  colourBy_->setToolTip(tr("Colour airways by"));
  for (const Colouring& colouring : Colourings) colourBy_->addItem(tr(colouring.name));
  auto* colourLabel = new QLabel(tr("Colour"));
  colourLabel->setBuddy(colourBy_);
  generation_ = slider("maxGeneration", tr("Show generations up to"));
  generation_->setRange(0, 0);
  generationLabel_ = fixedLabel(tr("Generations 0-88"));
  opacity_ = slider("lobeOpacity", tr("How dense the lobes are drawn"));
  opacity_->setRange(0, 100);
  opacity_->setValue(26);
  opacityLabel_ = fixedLabel(tr("Lobes 100 %"));

  row->addWidget(colourLabel);
  row->addWidget(colourBy_);
  row->addSpacing(8);
  row->addWidget(generationLabel_);
  row->addWidget(generation_, 1);
  row->addSpacing(8);
  row->addWidget(opacityLabel_);
  row->addWidget(opacity_, 1);
  row->addStretch(1);

  auto* segments = new QFrame;
  segments->setObjectName(QStringLiteral("segments"));
  auto* letters = new QHBoxLayout(segments);
  letters->setContentsMargins(2, 2, 2, 2);
  letters->setSpacing(1);
  for (std::size_t i = 0; i < ViewLetters.size(); ++i) {
    auto* button = new QToolButton;
    button->setObjectName(QStringLiteral("view") + QLatin1Char(ViewLetters[i]));
    button->setDefaultAction(actions.views[i]);
    button->setToolButtonStyle(Qt::ToolButtonTextOnly);
    button->setFocusPolicy(Qt::TabFocus);
    const QString name = actions.views[i]->text().remove(QLatin1Char('&'));
    button->setToolTip(
        tr("%1 view (key %2 in the view)").arg(name).arg(QLatin1Char(ViewLetters[i])));
    button->setAccessibleName(tr("%1 view").arg(name));
    letters->addWidget(button);
  }
  row->addWidget(segments, 0, Qt::AlignVCenter);
  auto* reset = new QToolButton;
  reset->setObjectName(QStringLiteral("resetView"));
  reset->setDefaultAction(actions.resetView);
  reset->setProperty("role", "quiet");
  reset->setFocusPolicy(Qt::TabFocus);
  reset->setToolTip(tr("Frame everything (key Home in the view)"));
  reset->setAccessibleName(tr("Frame everything"));
  row->addWidget(reset);

  hideWhenNarrow(this, {colourLabel}, 780);
  hideWhenNarrow(this, {generationLabel_, opacityLabel_}, 720);

  connect(colourBy_, QOverload<int>::of(&QComboBox::currentIndexChanged), this, &ViewBar::changed);
  for (QSlider* s : {generation_, opacity_}) {
    connect(s, &QSlider::valueChanged, this, [this] {
      updateLabels();
      emit changed();
    });
  }
  setDeepest(0);
}

SceneOptions ViewBar::applied(SceneOptions options) const {
  options.colourBy = Colourings[static_cast<std::size_t>(colourBy_->currentIndex())].by;
  options.maxGeneration = generation_->value();
  options.lobeOpacity = opacity_->value() / 100.0;
  return options;
}

void ViewBar::setDeepest(int generation) {
  const bool all = generation_->value() == generation_->maximum();
  const QSignalBlocker quiet(generation_);
  generation_->setMaximum(generation);
  if (all) generation_->setValue(generation);
  generation_->setEnabled(generation > 0);
  updateLabels();
}

void ViewBar::setLobes(bool any) {
  opacity_->setEnabled(any);
  opacity_->setToolTip(any ? opacity_->accessibleName() : tr("No lobe surfaces are open"));
}

void ViewBar::updateLabels() {
  generationLabel_->setText(tr("Generations 0-%1").arg(generation_->value()));
  opacityLabel_->setText(tr("Lobes %1 %").arg(opacity_->value()));
}

}  // namespace pneuma
