#include <QLabel>
#include <algorithm>

#include "document/lobes_sheet.h"
#include "document/property_sheet.h"
#include "document/text.h"
#include "widgets/heading.h"
#include "widgets/main_window.h"
#include "widgets/scene_view.h"
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
  for (QAction* slices : actions_.slices.all()) allow(*slices, ct, {}, tr("Open a CT first"));
  const QString wait = tr("A job is running");
  for (QAction* opening : {actions_.open, actions_.openFolder, actions_.sample}) {
    allow(*opening, !busy, {}, wait);
  }
  for (QAction* organ : actions_.organs) allow(*organ, !busy, {}, wait);
  updateOpeningActions();
  allow(*actions_.findLungs, ct && !busy, tr("Find lungs and central airways in the CT"),
        busy ? wait : tr("Open a CT first"));
  const bool whole = document_.canSplit();
  updateLungActions();
  updateFissureActions();
  updateBreathingActions();
  updateExportActions();
  allow(*actions_.splitLobes, whole && !busy, tr("Split the lungs into lobes along the fissures"),
        busy ? wait : tr("Open whole lungs or find them in a CT first"));
  allow(*actions_.grow, lobes && !busy, tr("Grow airways from the central ones into the lobes"),
        busy ? wait : tr("Open lobe surfaces or an organ first"));
  allow(*actions_.compareMethods, lobes && !busy,
        tr("Grow a tree by every method and see them beside each other; nothing is changed"),
        busy ? wait : tr("Open lobe surfaces or an organ first"));
  allow(*actions_.saveTree, tree && !busy, tr("Save the tree that is shown"),
        busy ? wait : tr("There is no tree to save yet"));
  allow(*actions_.savePicture, shown && view_->obstacle().isEmpty(), {},
        shown ? view_->obstacle() : tr("There is nothing to see yet"));
  for (QAction* saving : {actions_.saveProject, actions_.saveProjectAs}) {
    allow(*saving, shown && !busy, tr("Save everything, to go on with it another day"),
          busy ? wait : tr("There is nothing to save yet"));
  }
  allow(*actions_.packCt, ct && !busy, {}, busy ? wait : tr("Open a CT first"));
  for (QAction* recent : actions_.recents) recent->setEnabled(!busy);
  allow(*actions_.cancel,
        busy || branch_ || comparing() || lungEditor_.tool() != LungEditor::Tool::None ||
            fissures_.placing() || review_.active() ||
            regions_.placing() != RegionEditor::Placing::Nothing,
        {}, tr("Nothing is running"));
  allow(*actions_.undo, document_.canUndo(), {}, busy ? wait : tr("Nothing was done yet"));
  actions_.undo->setText(tr("&Undo %1").arg(document_.undoName()).trimmed());
  allow(*actions_.redo, document_.canRedo(), {}, busy ? wait : tr("Nothing was undone"));
  actions_.redo->setText(tr("&Redo %1").arg(document_.redoName()).trimmed());
}

void MainWindow::updateFissureActions() {
  const bool whole = document_.canSplit() && steps_[LobesStep]->isChecked();
  const QString obstacle = document_.snapObstacle();
  const bool looking = document_.lookingForFissures();
  const QString where = document_.canSplit() ? tr("Go to the step Lobes first")
                                             : tr("Open whole lungs or find them in a CT first");
  allow(*actions_.placePoints, whole, tr("Clicks in the slices set points on the current fissure"),
        where);
  allow(*actions_.snap, whole && obstacle.isEmpty() && !looking,
        tr("Draws points, planes and proposals onto the fissure in the CT"),
        !obstacle.isEmpty() ? obstacle
        : looking           ? tr("Fissures are being looked for in the CT")
                            : where);
  actions_.snap->setChecked(document_.snapshot().lobeEdits.snap || looking);
  const bool busy = document_.jobs().busy();
  const bool lungs = document_.canSplit();
  const QString wait = tr("A job is running");
  const QString file = busy && lungs ? wait : tr("Open whole lungs or find them in a CT first");
  allow(*actions_.openFissures, lungs && !busy,
        tr("Points, planes and surfaces of fissures: Pneuma's JSON, "
           "3D Slicer, Chest Imaging Platform"),
        file);
  allow(*actions_.saveFissures, lungs && !busy, tr("Saves the fissures that were set"), file);
  allow(*actions_.review, whole && review_.available() && !review_.active(),
        tr("Leads through twelve places of each fissure"),
        sliceViews_.empty() ? tr("Needs a CT: the fissures are looked at in its slices")
        : review_.active()  ? tr("The review is on")
                            : where);
  const QString begin = tr("Begin a review first");
  allow(*actions_.looksRight, whole && review_.active(),
        tr("The fissure lies right in this slice: to the next"), begin);
  allow(*actions_.editHere, whole && review_.active(),
        tr("Leaves the review to set points in this slice; V comes back"), begin);
  allow(*actions_.acceptFissures, whole && !busy && !review_.complete(),
        tr("Takes the fissures as they are; this can be undone"),
        !whole ? where
        : busy ? wait
               : tr("All fissures were looked at"));
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
    const bool missing = document_.ctMissing();
    steps_[OpenStep]->setState(healthy && !missing ? StepState::Done : StepState::CheckMe,
                               missing               ? tr("CT not found")
                               : model.ct            ? sizeText(model.ct->geometry)
                               : count > 0           ? counted(count, "surface", "surfaces")
                               : document_.canGrow() ? tr("a built-in organ")
                                                     : tr("a tree"));
  }

  StepButton& lungs = *steps_[LungsStep];
  if (!model.ct) {
    lungs.setState(StepState::ToDo, tr("in a CT"));
  } else if (document_.findingLungs() || document_.followingLungs()) {
    lungs.setState(StepState::Running, {});
  } else if (document_.lungsOutOfDate() || !snapshot.lungsFollow()) {
    lungs.setState(StepState::OutOfDate, {});
  } else if (model.lungs) {
    const LungSegmentation& found = *model.lungs;
    const bool fine = std::ranges::all_of(found.checks, &SegmentationCheck::ok);
    lungs.setState(fine ? StepState::Done : StepState::CheckMe,
                   model.corrections
                       ? tr("corrected by hand")
                       : withUnit(found.right.volumeMl + found.left.volumeMl, 0, "mL"));
  } else {
    lungs.setState(model.labels ? StepState::Done : StepState::ToDo,
                   model.corrections ? tr("corrected by hand")
                   : model.labels    ? tr("labels from a file")
                                     : QString());
  }

  updateLobesStep();

  StepButton& airways = *steps_[AirwaysStep];
  if (document_.growing()) {
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
  StepButton& exporting = *steps_[ExportStep];
  if (document_.exporting()) {
    exporting.setState(StepState::Running, {});
  } else if (document_.treeSaved()) {
    exporting.setState(StepState::Done, tr("tree saved"));
  } else {
    exporting.setState(StepState::ToDo, {});
  }
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
