#include <QHBoxLayout>
#include <QLabel>
#include <QMenuBar>
#include <QResizeEvent>
#include <QScrollArea>
#include <QStackedWidget>
#include <QToolButton>
#include <QVBoxLayout>
#include <QVariant>
#include <utility>
#include <vector>

#include "widgets/action_button.h"
#include "widgets/breath_bar.h"
#include "widgets/breath_chart.h"
#include "widgets/breathing_panel.h"
#include "widgets/ct_views.h"
#include "widgets/error_card.h"
#include "widgets/export_panel.h"
#include "widgets/fissure_views.h"
#include "widgets/generation_chart.h"
#include "widgets/growth_panel.h"
#include "widgets/heading.h"
#include "widgets/lobes_panel.h"
#include "widgets/lungs_panel.h"
#include "widgets/main_window.h"
#include "widgets/open_panel.h"
#include "widgets/room.h"
#include "widgets/scene_view.h"
#include "widgets/series_page.h"
#include "widgets/sheet_card.h"
#include "widgets/slice_bar.h"
#include "widgets/start_page.h"
#include "widgets/status_strip.h"
#include "widgets/step_button.h"
#include "widgets/structure_view.h"
#include "widgets/view_bar.h"

// Where things are in the window; what they do is in main_window.cpp.
namespace pneuma {

namespace {

constexpr int HeaderHeight = 46;
constexpr int RailWidth = 248;
constexpr int RightWidth = 316;
constexpr int NarrowestBars = 500;

/// Makes steps lower while their window is, and lets the column on the right go where it would
/// leave no room for the views.
class SmallWindow : public QObject {
 public:
  SmallWindow(QWidget* window, std::vector<StepButton*> steps, QAction* rightColumn)
      : QObject(window), steps_(std::move(steps)), rightColumn_(rightColumn) {
    window->installEventFilter(this);
  }

 protected:
  bool eventFilter(QObject* watched, QEvent* event) override {
    if (event->type() == QEvent::Resize) {
      const QSize size = static_cast<QResizeEvent*>(event)->size();
      for (StepButton* step : steps_) step->setCompact(size.height() < LowWindow);
      // Only where the limit is crossed: whoever shows or hides it otherwise is left alone.
      const bool narrow = size.width() < NarrowWindow;
      if (narrow != narrow_) rightColumn_->setChecked(!narrow);
      narrow_ = narrow;
    }
    return QObject::eventFilter(watched, event);
  }

 private:
  static constexpr int LowWindow = 880;
  static constexpr int NarrowWindow = 1100;

