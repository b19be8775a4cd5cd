#include <QLabel>
#include <algorithm>

#include "document/lobes_sheet.h"
#include "document/property_sheet.h"
#include "document/text.h"
#include "widgets/heading.h"
#include "widgets/main_window.h"
#include "widgets/sheet_card.h"
#include "widgets/step_button.h"
#include "widgets/structure_view.h"

// What the window says of the document: which actions there are, where the steps stand, the figures
// of what is selected.
namespace pneuma {

void MainWindow::updateActions() {
  const bool busy = document_.jobs().busy();
  const bool lobes = document_.canGrow();
  const bool tree = document_.tree() != nullptr;
  const bool ct = document_.model().ct != nullptr;
  const bool shown = tree || document_.model().surfaces || ct;
  for (QAction* slices : actions_.slices.all()) slices->setEnabled(ct);
  const QString wait = tr("A job is running");
  for (QAction* opening : {actions_.open, actions_.openFolder, actions_.sample}) {
    opening->setEnabled(!busy);
  }
  for (QAction* organ : actions_.organs) organ->setEnabled(!busy);
  actions_.findLungs->setEnabled(ct && !busy);
  actions_.findLungs->setToolTip(busy ? wait
                                 : ct ? tr("Find lungs and central airways in the CT")
                                      : tr("Open a CT first"));
  const bool whole = document_.canSplit();
  updateFissureActions();
  updateBreathingActions();
  updateExportActions();
  actions_.splitLobes->setEnabled(whole && !busy);
  actions_.splitLobes->setToolTip(busy    ? wait
                                  : whole ? tr("Split the lungs into lobes along the fissures")
                                          : tr("Open whole lungs or find them in a CT first"));
  actions_.grow->setEnabled(lobes && !busy);
  actions_.grow->setToolTip(busy    ? wait
                            : lobes ? tr("Grow airways from the central ones into the lobes")
                                    : tr("Open lobe surfaces or an organ first"));
  actions_.saveTree->setEnabled(tree && !busy);
  actions_.saveTree->setToolTip(busy   ? wait
                                : tree ? tr("Save the tree that is shown")
                                       : tr("There is no tree to save yet"));
  actions_.savePicture->setEnabled(shown);
  for (QAction* saving : {actions_.saveProject, actions_.saveProjectAs}) {
    saving->setEnabled(shown && !busy);
    saving->setToolTip(busy    ? wait
                       : shown ? tr("Save everything, to go on with it another day")
                               : tr("There is nothing to save yet"));
  }
  actions_.packCt->setEnabled(ct && !busy);
  for (QAction* recent : actions_.recents) recent->setEnabled(!busy);
  actions_.cancel->setEnabled(busy || branch_ || fissures_.placing() || review_.active() ||
                              regions_.placing() != RegionEditor::Placing::Nothing);
  actions_.undo->setEnabled(document_.canUndo());
  actions_.undo->setText(tr("&Undo %1").arg(document_.undoName()).trimmed());
  actions_.redo->setEnabled(document_.canRedo());
  actions_.redo->setText(tr("&Redo %1").arg(document_.redoName()).trimmed());
}

void MainWindow::updateFissureActions() {
  const bool whole = document_.canSplit() && steps_[LobesStep]->isChecked();
  const QString obstacle = document_.snapObstacle();
  const bool looking = document_.lookingForFissures();
  actions_.placePoints->setEnabled(whole);
  actions_.placePoints->setToolTip(tr("Clicks in the slices set points on the current fissure"));
  actions_.snap->setEnabled(whole && obstacle.isEmpty() && !looking);
  actions_.snap->setChecked(document_.snapshot().lobeEdits.snap || looking);
  actions_.snap->setToolTip(
      obstacle.isEmpty() ? tr("Draws points, planes and proposals onto the fissure in the CT")
                         : obstacle);
  const bool busy = document_.jobs().busy();
  for (QAction* file : {actions_.openFissures, actions_.saveFissures}) {
    file->setEnabled(document_.canSplit() && !busy);
  }
  actions_.openFissures->setToolTip(
      tr("Points, planes and surfaces of fissures: Pneuma's JSON, "
         "3D Slicer, Chest Imaging Platform"));
  actions_.saveFissures->setToolTip(tr("Saves the fissures that were set"));
  actions_.review->setEnabled(whole && review_.available() && !review_.active());
  actions_.review->setToolTip(sliceViews_.empty()
                                  ? tr("Needs a CT: the fissures are looked at in its slices")
                                  : tr("Leads through twelve places of each fissure"));
  actions_.looksRight->setEnabled(whole && review_.active());
  actions_.looksRight->setToolTip(tr("The fissure lies right in this slice: to the next"));
  actions_.editHere->setEnabled(whole && review_.active());
  actions_.editHere->setToolTip(tr("Leaves the review to set points in this slice; V comes back"));
  actions_.acceptFissures->setEnabled(whole && !busy && !review_.complete());
  actions_.acceptFissures->setToolTip(tr("Takes the fissures as they are; this can be undone"));
}

void MainWindow::updateSteps() {
  const Snapshot& snapshot = document_.snapshot();
  const LungModel& model = snapshot.model;
  const bool busy = document_.jobs().busy();
  const auto tree = document_.tree();

  if (!model.surfaces && !tree && !model.ct) {
    steps_[OpenStep]->setState(busy ? StepState::Running : StepState::ToDo, tr("CT or lobes"));
  } else {
    bool healthy = model.warnings.empty();
    std::size_t count = 0;
    if (model.surfaces) {
      count = model.surfaces->size();
      for (const auto& surface : *model.surfaces) healthy = healthy && surface.health.healthy();
    }
    steps_[OpenStep]->setState(healthy ? StepState::Done : StepState::CheckMe,
                               model.ct              ? sizeText(model.ct->geometry)
                               : count > 0           ? counted(count, "surface", "surfaces")
                               : document_.canGrow() ? tr("a built-in organ")
                                                     : tr("a tree"));
  }

  StepButton& lungs = *steps_[LungsStep];
  if (!model.ct) {
    lungs.setState(StepState::ToDo, tr("in a CT"));
  } else if (busy && !document_.canGrow()) {
    lungs.setState(StepState::Running, {});
  } else if (document_.lungsOutOfDate()) {
    lungs.setState(StepState::OutOfDate, {});
  } else if (model.lungs) {
    const LungSegmentation& found = *model.lungs;
    const bool fine = std::ranges::all_of(found.checks, &SegmentationCheck::ok);
    lungs.setState(fine ? StepState::Done : StepState::CheckMe,
                   withUnit(found.right.volumeMl + found.left.volumeMl, 0, "mL"));
  } else {
    lungs.setState(model.labels ? StepState::Done : StepState::ToDo,
                   model.labels ? tr("labels from a file") : QString());
  }

  updateLobesStep();

  StepButton& airways = *steps_[AirwaysStep];
  if (busy && document_.canGrow() && !document_.splitting() && !document_.breathing()) {
    airways.setState(StepState::Running, {});
  } else if (!model.growth) {
    airways.setState(StepState::ToDo, {});
  } else if (document_.growthOutOfDate()) {
    airways.setState(StepState::OutOfDate, {});
  } else {
    const Outside& outside = model.growth->outside;
    const bool fine = outside.ends + outside.segments == 0 && model.growth->result.warnings.empty();
    airways.setState(fine ? StepState::Done : StepState::CheckMe,
                     counted(tree->size(), "branch", "branches"));
  }
  updateBreathingStep();
  steps_[ExportStep]->setState(document_.treeSaved() ? StepState::Done : StepState::ToDo,
                               document_.treeSaved() ? tr("tree saved") : QString());
}

void MainWindow::updateLobesStep() {
  StepButton& step = *steps_[LobesStep];
  const LungModel& model = document_.model();
  if (document_.splitting()) {
    step.setState(StepState::Running, {});
  } else if (!document_.canSplit()) {
    step.setState(StepState::ToDo, tr("in whole lungs"));
  } else if (!model.lobes) {
    step.setState(StepState::ToDo, tr("fissures proposed"));
  } else if (document_.lobesOutOfDate()) {
    step.setState(StepState::OutOfDate, {});
  } else {
    // Lobes are no finding before somebody has looked at their fissures, or says so.
    bool fine = review_.complete();
    for (const PropertyRow& row : lobeChecksSheet(fissures_, document_).rows) {
      fine = fine && row.kind != PropertyRow::Kind::Look;
    }
    step.setState(fine ? StepState::Done : StepState::CheckMe,
                  counted(model.lobes->lobeMm3.size(), "lobe", "lobes"));
  }
}

void MainWindow::updateProperties() {
  const Snapshot& snapshot = document_.snapshot();
  PropertySheet sheet;
  if (branch_) {
    sheet = branchSheet(snapshot, *branch_);
  } else if (const QModelIndex current = structureView_->currentIndex(); current.isValid()) {
    const auto& structure = structures_.structure(current.row());
    switch (structure.kind) {
      case StructureModel::Kind::Surface:
        sheet = surfaceSheet(snapshot, structure.surface);
        break;
      case StructureModel::Kind::Airways:
        sheet = treeSheet(snapshot);
        break;
      case StructureModel::Kind::Lungs:
      case StructureModel::Kind::Side:
        sheet = lungsSheet(snapshot, structure.side);
        break;
    }
  }
  const bool any = !sheet.title.isEmpty();
  setHeading(*propertiesHeading_, sheet.title);
  propertiesHeading_->setVisible(any);
  properties_->setVisible(any);
  properties_->show(sheet);
}

}  // namespace pneuma
