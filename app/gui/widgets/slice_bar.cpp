#include "widgets/slice_bar.h"

#include <QComboBox>
#include <QDoubleSpinBox>
#include <QHBoxLayout>
#include <QLabel>
#include <QSignalBlocker>
#include <QSlider>
#include <QToolButton>
#include <QVariant>
#include <cmath>

#include "document/text.h"
#include "widgets/actions.h"
#include "widgets/room.h"

namespace pneuma {

namespace {

QToolButton* toggle(QAction* action, const char* name, const QString& text) {
  auto* button = new QToolButton;
  button->setObjectName(QString::fromUtf8(name));
  button->setDefaultAction(action);
  button->setToolButtonStyle(Qt::ToolButtonTextOnly);
  button->setFocusPolicy(Qt::TabFocus);
  button->setProperty("role", "toggle");
  button->setAccessibleName(text);
  button->setToolTip(QStringLiteral("%1 (%2)").arg(text, action->shortcut().toString()));
  return button;
}

}  // namespace

SliceBar::SliceBar(SliceViews& views, const Actions& actions, QWidget* parent)
    : QWidget(parent), views_(views) {
  setObjectName(QStringLiteral("sliceBar"));
  setAttribute(Qt::WA_StyledBackground);
  setFixedHeight(42);
  auto* row = new QHBoxLayout(this);
  row->setContentsMargins(12, 0, 10, 0);
  row->setSpacing(8);

  preset_ = new QComboBox;
  preset_->setObjectName(QStringLiteral("windowPreset"));
  preset_->setAccessibleName(tr("Window of the slices"));
  preset_->setToolTip(tr("Which radiodensities are shown (F5 to F9 in a view)"));
  for (const NamedWindow& named : greyWindows()) preset_->addItem(qtText(named.title));
  preset_->addItem(tr("Custom"));
  auto* label = new QLabel(tr("Window"));
  label->setBuddy(preset_);
  width_ = huBox("windowWidth", tr("Width of the window"), NarrowestWindowHu, WidestWindowHu);
  level_ = huBox("windowLevel", tr("Level of the window"), -WidestWindowHu, WidestWindowHu);
  opacity_ = new QSlider(Qt::Horizontal);
  opacity_->setObjectName(QStringLiteral("overlayOpacity"));
  opacity_->setAccessibleName(tr("How dense the overlay is"));
  opacity_->setToolTip(tr("How dense the overlay is ([ and ] in a view)"));
  opacity_->setRange(0, 100);
  opacity_->setMinimumWidth(56);
  opacity_->setMaximumWidth(150);
  opacityLabel_ = new QLabel;
  opacityLabel_->setMinimumWidth(opacityLabel_->fontMetrics().horizontalAdvance(tr("100 %")) + 4);

  row->addWidget(label);
  row->addWidget(preset_);
  row->addSpacing(4);
  row->addWidget(new QLabel(tr("W")));
  row->addWidget(width_);
  row->addWidget(new QLabel(tr("L")));
  row->addWidget(level_);
  row->addStretch(1);
  row->addWidget(toggle(actions.slices.overlay, "overlay", tr("Overlay")));
  auto* outlines = toggle(actions.slices.outlines, "outlines", tr("Outlines"));
  row->addWidget(outlines);
  row->addSpacing(4);
  row->addWidget(opacity_, 1);
  row->addWidget(opacityLabel_);

  hideWhenNarrow(this, {label}, 660);
  hideWhenNarrow(this, {outlines, opacityLabel_}, 620);

  connect(preset_, QOverload<int>::of(&QComboBox::activated), this, [&actions](int index) {
    const auto i = static_cast<std::size_t>(index);
    if (i < actions.slices.windows.size()) actions.slices.windows[i]->trigger();
  });
  connect(opacity_, &QSlider::valueChanged, this, [this](int percent) {
    SliceLook look = views_.look();
    look.opacity = percent / 100.0;
    views_.setLook(look);
  });
  connect(&views_, &SliceViews::changed, this, &SliceBar::follow);
  follow();
}

QDoubleSpinBox* SliceBar::huBox(const char* name, const QString& spoken, double least,
                                double most) {
  auto* box = new QDoubleSpinBox;
  box->setObjectName(QString::fromUtf8(name));
  box->setAccessibleName(spoken);
  box->setToolTip(tr("%1, HU (hold W and drag in a view)").arg(spoken));
  box->setDecimals(0);
  box->setRange(least, most);
  box->setSingleStep(50.0);
  box->setKeyboardTracking(false);
  box->setFixedWidth(74);
  connect(box, QOverload<double>::of(&QDoubleSpinBox::valueChanged), this, [this] {
    SliceLook look = views_.look();
    look.window = {width_->value(), level_->value()};
    views_.setLook(look);
  });
  return box;
}

void SliceBar::follow() {
  const SliceLook& look = views_.look();
  const QSignalBlocker quietWidth(width_);
  const QSignalBlocker quietLevel(level_);
  const QSignalBlocker quietOpacity(opacity_);
  width_->setValue(look.window.widthHu);
  level_->setValue(look.window.levelHu);
  const int percent = static_cast<int>(std::lround(100.0 * look.opacity));
  opacity_->setValue(percent);
  opacityLabel_->setText(tr("%1 %").arg(percent));
  int preset = static_cast<int>(greyWindows().size());
  for (int i = 0; i < preset; ++i) {
    if (greyWindows()[static_cast<std::size_t>(i)].window == look.window) preset = i;
  }
  preset_->setCurrentIndex(preset);
}

}  // namespace pneuma
