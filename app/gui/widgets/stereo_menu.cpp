#include "widgets/stereo_menu.h"

#include <QActionGroup>
#include <QHBoxLayout>
#include <QLabel>
#include <QSignalBlocker>
#include <QWidgetAction>

#include "document/text.h"
#include "widgets/number_box.h"

namespace pneuma {

namespace {

// As --eye-distance of `pneuma render`.
constexpr double ClosestEyesMm = 1.0;
constexpr double FarthestEyesMm = 500.0;

constexpr std::array<const char*, choices(Stereo{}).size()> KindTitles = {
    QT_TRANSLATE_NOOP("pneuma::StereoMenu", "&Off"),
    QT_TRANSLATE_NOOP("pneuma::StereoMenu", "&Anaglyph (red and cyan glasses)"),
    QT_TRANSLATE_NOOP("pneuma::StereoMenu", "&Side by side"),
    QT_TRANSLATE_NOOP("pneuma::StereoMenu", "&Crossed eyes")};

}  // namespace

StereoMenu::StereoMenu(QWidget* parent) : QMenu(tr("&Stereo"), parent) {
  setObjectName(QStringLiteral("stereoMenu"));
  auto* group = new QActionGroup(this);
  for (std::size_t i = 0; i < kinds_.size(); ++i) {
    kinds_[i] = addAction(tr(KindTitles[i]));
    kinds_[i]->setObjectName(QStringLiteral("actionStereo_") + qtText(choices(Stereo{})[i]));
    kinds_[i]->setCheckable(true);
    group->addAction(kinds_[i]);
    connect(kinds_[i], &QAction::triggered, this, &StereoMenu::changed);
  }
  kinds_[0]->setChecked(true);
  addSeparator();
  auto* row = new QWidget;
  auto* layout = new QHBoxLayout(row);
  layout->setContentsMargins(12, 4, 12, 4);
  distance_ = new NumberBox;
  distance_->setObjectName(QStringLiteral("eyeDistance"));
  distance_->setAccessibleName(tr("Distance of the eyes"));
  distance_->setToolTip(tr("How far the eyes are apart in the scene; people's are about 65 mm"));
  distance_->setRange(ClosestEyesMm, FarthestEyesMm);
  distance_->setSuffix(tr(" mm"));
  distance_->setValue(StereoOptions{}.eyeDistanceMm);
  auto* label = new QLabel(tr("Eye distance"));
  label->setBuddy(distance_);
  layout->addWidget(label);
  layout->addWidget(distance_, 1);
  auto* distance = new QWidgetAction(this);
  distance->setDefaultWidget(row);
  addAction(distance);
  connect(distance_, QOverload<double>::of(&QDoubleSpinBox::valueChanged), this,
          &StereoMenu::changed);
}

StereoOptions StereoMenu::stereo() const {
  StereoOptions options;
  options.eyeDistanceMm = distance_->value();
  for (std::size_t i = 0; i < kinds_.size(); ++i) {
    if (kinds_[i]->isChecked()) options.stereo = static_cast<Stereo>(i);
  }
  return options;
}

void StereoMenu::setStereo(const StereoOptions& stereo) {
  const QSignalBlocker quiet(this);
  kinds_[static_cast<std::size_t>(stereo.stereo)]->setChecked(true);
  distance_->setValue(stereo.eyeDistanceMm);
}

}  // namespace pneuma
