#include <QStackedWidget>

#include "io/input_files.h"
#include "io/volume_file.h"
#include "widgets/commands.h"
#include "widgets/dialogs.h"
#include "widgets/error_card.h"
#include "widgets/main_window.h"
#include "widgets/series_page.h"

// Which series of several is opened, and where the CT of a project is that moved.
namespace pneuma {

namespace {

/// A CT that is gone cannot be asked; its name says what it was.
bool wasFolder(const std::filesystem::path& ct) {
  const std::string extension = ct.extension().string();
  return !isVolumeFile(ct) && extension != ".zip" && extension != ".dcm";
}

}  // namespace

void MainWindow::connectOpening() {
  connect(&document_, &Document::seriesToChoose, this, &MainWindow::showSeries);
  connect(&document_, &Document::seriesDrawn, this,
          [this](const SeriesList& list, int row, const Picture& picture) {
            seriesPage_->model().setPicture(list, row, picture);
          });
  connect(seriesPage_, &SeriesPage::chosen, this,
          [this](const SeriesList& list, int row, bool fillGaps) {
            errorCard_->hide();
            document_.openSeries(list, row, fillGaps);
          });
  connect(seriesPage_, &SeriesPage::left, this, &MainWindow::leaveSeries);
  connect(actions_.otherSeries, &QAction::triggered, this, [this] {
    errorCard_->hide();
    document_.listSeries();
  });
  connect(actions_.locateCt, &QAction::triggered, this, [this] {
    const bool folder = wasFolder(document_.model().ctSource->path);
    askForCt(this, folder, [this](const QString& name) {
      errorCard_->hide();
      document_.locateCt(name.toStdString());
    });
  });
  connect(&document_, &Document::ctMissed, this,
          [this](const QString& title, const QString& sentence) {
            errorCard_->show(title, sentence, *actions_.locateCt);
          });
  connect(&document_, &Document::ctFound, this, [this](bool wasSaved) {
    // Later: the job that found it is not over yet. Other work is the user's to save.
    if (!wasSaved || document_.projectPath().empty()) return;
    QMetaObject::invokeMethod(
        this, [this] { saveProject(); }, Qt::QueuedConnection);
  });
}

void MainWindow::updateOpeningActions() {
  const bool busy = document_.jobs().busy();
  const QString wait = tr("A job is running");
  allow(*actions_.otherSeries, document_.hasOtherSeries() && !busy,
        tr("Shows all series of the folder, to open another one"),
        busy ? wait : tr("Open a CT of DICOM slices first"));
  allow(*actions_.locateCt, document_.ctMissing() && !busy,
        tr("Says where the CT of the project is now"), busy ? wait : tr("No CT is missing"));
}

void MainWindow::showViews() {
  const LungModel& model = document_.model();
  const bool empty = !model.surfaces && !document_.tree() && !model.ct;
  centre_->setCurrentIndex(empty ? 0 : 1);
  seriesPage_->clear();
}

void MainWindow::showSeries(const SeriesList& list) {
  goTo(OpenStep);
  seriesPage_->show(list);
  centre_->setCurrentWidget(seriesPage_);
  document_.drawSeries(list);
}

void MainWindow::leaveSeries() {
  document_.stopDrawing();
  if (centre_->currentWidget() == seriesPage_) showViews();
}

}  // namespace pneuma