  std::vector<StepButton*> steps_;
  QAction* rightColumn_;
  bool narrow_ = false;
};

QWidget* styled(const char* name) {
  auto* widget = new QWidget;
  widget->setObjectName(QString::fromUtf8(name));
  widget->setAttribute(Qt::WA_StyledBackground);
  return widget;
}

}  // namespace

QWidget* MainWindow::makeHeader() {
  QWidget* header = styled("header");
  header->setFixedHeight(HeaderHeight);
  auto* row = new QHBoxLayout(header);
  row->setContentsMargins(16, 0, 12, 0);
  auto* brand = new QLabel(QStringLiteral("Pneuma"));
  brand->setObjectName(QStringLiteral("brand"));
  auto* menus = new QMenuBar;
  menus->setObjectName(QStringLiteral("menus"));
  menus->setNativeMenuBar(false);
  menus->setSizePolicy(QSizePolicy::Maximum, QSizePolicy::Maximum);
  fillMenus(*menus, actions_);
  caseName_ = new QLabel;
  caseName_->setObjectName(QStringLiteral("caseName"));
  caseName_->setTextFormat(Qt::PlainText);
  themeToggle_ = new QToolButton;
  themeToggle_->setObjectName(QStringLiteral("themeToggle"));
  themeToggle_->setIconSize({18, 18});
  themeToggle_->setProperty("role", "quiet");
  themeToggle_->setToolTip(tr("Dark or light"));
  themeToggle_->setAccessibleName(tr("Dark or light theme"));
  connect(themeToggle_, &QToolButton::clicked, actions_.theme, &QAction::trigger);
  row->addWidget(brand);
  row->addSpacing(8);
  row->addWidget(menus);
  row->addStretch(1);
  row->addWidget(caseName_, 0, Qt::AlignVCenter);
  row->addStretch(1);
  auto* find = new QToolButton;
  find->setObjectName(QStringLiteral("findCommand"));
  find->setProperty("role", "find");
  find->setText(tr("Find a command   %1").arg(actions_.findCommand->shortcut().toString()));
  find->setToolTip(tr("Everything the window can do, by its name"));
  find->setFocusPolicy(Qt::TabFocus);
  connect(find, &QToolButton::clicked, actions_.findCommand, &QAction::trigger);
  row->addWidget(find);
  row->addSpacing(8);
  row->addWidget(themeToggle_);
  return header;
}

QWidget* MainWindow::makeRail() {
  QWidget* rail = styled("rail");
  rail->setFixedWidth(RailWidth);
  auto* column = new QVBoxLayout(rail);
  column->setContentsMargins(12, 14, 12, 12);
  column->setSpacing(4);
  column->addWidget(heading(tr("Steps")));
  static_assert(StepNames.size() == StepCount);
  panels_ = new QStackedWidget;
  for (int i = 0; i < StepCount; ++i) {
    const auto index = static_cast<std::size_t>(i);
    steps_[index] = new StepButton(i + 1, tr(StepNames[index]));
    steps_[index]->setObjectName(QStringLiteral("step") + QString::fromUtf8(StepNames[index]));
    column->addWidget(steps_[index]);
    connect(steps_[index], &QAbstractButton::clicked, this,
            [this, i] { goTo(static_cast<Step>(i)); });
  }
  new SmallWindow(this, {steps_.begin(), steps_.end()}, actions_.rightColumn);
  column->addSpacing(10);
  openPanel_ = new OpenPanel(actions_);
  exportPanel_ = new ExportPanel(document_, actions_);
  panels_->addWidget(openPanel_);
  lungsPanel_ = new LungsPanel(document_, lungEditor_, sliceViews_, actions_);
  panels_->addWidget(lungsPanel_);
  panels_->addWidget(new LobesPanel(document_, fissures_, review_, sliceViews_, actions_));
  panels_->addWidget(new GrowthPanel(document_, actions_));
  panels_->addWidget(new BreathingPanel(document_, regions_, actions_));
  panels_->addWidget(exportPanel_);
  column->addWidget(panels_, 1);
  column->addWidget(actionButton(actions_.copyCommand, "copyCommand", "quiet"));
  return rail;
}

QWidget* MainWindow::makeCentre() {
  auto* looking = new QWidget;
  auto* column = new QVBoxLayout(looking);
  column->setContentsMargins(0, 0, 0, 0);
  column->setSpacing(0);
  viewBar_ = new ViewBar(actions_);
  view_ = new SceneView;
  auto* bars = new QWidget;
  auto* barColumn = new QVBoxLayout(bars);
  barColumn->setContentsMargins(0, 0, 0, 0);
  barColumn->setSpacing(0);
  barColumn->addWidget(viewBar_);
  column->addWidget(bars);
  hideWhenNarrow(looking, {bars}, NarrowestBars);
  viewBar_->setVisible(view_->obstacle().isEmpty());
  sliceBar_ = new SliceBar(sliceViews_, actions_);
  sliceBar_->hide();
  ctViews_ = new CtViews(sliceViews_, view_, actions_);
  fissureViews_ = new FissureViews(fissures_, sliceViews_, *ctViews_, *view_, this);
  barColumn->addWidget(sliceBar_);
  column->addWidget(ctViews_, 1);
  breathBar_ = new BreathBar(player_, actions_);
  column->addWidget(breathBar_);
  centre_ = new QStackedWidget;
  centre_->setObjectName(QStringLiteral("centre"));
  centre_->addWidget(new StartPage(actions_));
  centre_->addWidget(looking);
  seriesPage_ = new SeriesPage;
  centre_->addWidget(seriesPage_);
  errorCard_ = new ErrorCard(centre_);
  return centre_;
}

QWidget* MainWindow::makeRightColumn() {
  auto* content = new QWidget;
  auto* column = new QVBoxLayout(content);
  column->setContentsMargins(12, 14, 12, 10);
  column->setSpacing(8);
  structureView_ = new StructureView;
  structureView_->setModel(&structures_);
  propertiesHeading_ = heading({});
  properties_ = new SheetCard;
  properties_->setObjectName(QStringLiteral("properties"));
  properties_->setAccessibleName(tr("Properties"));
  chart_ = new GenerationChart;
  chart_->setObjectName(QStringLiteral("generationChart"));
  column->addWidget(heading(tr("Structures")));
  column->addWidget(structureView_);
  column->addSpacing(8);
  column->addWidget(propertiesHeading_);
  column->addWidget(properties_);
  column->addSpacing(8);
  charts_ = new QStackedWidget;
  charts_->addWidget(chart_);
  charts_->addWidget(new BreathChart(player_));
  chartHeading_ = heading({});
  column->addWidget(chartHeading_);
  column->addWidget(charts_, 1);

  auto* scroll = new QScrollArea;
  scroll->setObjectName(QStringLiteral("rightColumn"));
  scroll->setAttribute(Qt::WA_StyledBackground);
  scroll->setWidget(content);
  scroll->setWidgetResizable(true);
  scroll->setFrameShape(QFrame::NoFrame);
  scroll->setHorizontalScrollBarPolicy(Qt::ScrollBarAlwaysOff);
  scroll->setFixedWidth(RightWidth);
  connect(actions_.rightColumn, &QAction::toggled, scroll, &QWidget::setVisible);
  return scroll;
}

MainWindow::MainWindow() : actions_(makeActions(this)) {
  setObjectName(QStringLiteral("mainWindow"));
  setWindowIcon(QIcon(QStringLiteral(":/icons/pneuma.svg")));
  setAcceptDrops(true);
  setMinimumSize(800, 480);

  auto* whole = new QWidget;
  auto* rows = new QVBoxLayout(whole);
  rows->setContentsMargins(0, 0, 0, 0);
  rows->setSpacing(0);
  auto* middle = new QHBoxLayout;
  middle->setSpacing(0);
  status_ = new StatusStrip(document_.jobs(), actions_);
  rows->addWidget(makeHeader());
  middle->addWidget(makeRail());
  middle->addWidget(makeCentre(), 1);
  middle->addWidget(makeRightColumn());
  rows->addLayout(middle, 1);
  rows->addWidget(status_);
  setCentralWidget(whole);

  connectActions();
  connectDocument();
  connectView();
  connectFissures();
  connectLungs();
  connectBreathing();
  connectProject();
  connectExport();
  connectCommands();
  connectOpening();
  connectComparison();
  goTo(OpenStep);
  showSnapshot();
  status_->say(tr("Ready"));
}

MainWindow::~MainWindow() = default;

}  // namespace pneuma
