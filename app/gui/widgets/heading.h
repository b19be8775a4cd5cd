#pragma once

class QLabel;
class QString;

namespace pneuma {

/// A heading in small spaced capitals.
QLabel* heading(const QString& text);

void setHeading(QLabel& label, const QString& text);

}  // namespace pneuma
