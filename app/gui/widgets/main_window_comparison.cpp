#include <QStackedWidget>

#include "widgets/comparison_page.h"
#include "widgets/dialogs.h"
#include "widgets/error_card.h"
#include "widgets/main_window.h"
#include "widgets/scene_view.h"
#include "widgets/view_bar.h"

// The page on which methods are compared.
namespace pneuma {

namespace {

constexpr int LookingPage = 1;

}  // namespace

void MainWindow::connectComparison() {
  comparisonPage_ = new ComparisonPage(document_, actions_);
  centre_->addWidget(comparisonPage_);
  connect(actions_.compareMethods, &QAction::triggered, this, [this] {
    errorCard_->hide();
    goTo(AirwaysStep);
    document_.compareMethods();
  });
  connect(&document_, &Document::compared, this, &MainWindow::showComparison);
  connect(&document_, &Document::changed, this, [this] {
    if (comparing() && !document_.comparison()) closeComparison();
    if (!comparing()) comparisonPage_->clear();
  });
  connect(comparisonPage_, &ComparisonPage::closed, this, &MainWindow::closeComparison);
  connect(comparisonPage_, &ComparisonPage::tableWanted, this, [this] {
    askWhereToSave(this, tr("Save the table"), tr("Table (*.csv)"), QStringLiteral("csv"),
                   [this](const QString& name) { document_.saveComparison(name.toStdString()); });
  });
}

bool MainWindow::comparing() const { return centre_->currentWidget() == comparisonPage_; }

void MainWindow::showComparison() {
  goTo(AirwaysStep);
  std::vector<SceneSurface> surfaces;
  if (const auto& lobes = document_.model().surfaces) {
    for (const LobeSurface& surface : *lobes) surfaces.push_back({surface.lobe, surface.mesh});
  }
  comparisonPage_->show(surfaces, view_->options(), view_->lookingFrom());
  centre_->setCurrentWidget(comparisonPage_);
  updateActions();
}

void MainWindow::closeComparison() {
  if (!comparing()) return;
  centre_->setCurrentIndex(LookingPage);
  comparisonPage_->clear();
  updateActions();
}

}  // namespace pneuma
