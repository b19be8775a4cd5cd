#include "widgets/action_button.h"

#include <QAction>
#include <QMenu>
#include <QVariant>

#include "widgets/actions.h"

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

QPushButton* shortButton(QAction* action, const char* name, const char* role) {
  QPushButton* button = actionButton(action, name, role);
  button->setCheckable(action->isCheckable());
  const auto follow = [button, action] {
    button->setText(action->iconText());
    button->setChecked(action->isChecked());
  };
  follow();
  QObject::connect(action, &QAction::changed, button, follow);
  // A press that is refused must not stay.
  QObject::connect(button, &QPushButton::clicked, button, follow);
  return button;
}

QPushButton* organButton(const Actions& actions, const char* name) {
  auto* button = new QPushButton(QObject::tr("Built-in organ"));
  button->setObjectName(QString::fromUtf8(name));
  button->setToolTip(QObject::tr("An organ of a paper with its central airways, to try a method"));
  button->setMenu(organMenu(actions, button));
  for (QAction* organ : actions.organs) {
    QObject::connect(organ, &QAction::changed, button,
                     [button, organ] { button->setEnabled(organ->isEnabled()); });
  }
  return button;
}

}  // namespace pneuma
