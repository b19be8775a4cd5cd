#include "widgets/breath_bar.h"

#include <QComboBox>
#include <QHBoxLayout>
#include <QLabel>
#include <QSignalBlocker>
#include <QSlider>
#include <QToolButton>
#include <QVariant>
#include <array>
#include <cmath>

#include "document/breath_player.h"
#include "document/text.h"
#include "widgets/actions.h"
#include "widgets/icons.h"
#include "widgets/room.h"

namespace pneuma {

namespace {

constexpr int Steps = 1000;  // of the slider
constexpr std::array<double, 5> Speeds = {0.25, 0.5, 1.0, 2.0, 4.0};

}  // namespace

BreathBar::BreathBar(BreathPlayer& player, const Actions& actions, QWidget* parent)
    : QWidget(parent), player_(player) {
  setObjectName(QStringLiteral("breathBar"));
  setAttribute(Qt::WA_StyledBackground);
  setFixedHeight(46);
  auto* row = new QHBoxLayout(this);
  row->setContentsMargins(12, 0, 10, 0);
  row->setSpacing(8);
  play_ = new QToolButton;
  play_->setObjectName(QStringLiteral("playBreath"));
  play_->setDefaultAction(actions.playBreath);
  play_->setToolButtonStyle(Qt::ToolButtonIconOnly);
  play_->setIconSize({18, 18});
  play_->setFocusPolicy(Qt::TabFocus);
  phase_ = new QSlider(Qt::Horizontal);
  phase_->setObjectName(QStringLiteral("breathPhase"));
  phase_->setAccessibleName(tr("Moment of the breath"));
  phase_->setToolTip(tr("Moment of the breath (, and . go by one frame)"));
  phase_->setRange(0, Steps - 1);
  phase_->setMinimumWidth(80);
  moment_ = new QLabel;
  moment_->setObjectName(QStringLiteral("breathMoment"));
  moment_->setMinimumWidth(
      moment_->fontMetrics().horizontalAdvance(QStringLiteral("10.00 s   10,000 mL   60.0 /min")) +
      4);
  speed_ = new QComboBox;
  speed_->setObjectName(QStringLiteral("breathSpeed"));
  speed_->setAccessibleName(tr("Speed"));
  speed_->setToolTip(tr("Speed: 1x is as fast as the lungs breathe"));
  for (const double speed : Speeds) speed_->addItem(QStringLiteral("%1x").arg(speed));
  colour_ = new QComboBox;
  colour_->setObjectName(QStringLiteral("breathColour"));
  colour_->setAccessibleName(tr("Colour lungs by"));
  colour_->setToolTip(tr("What colours the lungs; displacement and change at the deepest"));
  colour_->addItems({tr("Lobes"), tr("Displacement"), tr("Local volume change")});
  auto* onionSkin = new QToolButton;
  onionSkin->setObjectName(QStringLiteral("onionSkin"));
  onionSkin->setDefaultAction(actions.onionSkin);
  onionSkin->setProperty("role", "toggle");
  onionSkin->setToolButtonStyle(Qt::ToolButtonTextOnly);
  onionSkin->setFocusPolicy(Qt::TabFocus);
  auto* label = new QLabel(tr("Colour"));
  label->setBuddy(colour_);
  row->addWidget(play_);
  row->addWidget(phase_, 1);
  row->addWidget(moment_);
  row->addWidget(speed_);
  row->addWidget(onionSkin);
  row->addSpacing(4);
  row->addWidget(label);
  row->addWidget(colour_);

  hideWhenNarrow(this, {label}, 760);
  hideWhenNarrow(this, {onionSkin}, 660);
  hideWhenNarrow(this, {speed_, colour_}, 620);

  connect(phase_, &QSlider::valueChanged, this, [this](int step) {
    player_.setPlaying(false);
    player_.setPhase(static_cast<double>(step) / Steps);
  });
  connect(speed_, QOverload<int>::of(&QComboBox::currentIndexChanged), this,
          [this](int index) { player_.setSpeed(Speeds[static_cast<std::size_t>(index)]); });
  connect(colour_, QOverload<int>::of(&QComboBox::currentIndexChanged), this,
          [this](int index) { player_.setColour(static_cast<BreathColour>(index)); });
  connect(&player_, &BreathPlayer::moved, this, &BreathBar::showMoment);
  connect(&player_, &BreathPlayer::changed, this, &BreathBar::follow);
  follow();
}

void BreathBar::showMoment() {
  const QSignalBlocker quiet(phase_);
  phase_->setValue(static_cast<int>(std::floor(player_.phase() * Steps + 1e-6)));
  const auto& breath = player_.breath();
  if (!breath) return;
  const double period = breath->lungs.drive.period;
  moment_->setText(QStringLiteral("%1   %2   %3")
                       .arg(withUnit(player_.phase() * period, 2, "s"),
                            withUnit(volumeMlAt(*breath, player_.phase()), 0, "mL"),
                            withUnit(60.0 / period, 1, "/min")));
}

void BreathBar::follow() {
  setVisible(player_.breath() != nullptr);
  for (std::size_t i = 0; i < Speeds.size(); ++i) {
    if (Speeds[i] == player_.speed()) speed_->setCurrentIndex(static_cast<int>(i));
  }
  colour_->setCurrentIndex(static_cast<int>(player_.colour()));
  showMoment();
}

}  // namespace pneuma
