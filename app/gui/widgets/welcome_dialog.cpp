#include "widgets/welcome_dialog.h"

#include <QButtonGroup>
#include <QGridLayout>
#include <QHBoxLayout>
#include <QLabel>
#include <QPushButton>
#include <QRadioButton>
#include <QScreen>
#include <QVBoxLayout>
#include <QVariant>

#include "widgets/heading.h"
#include "widgets/mouse_picture.h"

namespace pneuma {

namespace {

constexpr int WelcomeMargin = 28;

/// Whether the pictures of all mice, side by side, have room on the screen.
bool picturesFit(const QScreen& screen) {
  int width = 2 * WelcomeMargin;
  for (const MouseHabits& habits : mouseHabits()) {
    width += MousePicture(habits.profile).sizeHint().width() + WelcomeMargin;
  }
  return width < 0.9 * screen.availableSize().width();
}

QLabel* paragraph(const QString& text, const char* role) {
  auto* label = new QLabel(text);
  label->setProperty("role", role);
  label->setWordWrap(true);
  return label;
}

QRadioButton* choice(const QString& text, const QString& name, QButtonGroup* group, bool chosen) {
  auto* button = new QRadioButton(text);
  button->setObjectName(name);
  button->setChecked(chosen);
  group->addButton(button);
  return button;
}

}  // namespace

WelcomeDialog::WelcomeDialog(const Actions& actions, QWidget* parent) : QDialog(parent) {
  setObjectName(QStringLiteral("welcome"));
  setWindowTitle(tr("Welcome to Pneuma"));
  auto* column = new QVBoxLayout(this);
  column->setContentsMargins(WelcomeMargin, 24, WelcomeMargin, 22);
  column->setSpacing(10);
  column->addWidget(paragraph(tr("Welcome to Pneuma"), "title"));
  column->addWidget(paragraph(tr("From a chest CT to lobes, airways and breathing. Two things to "
                                 "choose; the menu View changes them later."),
                              "dim"));
  column->addSpacing(4);
  column->addWidget(heading(tr("Look")));
  column->addWidget(makeLooks(actions));
  column->addSpacing(4);
  column->addWidget(heading(tr("Mouse in slices")));
  column->addWidget(makeMice(actions));
  column->addSpacing(8);
  column->addWidget(paragraph(
      tr("Research use only; not a medical device: nothing here may decide on the care of "
         "a patient. Nothing leaves this computer: Pneuma never uses a network, and "
         "needs no account."),
      "text"));
  auto* buttons = new QHBoxLayout;
  auto* tour = new QPushButton(tr("Understood, show me the tour"));
  tour->setObjectName(QStringLiteral("welcomeTour"));
  auto* start = new QPushButton(tr("Understood, start"));
  start->setObjectName(QStringLiteral("welcomeStart"));
  start->setProperty("role", "primary");
  start->setDefault(true);
  buttons->addStretch();
  buttons->addWidget(tour);
  buttons->addWidget(start);
  column->addSpacing(4);
  column->addLayout(buttons);
  connect(start, &QPushButton::clicked, this, &QDialog::accept);
  connect(tour, &QPushButton::clicked, this, [this, action = actions.tour] {
    accept();
    action->trigger();
  });
}

QWidget* WelcomeDialog::makeLooks(const Actions& actions) {
  auto* looks = new QWidget;
  auto* row = new QHBoxLayout(looks);
  row->setContentsMargins(0, 0, 0, 0);
  row->setSpacing(24);
  auto* group = new QButtonGroup(looks);
  const bool light = actions.theme->isChecked();
  auto* dark = choice(tr("Dark"), QStringLiteral("welcomeDark"), group, !light);
  auto* bright = choice(tr("Light"), QStringLiteral("welcomeLight"), group, light);
  row->addWidget(dark);
  row->addWidget(bright);
  row->addStretch();
  connect(bright, &QRadioButton::toggled, this, [action = actions.theme](bool on) {
    if (action->isChecked() != on) action->trigger();
  });
  return looks;
}

QWidget* WelcomeDialog::makeMice(const Actions& actions) {
  auto* mice = new QWidget;
  auto* grid = new QGridLayout(mice);
  grid->setContentsMargins(0, 0, 0, 0);
  grid->setHorizontalSpacing(WelcomeMargin);
  grid->setVerticalSpacing(8);
  auto* group = new QButtonGroup(mice);
  const bool wide = picturesFit(*screen());
  int place = 0;
  for (const MouseHabits& habits : mouseHabits()) {
    QAction* action = actions.mouse[static_cast<std::size_t>(habits.profile)];
    auto* button =
        choice(QObject::tr(habits.title), QStringLiteral("welcomeMouse_%1").arg(habits.name), group,
               action->isChecked());
    connect(button, &QRadioButton::toggled, this, [action](bool on) {
      if (on) action->trigger();
    });
    if (wide) {
      grid->addWidget(button, 0, place);
      grid->addWidget(new MousePicture(habits.profile), 1, place++);
    } else {
      auto* drag = new QLabel(tr("Left drag: %1").arg(dragText(habits.left)));
      drag->setProperty("role", "dim");
      grid->addWidget(button, place, 0);
      grid->addWidget(drag, place++, 1);
    }
  }
  return mice;
}

}  // namespace pneuma
