#include "widgets/size_menu.h"

#include <QActionGroup>
#include <algorithm>
#include <array>
#include <cstdlib>

namespace pneuma {

namespace {

constexpr std::array<int, 7> Percents = {80, 90, 100, 125, 150, 175, 200};
constexpr const char* ScaleVariable = "QT_SCALE_FACTOR";

}  // namespace

SizeMenu::SizeMenu(QWidget* parent) : QMenu(tr("Si&ze"), parent) {
  setObjectName(QStringLiteral("sizeMenu"));
  auto* group = new QActionGroup(this);
  for (const int percent : Percents) {
    QAction* size = addAction(tr("%1 %").arg(percent));
    size->setObjectName(QStringLiteral("actionSize_%1").arg(percent));
    size->setData(percent);
    size->setCheckable(true);
    size->setChecked(percent == 100);
    size->setToolTip(tr("Text and everything else; from the next start on"));
    group->addAction(size);
    connect(size, &QAction::triggered, this, [this, percent] { emit chosen(percent); });
  }
}

void SizeMenu::setPercent(int percent) {
  const QList<QAction*> sizes = actions();
  const auto distance = [percent](const QAction* a) {
    return std::abs(a->data().toInt() - percent);
  };
  (*std::ranges::min_element(sizes, {}, distance))->setChecked(true);
}

void takeSize(int percent) {
  if (qEnvironmentVariableIsSet(ScaleVariable)) return;
  const int taken = std::clamp(percent, Percents.front(), Percents.back());
  if (taken != 100) qputenv(ScaleVariable, QByteArray::number(0.01 * taken));
}

}  // namespace pneuma
