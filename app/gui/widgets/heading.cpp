#include "widgets/heading.h"

#include <QFont>
#include <QLabel>
#include <QVariant>

namespace pneuma {

QLabel* heading(const QString& text) {
  auto* label = new QLabel;
  label->setProperty("role", "heading");
  QFont font = label->font();
  font.setLetterSpacing(QFont::AbsoluteSpacing, 1.0);
  label->setFont(font);
  setHeading(*label, text);
  return label;
}

void setHeading(QLabel& label, const QString& text) { label.setText(text.toUpper()); }

}  // namespace pneuma
