#include "widgets/main_window.h"

#include <QApplication>
#include <QBuffer>
#include <QDragEnterEvent>
#include <QLabel>
#include <QMimeData>
#include <QStackedWidget>
#include <QToolButton>
#include <set>
#include <utility>

#include "document/text.h"
#include "io/atomic_file.h"
#include "pipeline/lobes_model.h"
#include "views/model_scene.h"
#include "widgets/comparison_page.h"
#include "widgets/ct_views.h"
#include "widgets/dialogs.h"
#include "widgets/error_card.h"
#include "widgets/export_panel.h"
#include "widgets/fissure_views.h"
#include "widgets/generation_chart.h"
#include "widgets/icons.h"
#include "widgets/lungs_panel.h"
#include "widgets/open_panel.h"
#include "widgets/scene_view.h"
#include "widgets/size_menu.h"
#include "widgets/slice_bar.h"
#include "widgets/slice_view.h"
#include "widgets/status_strip.h"
#include "widgets/step_button.h"
#include "widgets/stereo_menu.h"
#include "widgets/structure_view.h"
#include "widgets/view_bar.h"

namespace pneuma {

namespace {

std::filesystem::path pathOf(const QString& name) { return name.toStdString(); }

/// From a little to the patient's right and above: the tree is seen in depth.
constexpr ViewDirection FirstView{-10.0, 6.0};

}  // namespace

void MainWindow::setSize(int percent) { actions_.size->setPercent(percent); }

void MainWindow::setTheme(ThemeName name) {
  applyTheme(*qApp, name);
  actions_.theme->setChecked(name == ThemeName::Light);
  themeToggle_->setIcon(themedIcon(name == ThemeName::Dark ? "sun" : "moon"));
  SceneOptions options = view_->options();
  options.background = name == ThemeName::Dark ? Background::Dark : Background::Light;
  view_->setOptions(options);
  comparisonPage_->setOptions(options);
}

void MainWindow::connectActions() {
  connect(actions_.open, &QAction::triggered, this, [this] {
    askForFiles(this, [this](const QStringList& files) {
      std::vector<std::filesystem::path> paths;
      for (const QString& file : files) paths.push_back(pathOf(file));
      open(std::move(paths));
    });
  });
  connect(actions_.openFolder, &QAction::triggered, this, [this] {
    askForFolder(this, [this](const QString& folder) { open({pathOf(folder)}); });
  });
  connect(actions_.sample, &QAction::triggered, this, [this] {
    errorCard_->hide();
    document_.openSample();
  });
  for (QAction* organ : actions_.organs) {
    connect(organ, &QAction::triggered, this, [this, organ] {
      errorCard_->hide();
      document_.openOrgan(organ->data().toString().toStdString());
    });
  }
  connect(actions_.findLungs, &QAction::triggered, this, [this] {
    errorCard_->hide();
    goTo(LungsStep);
    document_.findLungs();
  });
  connect(actions_.splitLobes, &QAction::triggered, this, [this] {
    errorCard_->hide();
    goTo(LobesStep);
    document_.splitLobes();
  });
  connect(actions_.grow, &QAction::triggered, this, [this] {
    errorCard_->hide();
    goTo(AirwaysStep);
    document_.grow();
  });
  connect(actions_.undo, &QAction::triggered, &document_, &Document::undo);
  connect(actions_.redo, &QAction::triggered, &document_, &Document::redo);
  connect(actions_.cancel, &QAction::triggered, this, &MainWindow::cancel);
  connect(actions_.saveTree, &QAction::triggered, this, &MainWindow::saveTree);
  connect(actions_.savePicture, &QAction::triggered, this, &MainWindow::savePicture);
  connect(actions_.quit, &QAction::triggered, this, &QWidget::close);
  connect(actions_.about, &QAction::triggered, this, [this] { showAbout(this); });
  connect(actions_.theme, &QAction::triggered, this, [this](bool light) {
    const ThemeName name = light ? ThemeName::Light : ThemeName::Dark;
    setTheme(name);
    emit themeChosen(name);
  });
  connect(actions_.size, &SizeMenu::chosen, this, [this](int percent) {
    emit sizeChosen(percent);
    status_->say(tr("%1 %: from the next start on").arg(percent));
  });
  for (std::size_t i = 0; i < ViewLetters.size(); ++i) {
    connect(actions_.views[i], &QAction::triggered, this,
            [this, i] { view_->look(viewDirection(std::string_view(&ViewLetters[i], 1))); });
  }
  connect(actions_.resetView, &QAction::triggered, view_, &SceneView::resetView);
  connect(actions_.stereo, &StereoMenu::changed, this,
          [this] { view_->setStereo(actions_.stereo->stereo()); });
}

void MainWindow::connectDocument() {
  connect(&document_, &Document::changed, this, &MainWindow::showSnapshot);
  connect(&document_, &Document::growthOptionsChanged, this, &MainWindow::updateSteps);
  connect(&document_, &Document::said, status_, &StatusStrip::say);
  connect(
      &document_, &Document::failed, errorCard_,
      [this](const QString& title, const QString& sentence) { errorCard_->show(title, sentence); });
  const JobQueue& jobs = document_.jobs();
  connect(&jobs, &JobQueue::progressed, this, &MainWindow::updateSteps);
  connect(&jobs, &JobQueue::placed, view_, &SceneView::addPreview);
  connect(&jobs, &JobQueue::finished, view_, &SceneView::clearPreview);
  connect(&jobs, &JobQueue::cancelled, view_, &SceneView::clearPreview);
  connect(&jobs, &JobQueue::failed, view_, &SceneView::clearPreview);
}

void MainWindow::connectView() {
  connect(view_, &SceneView::clicked, this, &MainWindow::selectBranch);
  connect(view_, &SceneView::hovered, this, &MainWindow::probe);
  connect(view_, &SceneView::walked, this, &MainWindow::walk);
  connect(ctViews_, &CtViews::hovered, this, &MainWindow::probePoint);
  connect(viewBar_, &ViewBar::changed, this,
          [this] { view_->setOptions(viewBar_->applied(view_->options())); });
  connect(&structures_, &StructureModel::visibilityChanged, this, &MainWindow::applyVisibility);
  connect(structureView_->selectionModel(), &QItemSelectionModel::currentChanged, this,
          [this](const QModelIndex& now) {
            if (!now.isValid()) return;
            branch_.reset();
            view_->select(std::nullopt);
            updateProperties();
          });
}

void MainWindow::connectFissures() {
  connect(actions_.placePoints, &QAction::toggled, &fissures_, &FissureEditor::setPlacing);
  connect(actions_.snap, &QAction::triggered, this, [this](bool on) {
    document_.setSnapping(on);
    updateFissureActions();
  });
  connect(actions_.openFissures, &QAction::triggered, this, &MainWindow::openFissures);
  connect(actions_.saveFissures, &QAction::triggered, this, &MainWindow::saveFissures);
  connect(actions_.review, &QAction::triggered, this, [this] {
    review_.start();
    ctViews_->slice(SlicePlane::Sagittal).setFocus();
  });
  connect(actions_.looksRight, &QAction::triggered, &review_, &ReviewWalk::looksRight);
  connect(actions_.editHere, &QAction::triggered, this, [this] {
    review_.editHere();
    ctViews_->slice(SlicePlane::Sagittal).setFocus();
  });
  connect(actions_.acceptFissures, &QAction::triggered, &review_, &ReviewWalk::accept);
  connect(&review_, &ReviewWalk::changed, this, [this] {
    updateSteps();
    updateActions();
  });
  connect(&fissures_, &FissureEditor::changed, this, [this] {
    actions_.placePoints->setChecked(fissures_.placing());
    updateSteps();
    updateActions();
  });
}

void MainWindow::goTo(Step step) {
  if (step != AirwaysStep) closeComparison();
  if (step != LungsStep) lungsPanel_->endPreview();
  activateLungTools(step == LungsStep);
  if (!document_.jobs().busy()) document_.followLungs();
  if (step != OpenStep) leaveSeries();
  fissureViews_->setActive(step == LobesStep);
  if (step != LobesStep) review_.stop();
  if (step != BreathingStep) regions_.setPlacing(RegionEditor::Placing::Nothing);
  steps_[step]->setChecked(true);
  panels_->setCurrentIndex(step);
  showBreathing();
  updateActions();
}

void MainWindow::showSteps() {
  const LungModel& model = document_.model();
  // With surfaces or a tree alone there are no lungs to find, with lobes alone none to split.
  const bool mayComeByCt = model.ct || (!model.surfaces && !document_.tree());
  steps_[LungsStep]->setVisible(mayComeByCt);
  steps_[LobesStep]->setVisible(mayComeByCt || wholeLungsOf(model));
  int number = 0;
  for (std::size_t i = 0; i < steps_.size(); ++i) {
    const bool there = !steps_[i]->isHidden();
    if (there) steps_[i]->setNumber(++number);
    actions_.steps[i]->setVisible(there);
    actions_.steps[i]->setShortcut(there ? QKeySequence(QString::number(number)) : QKeySequence());
  }
}

void MainWindow::showSnapshot() {
  const Snapshot& snapshot = document_.snapshot();
  const auto tree = document_.tree();
  const bool newThings = snapshot.model.surfaces != shownSurfaces_ || tree != shownTree_ ||
                         snapshot.model.ct != shownCt_ || snapshot.model.labels != shownLabels_;
  if (newThings) {
    branch_.reset();
    structures_.show(snapshot);
    showScene();
    chart_->show(snapshot.figures ? snapshot.figures->branchesOfGeneration
                                  : std::vector<std::size_t>());
    if (const auto airways = structures_.rowOfAirways()) {
      structureView_->setCurrentIndex(structures_.index(*airways));
    } else if (structures_.rowCount() > 0) {
      structureView_->setCurrentIndex(structures_.index(0));
    }
  }
  showTitle();
  showBreathing();
  openPanel_->show(document_);
  status_->setWarnings(warningsOf(snapshot));
  updateProperties();
  showSteps();
  updateSteps();
  updateActions();
}

void MainWindow::showScene() {
  const Snapshot& snapshot = document_.snapshot();
  const auto tree = document_.tree();
  const bool wasEmpty = !shownSurfaces_ && !shownTree_ && !shownCt_;
  const bool otherSurfaces = snapshot.model.surfaces != shownSurfaces_;
  // Lungs of the same CT, and the lobes of lungs that are shown, are seen from where one stands.
  const auto whole = wholeLungsOf(snapshot.model);
  const bool corrected = whole && shownWhole_ && snapshot.model.ct && snapshot.model.ct == shownCt_;
  const bool otherLungs = otherSurfaces && (!whole || whole != shownWhole_) && !corrected;
  shownWhole_ = whole;
  if (otherSurfaces) view_->setSurfaces(sceneSurfaces(snapshot.model.surfaces));
  auto labels = snapshot.model.labels ? snapshot.model.labels : snapshot.lungLabels;
  if (const auto draft = lungEditor_.draft()) labels = draft;
  sliceViews_.show(snapshot.model.ct, labels);
  sliceBar_->setVisible(snapshot.model.ct != nullptr);
  viewBar_->setDeepest(
      snapshot.figures ? static_cast<int>(snapshot.figures->branchesOfGeneration.size()) - 1 : 0);
  viewBar_->setLobes(snapshot.model.surfaces != nullptr);
  view_->setOptions(viewBar_->applied(view_->options()));
  shownSurfaces_ = snapshot.model.surfaces;
  shownTree_ = tree;
  shownCt_ = snapshot.model.ct;
  shownLabels_ = snapshot.model.labels;
  applyVisibility();
  const bool empty = !shownSurfaces_ && !shownTree_ && !shownCt_;
  showViews();
  if (empty) return;
  if (wasEmpty) goTo(shownCt_ ? LungsStep : shownWhole_ ? LobesStep : AirwaysStep);
  if (wasEmpty || otherLungs) {
    view_->look(FirstView);
  } else if (!shownSurfaces_) {
    view_->resetView();  // only the tree says how large the organ is
  }
}

void MainWindow::applyVisibility() {
  bool airways = true;
  std::set<Side> lungs;
  for (int row = 0; row < structures_.rowCount(); ++row) {
    const auto& structure = structures_.structure(row);
    if (structure.kind == StructureModel::Kind::Surface) {
      view_->setSurfaceVisible(structure.surface, structure.visible);
      view_->setSurfaceDensity(structure.surface, structure.density);
      if (structure.visible) lungs.insert(structure.side);
    } else if (structure.kind == StructureModel::Kind::Airways) {
      airways = structure.visible;
    }
  }
  fissureViews_->setVisible(lungs);
  view_->setTree(airways ? treeToShow() : nullptr);
  if (shownBreath_) showMoment();
  if (!airways) branch_.reset();
  view_->select(branch_);
}

void MainWindow::selectBranch(std::optional<std::size_t> branch) {
  branch_ = branch;
  view_->select(branch_);
  updateProperties();
  updateActions();
}

void MainWindow::walk(Neighbour where) {
  const auto tree = document_.tree();
  if (!tree || tree->empty()) return;
  selectBranch(branch_ ? neighbour(*tree, *branch_, where) : 0);
}

void MainWindow::probe(std::optional<std::size_t> branch) {
  if (!branch || !document_.snapshot().figures) {
    status_->probe({});
    return;
  }
  const Branch& b = (*document_.tree())[*branch];
  status_->probe(tr("Branch %1   %2   generation %3   diameter %4")
                     .arg(grouped(*branch), capitalised(longName(b.lobe)))
                     .arg(document_.snapshot().figures->generation[*branch])
                     .arg(withUnit(2.0 * b.radiusMm, 2, "mm")));
}

void MainWindow::probePoint(const std::optional<Vec3>& point) {
  status_->probe(point && !sliceViews_.empty() ? sliceViews_.probe(*point) : QString());
}

void MainWindow::cancel() {
  if (lungEditor_.stroking()) {
    lungEditor_.abandon();
  } else if (lungEditor_.tool() != LungEditor::Tool::None) {
    lungEditor_.setTool(LungEditor::Tool::None);
  } else if (fissures_.placing()) {
    fissures_.setPlacing(false);
  } else if (regions_.placing() != RegionEditor::Placing::Nothing) {
    regions_.setPlacing(RegionEditor::Placing::Nothing);
  } else if (review_.active()) {
    review_.stop();
  } else if (document_.jobs().busy()) {
    document_.jobs().cancel();
    status_->say(tr("Stopping..."));
  } else if (comparing()) {
    closeComparison();
  } else {
    selectBranch(std::nullopt);
  }
}

void MainWindow::saveTree() {
  const QString format = exportPanel_->format();
  goTo(ExportStep);
  askWhereToSave(this, tr("Save the tree"),
                 QStringLiteral("%1 (*.%2)").arg(format.toUpper(), format), format,
                 [this](const QString& name) { document_.saveTree(pathOf(name)); });
}

void MainWindow::openFissures() {
  errorCard_->hide();
  goTo(LobesStep);
  askForFile(this, tr("Open fissures"), {tr("Fissures (*.json *.fcsv *.csv)"), tr("All files (*)")},
             [this](const QString& name) { document_.openFissures(pathOf(name)); });
}

void MainWindow::saveFissures() {
  errorCard_->hide();
  askWhereToSave(this, tr("Save the fissures"),
                 tr("Pneuma, everything (*.json);;3D Slicer markups, points (*.mrk.json);;"
                    "3D Slicer, points (*.fcsv);;Chest Imaging Platform, points (*.csv)"),
                 QStringLiteral("json"),
                 [this](const QString& name) { document_.saveFissures(pathOf(name)); });
}

void MainWindow::savePicture() {
  askWhereToSave(this, tr("Save the picture"), tr("PNG picture (*.png)"), QStringLiteral("png"),
                 [this](const QString& name) {
                   QBuffer png;
                   png.open(QIODevice::WriteOnly);
                   view_->picture().save(&png, "PNG");
                   document_.saveFile(pathOf(name), png.data().toStdString());
                 });
}

void MainWindow::dragEnterEvent(QDragEnterEvent* event) {
  if (event->mimeData()->hasUrls()) event->acceptProposedAction();
}

void MainWindow::dropEvent(QDropEvent* event) {
  std::vector<std::filesystem::path> paths;
  for (const QUrl& url : event->mimeData()->urls()) {
    if (url.isLocalFile()) paths.push_back(pathOf(url.toLocalFile()));
  }
  open(std::move(paths));
}

}  // namespace pneuma
