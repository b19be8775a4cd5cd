#include "widgets/action_button.h"

#include <QAction>
#include <QVariant>

namespace pneuma {

QPushButton* actionButton(QAction* action, const char* name, const char* role) {
  auto* button = new QPushButton;
  button->setObjectName(QString::fromUtf8(name));
  if (role != nullptr) button->setProperty("role", role);
  const auto follow = [button, action] {
    QString text = action->text();
    button->setText(text.remove(QLatin1Char('&')));
    button->setAccessibleName(button->text().remove(QStringLiteral("...")));
    button->setEnabled(action->isEnabled());
    const QString key = action->shortcut().toString(QKeySequence::NativeText);
    button->setToolTip(key.isEmpty() ? action->toolTip()
                                     : QStringLiteral("%1 (%2)").arg(action->toolTip(), key));
  };
  follow();
  QObject::connect(action, &QAction::changed, button, follow);
  QObject::connect(button, &QPushButton::clicked, action, &QAction::trigger);
  return button;
}

}  // namespace pneuma
