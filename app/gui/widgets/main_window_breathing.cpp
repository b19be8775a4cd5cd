#include <QLabel>
#include <QStackedWidget>
#include <filesystem>

#include "document/text.h"
#include "views/model_scene.h"
#include "widgets/breath_bar.h"
#include "widgets/dialogs.h"
#include "widgets/error_card.h"
#include "widgets/heading.h"
#include "widgets/main_window.h"
#include "widgets/scene_view.h"
#include "widgets/step_button.h"

// What the window does for breathing.
namespace pneuma {

void MainWindow::connectBreathing() {
  connect(actions_.breathe, &QAction::triggered, this, [this] {
    errorCard_->hide();
    goTo(BreathingStep);
    document_.breathe();
  });
  connect(actions_.playBreath, &QAction::triggered, &player_, &BreathPlayer::setPlaying);
  connect(actions_.saveBreath, &QAction::triggered, this, &MainWindow::saveBreath);
  connect(actions_.onionSkin, &QAction::toggled, &player_, &BreathPlayer::setOnionSkin);
  connect(&regions_, &RegionEditor::changed, this, [this] {
    showRegions();
    updateActions();
  });
  connect(view_, &SceneView::surfaceClicked, this, [this](std::size_t surface, const Vec3& place) {
    regions_.placeAt((*document_.model().surfaces)[surface].lobe, place);
  });
  connect(view_, &SceneView::playToggled, this, [this] { player_.setPlaying(!player_.playing()); });
  connect(view_, &SceneView::stepped, &player_, &BreathPlayer::step);
  connect(&document_, &Document::breatheOptionsChanged, this, &MainWindow::updateSteps);
  connect(&player_, &BreathPlayer::moved, this, [this] {
    if (shownBreath_) view_->setBreath(scaleAt(*shownBreath_, player_.phase()));
  });
  connect(&player_, &BreathPlayer::changed, this, [this] {
    view_->setPlaying(player_.playing());
    view_->setOnionSkin(player_.onionSkin());
    if (shownBreath_) showMoment();
    updateBreathingActions();
  });
}

std::shared_ptr<const AirwayTree> MainWindow::treeToShow() const {
  return shownBreath_ ? shownBreath_->lungs.tree : shownTree_;
}

void MainWindow::showMoment() {
  view_->setBreathing(shownBreath_->scenes[static_cast<std::size_t>(player_.colour())]);
  view_->setBreath(scaleAt(*shownBreath_, player_.phase()));
}

void MainWindow::showRegions() {
  const bool here = steps_[BreathingStep]->isChecked();
  view_->setPicking(here && regions_.placing() != RegionEditor::Placing::Nothing);
  view_->setBalls(here ? regions_.balls() : std::vector<SceneBall>());
}

void MainWindow::showBreathing() {
  const bool here = steps_[BreathingStep]->isChecked();
  showRegions();
  const auto breath = here ? document_.snapshot().breath : nullptr;
  charts_->setCurrentIndex(here ? 1 : 0);
  setHeading(*chartHeading_, here ? tr("Volume and pressure") : tr("Branches per generation"));
  if (breath == shownBreath_) return;
  shownBreath_ = breath;
  if (breath) {
    view_->setPlaying(true);  // before anything is made that is shown only once they stand
    view_->setSurfaces(breath->surfaces);
  } else {
    view_->setSurfaces(sceneSurfaces(shownSurfaces_));
  }
  applyVisibility();
  player_.setBreath(breath);
  if (!breath) return;
  view_->resetView();  // with room for the deepest breath
  player_.setPlaying(true);
}

void MainWindow::saveBreath() {
  errorCard_->hide();
  askWhereToSave(this, tr("Save the breath"), tr("ParaView collection (*.pvd)"),
                 QStringLiteral("pvd"), [this](const QString& name) {
                   document_.saveBreath(std::filesystem::path(name.toStdString()));
                 });
}

void MainWindow::updateBreathingActions() {
  const bool busy = document_.jobs().busy();
  const bool lungs = document_.canBreathe();
  const bool breath = document_.snapshot().breath != nullptr;
  const QString wait = tr("A job is running");
  allow(*actions_.breathe, lungs && !busy, tr("Make lungs and airways breathe"),
        busy ? wait : tr("Open lobes or lungs first"));
  allow(*actions_.saveBreath, breath && !busy, tr("A frame for every moment, for ParaView"),
        breath ? wait : tr("Nothing breathes yet"));
  const bool here = player_.breath() != nullptr;
  const QString still = breath ? tr("Go to the step Breathing first") : tr("Nothing breathes yet");
  allow(*actions_.onionSkin, here,
        tr("Show where the lungs are at the ends of expiration and inspiration, too"), still);
  actions_.onionSkin->setChecked(player_.onionSkin());
  allow(*actions_.playBreath, here,
        player_.playing() ? tr("Stand still (Space in the 3-D view)")
                          : tr("Play (Space in the 3-D view)"),
        still);
  actions_.playBreath->setChecked(player_.playing());
}

void MainWindow::updateBreathingStep() {
  StepButton& step = *steps_[BreathingStep];
  const auto& breath = document_.snapshot().breath;
  if (document_.breathing()) {
    step.setState(StepState::Running, {});
  } else if (!breath) {
    step.setState(StepState::ToDo, {});
  } else if (document_.breathOutOfDate()) {
    step.setState(StepState::OutOfDate, {});
  } else {
    bool fine = breath->lungs.warnings.empty();
    for (const PropertyRow& row : breathSheet(*breath).rows) {
      fine = fine && row.kind != PropertyRow::Kind::Look;
    }
    step.setState(fine ? StepState::Done : StepState::CheckMe,
                  withUnit(1000.0 * breath->lungs.cycle.tidal, 0, "mL"));
  }
}

}  // namespace pneuma
