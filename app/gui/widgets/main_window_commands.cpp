#include <QMenuBar>
#include <utility>

#include "document/text.h"
#include "widgets/command_palette.h"
#include "widgets/ct_views.h"
#include "widgets/keys_overlay.h"
#include "widgets/main_window.h"
#include "widgets/scene_view.h"
#include "widgets/structure_view.h"
#include "widgets/welcome_dialog.h"

// All commands by their names, and all keys.
namespace pneuma {

namespace {

/// Of the surface's box, which is close enough to look at.
Vec3 centreOf(const LobeSurface& surface) {
  Vec3 low = surface.mesh->points.front();
  Vec3 high = low;
  for (const Vec3& point : surface.mesh->points) {
    low = low.cwiseMin(point);
    high = high.cwiseMax(point);
  }
  return 0.5 * (low + high);
}

}  // namespace

void MainWindow::connectCommands() {
  palette_ = new CommandPalette(this);
  keysOverlay_ = new KeysOverlay(this);
  const QMenuBar* menus = findChild<QMenuBar*>(QStringLiteral("menus"));
  connect(actions_.findCommand, &QAction::triggered, this, [this, menus] {
    std::vector<Command> commands = commandsOf(*menus);
    for (Command& command : structureCommands()) commands.push_back(std::move(command));
    palette_->offer(std::move(commands));
  });
  connect(actions_.keys, &QAction::triggered, this,
          [this, menus] { keysOverlay_->list(keyRows(*menus, mouse_)); });
  for (std::size_t i = 0; i < actions_.steps.size(); ++i) {
    connect(actions_.steps[i], &QAction::triggered, this,
            [this, i] { goTo(static_cast<Step>(i)); });
  }
  for (const MouseHabits& habits : mouseHabits()) {
    connect(actions_.mouse[static_cast<std::size_t>(habits.profile)], &QAction::triggered, this,
            [this, profile = habits.profile] {
              setMouse(profile);
              emit mouseChosen(profile);
            });
  }
  connect(actions_.welcome, &QAction::triggered, this, &MainWindow::welcome);
  connect(actions_.tour, &QAction::triggered, this, &MainWindow::tourAsked);
}

void MainWindow::setMouse(MouseProfile profile) {
  mouse_ = profile;
  actions_.mouse[static_cast<std::size_t>(profile)]->setChecked(true);
  ctViews_->setMouse(profile);
}

void MainWindow::welcome() {
  auto* dialog = new WelcomeDialog(actions_, this);
  dialog->setAttribute(Qt::WA_DeleteOnClose);
  connect(dialog, &QDialog::accepted, this, &MainWindow::welcomed);
  dialog->open();
}

std::vector<Command> MainWindow::structureCommands() {
  std::vector<Command> commands;
  std::vector<Command> centres;
  const auto& surfaces = document_.model().surfaces;
  for (int row = 0; row < structures_.rowCount(); ++row) {
    const auto& structure = structures_.structure(row);
    const bool surface = structure.kind == StructureModel::Kind::Surface;
    const QString name = surface ? capitalised(longName(structure.lobe)) : structure.name;
    Command eye;
    eye.group = tr("Structures");
    eye.title = structure.visible ? tr("Hide: %1").arg(name) : tr("Show: %1").arg(name);
    eye.run = [this, row, shown = structure.visible] {
      structures_.setData(structures_.index(row), shown ? Qt::Unchecked : Qt::Checked,
                          Qt::CheckStateRole);
    };
    commands.push_back(std::move(eye));
    if (!surface || !surfaces || (*surfaces)[structure.surface].mesh->points.empty()) continue;
    Command centre;
    centre.group = tr("Structures");
    centre.title = tr("Centre: %1").arg(name);
    centre.run = [this, row, point = centreOf((*surfaces)[structure.surface])] {
      structureView_->setCurrentIndex(structures_.index(row));
      view_->centreOn(point);
      if (!sliceViews_.empty()) sliceViews_.moveTo(point);
    };
    centres.push_back(std::move(centre));
  }
  for (Command& centre : centres) commands.push_back(std::move(centre));
  return commands;
}

}  // namespace pneuma
