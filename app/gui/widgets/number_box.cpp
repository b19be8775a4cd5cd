#include "widgets/number_box.h"

#include <QLocale>

namespace pneuma {

NumberBox::NumberBox(QWidget* parent) : QDoubleSpinBox(parent) {
  setLocale(QLocale(QLocale::English, QLocale::UnitedStates));
  setGroupSeparatorShown(true);
  setKeyboardTracking(false);
  setAlignment(Qt::AlignRight);
}

QString NumberBox::textFromValue(double value) const {
  QString text = QDoubleSpinBox::textFromValue(value);
  if (!text.contains(QLatin1Char('.'))) return text;
  while (text.endsWith(QLatin1Char('0'))) text.chop(1);
  if (text.endsWith(QLatin1Char('.'))) text.chop(1);
  return text;
}

}  // namespace pneuma
