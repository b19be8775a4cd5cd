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
  actions_.placePoints->setEnabled(whole && steps_[LobesStep]->isChecked());
  actions_.placePoints->setToolTip(tr("Clicks in the slices set points on the current fissure"));
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
  actions_.cancel->setEnabled(busy || branch_ || fissures_.placing());
  actions_.undo->setEnabled(document_.canUndo());
  actions_.undo->setText(tr("&Undo %1").arg(document_.undoName()).trimmed());
  actions_.redo->setEnabled(document_.canRedo());
  actions_.redo->setText(tr("&Redo %1").arg(document_.redoName()).trimmed());
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
  if (busy && document_.canGrow() && !document_.splitting()) {
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
    // A proposal that nobody touched is no finding.
    bool fine = model.lobes->warnings.empty();
    for (const auto& [fissure, used] : model.lobes->fissures) {
      fine = fine && used.source != FissureSource::Proposal;
    }
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
