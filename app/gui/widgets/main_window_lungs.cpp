#include <algorithm>
#include <array>

#include "widgets/ct_views.h"
#include "widgets/dialogs.h"
#include "widgets/error_card.h"
#include "widgets/main_window.h"
#include "widgets/slice_view.h"
#include "widgets/status_strip.h"
#include "widgets/step_button.h"

// Lungs that are corrected by hand in the slices.
namespace pneuma {

void MainWindow::connectLungs() {
  using Tool = LungEditor::Tool;
  for (const auto& [action, tool] :
       {std::pair{actions_.brush, Tool::Brush}, std::pair{actions_.eraser, Tool::Eraser},
        std::pair{actions_.seed, Tool::Seed}}) {
    connect(action, &QAction::triggered, this, [this, tool = tool](bool on) {
      errorCard_->hide();
      lungEditor_.setTool(on ? tool : Tool::None);
    });
  }
  connect(actions_.largerBrush, &QAction::triggered, this, [this] { lungEditor_.stepRadius(1); });
  connect(actions_.smallerBrush, &QAction::triggered, this, [this] { lungEditor_.stepRadius(-1); });
  connect(actions_.openLungEdits, &QAction::triggered, this, [this] {
    errorCard_->hide();
    goTo(LungsStep);
    askForFile(this, tr("Open lung corrections"),
               {tr("Lung corrections (*.json)"), tr("All files (*)")},
               [this](const QString& name) { document_.openLungEdits(name.toStdString()); });
  });
  connect(actions_.saveLungEdits, &QAction::triggered, this, [this] {
    errorCard_->hide();
    askWhereToSave(this, tr("Save lung corrections"), tr("Lung corrections (*.json)"),
                   QStringLiteral("json"),
                   [this](const QString& name) { document_.saveLungEdits(name.toStdString()); });
  });
  connect(&lungEditor_, &LungEditor::said, status_, &StatusStrip::say);
  connect(&lungEditor_, &LungEditor::changed, this, &MainWindow::updateActions);
}

void MainWindow::activateLungTools(bool active) {
  for (const SlicePlane plane : SlicePlanes) {
    ctViews_->slice(plane).setLungEditor(active ? &lungEditor_ : nullptr);
  }
  if (!active) lungEditor_.setTool(LungEditor::Tool::None);
}

void MainWindow::updateLungActions() {
  const QString obstacle = document_.correctionObstacle();
  const bool here = steps_[LungsStep]->isChecked();
  const bool may = here && obstacle.isEmpty();
  const QString where = obstacle.isEmpty() ? tr("Go to the step Lungs first") : obstacle;
  allow(*actions_.brush, may, tr("Drag in a slice: what is in the circle becomes lung"), where);
  allow(*actions_.eraser, may, tr("Drag in a slice: what is in the circle is no lung any more"),
        where);
  allow(*actions_.seed, may,
        tr("Click in a slice: what hangs together there and is less dense than the limit becomes "
           "lung"),
        where);
  const QString take = tr("Take the brush or the eraser first");
  for (QAction* size : {actions_.largerBrush, actions_.smallerBrush}) {
    allow(*size, may && lungEditor_.brushing(), tr("Changes the radius of the brush"),
          may ? take : where);
  }
  actions_.brush->setChecked(lungEditor_.tool() == LungEditor::Tool::Brush);
  actions_.eraser->setChecked(lungEditor_.tool() == LungEditor::Tool::Eraser);
  actions_.seed->setChecked(lungEditor_.tool() == LungEditor::Tool::Seed);
  allow(*actions_.openLungEdits, obstacle.isEmpty(),
        tr("Corrects the lungs by the strokes and seeds of a file"), obstacle);
  const bool corrected = document_.model().corrections != nullptr;
  const bool busy = document_.jobs().busy();
  allow(*actions_.saveLungEdits, corrected && !busy,
        tr("Saves strokes and seeds, for pneuma segment --edits"),
        corrected ? tr("A job is running") : tr("The lungs were not corrected by hand yet"));
}

}  // namespace pneuma
