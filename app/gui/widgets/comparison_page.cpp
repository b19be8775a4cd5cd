#include "widgets/comparison_page.h"

#include <QCheckBox>
#include <QHBoxLayout>
#include <QHeaderView>
#include <QLabel>
#include <QPushButton>
#include <QTableWidget>
#include <QTimer>
#include <QVBoxLayout>
#include <QVariant>
#include <algorithm>
#include <utility>

#include "document/comparison_table.h"
#include "document/text.h"
#include "widgets/action_button.h"
#include "widgets/actions.h"
#include "widgets/linked_cameras.h"
#include "widgets/scene_view.h"
#include "widgets/theme.h"

namespace pneuma {

namespace {

constexpr int FigureHeight = 22;
constexpr int LeastTable = 200;
constexpr int MostTable = 320;
constexpr double TableShare = 0.36;  ///< of the page's height

QTableWidgetItem* item(const QString& text, const QString& tip = {}) {
  auto* made = new QTableWidgetItem(text);
  made->setToolTip(tip);
  made->setFlags(Qt::ItemIsEnabled | Qt::ItemIsSelectable);
  return made;
}

QTableWidget* makeTable() {
  auto* table = new QTableWidget;
  table->setObjectName(QStringLiteral("comparisonTable"));
  table->setAccessibleName(QObject::tr("Figures of the compared trees"));
  table->verticalHeader()->hide();
  table->verticalHeader()->setDefaultSectionSize(FigureHeight);
  table->verticalHeader()->setMinimumSectionSize(FigureHeight);
  table->setShowGrid(false);
  table->setAlternatingRowColors(true);
  table->setFrameShape(QFrame::NoFrame);
  table->setEditTriggers(QAbstractItemView::NoEditTriggers);
  table->setSelectionBehavior(QAbstractItemView::SelectRows);
  table->setHorizontalScrollBarPolicy(Qt::ScrollBarAlwaysOff);
  table->horizontalHeader()->setHighlightSections(false);
  table->horizontalHeader()->setTextElideMode(Qt::ElideRight);
  return table;
}

}  // namespace

ComparisonPage::ComparisonPage(Document& document, const Actions& actions, QWidget* parent)
    : QWidget(parent), document_(document) {
  setObjectName(QStringLiteral("comparison"));
  setAttribute(Qt::WA_StyledBackground);
  auto* column = new QVBoxLayout(this);
  column->setContentsMargins(0, 0, 0, 0);
  column->setSpacing(0);
  row_ = new QHBoxLayout;
  row_->setSpacing(1);
  column->addLayout(row_, 1);
  table_ = makeTable();
  column->addWidget(table_);
  column->addWidget(makeFoot(actions));
}

ComparisonPage::~ComparisonPage() {
  // Before the views whose cameras it watches.
  delete linked_;
}

ComparisonPage::Column ComparisonPage::makeColumn(std::size_t method) {
  const GrowthMethod& of = growthMethods()[method];
  const QString name = qtText(of.name);
  Column made;
  auto* frame = new QWidget;
  auto* lines = new QVBoxLayout(frame);
  lines->setContentsMargins(0, 0, 0, 0);
  lines->setSpacing(0);
  auto* head = new QWidget;
  head->setProperty("role", "comparedHead");
  head->setAttribute(Qt::WA_StyledBackground);
  auto* row = new QHBoxLayout(head);
  row->setContentsMargins(10, 5, 8, 5);
  auto* names = new QVBoxLayout;
  names->setSpacing(0);
  made.title = new QLabel(qtText(of.title));
  made.title->setToolTip(qtText(of.citation));
  made.title->setMinimumWidth(40);
  made.count = new QLabel;
  made.count->setObjectName(QStringLiteral("comparedCount_") + name);
  made.count->setProperty("role", "dim");
  names->addWidget(made.title);
  names->addWidget(made.count);
  row->addLayout(names, 1);
  made.keep = new QPushButton(tr("Keep this tree"));
  made.keep->setObjectName(QStringLiteral("keep_") + name);
  made.keep->setAccessibleName(tr("Keep the tree of %1").arg(qtText(of.title)));
  made.keep->setToolTip(tr("Makes it the airways of this case; this can be undone"));
  made.keep->setProperty("method", made.title->text());
  row->addWidget(made.keep);
  connect(made.keep, &QPushButton::clicked, this,
          [this, method] { document_.keepCompared(method); });
  made.view = new SceneView;
  made.view->setObjectName(QStringLiteral("compared_") + name);
  made.view->canvas()->setObjectName(QStringLiteral("comparedCanvas_") + name);
  made.view->canvas()->setAccessibleName(tr("3-D view of %1").arg(qtText(of.title)));
  for (QLabel* title : made.view->findChildren<QLabel*>(QStringLiteral("viewTitle"))) {
    title->setObjectName(QStringLiteral("comparedViewTitle"));
  }
  lines->addWidget(head);
  lines->addWidget(made.view, 1);
  row_->addWidget(frame, 1);
  return made;
}

QWidget* ComparisonPage::makeFoot(const Actions& actions) {
  auto* foot = new QWidget;
  foot->setObjectName(QStringLiteral("comparisonFoot"));
  foot->setAttribute(Qt::WA_StyledBackground);
  auto* row = new QHBoxLayout(foot);
  row->setContentsMargins(12, 6, 12, 6);
  row->setSpacing(8);
  all_ = new QCheckBox(tr("All figures"));
  all_->setObjectName(QStringLiteral("allFigures"));
  connect(all_, &QCheckBox::toggled, this, &ComparisonPage::fillTable);
  note_ = new QLabel;
  note_->setProperty("role", "dim");
  note_->setWordWrap(true);
  auto* save = new QPushButton(tr("Save table..."));
  save->setObjectName(QStringLiteral("saveComparison"));
  save->setToolTip(tr("All figures of the trees and of every lobe, as CSV"));
  connect(save, &QPushButton::clicked, this, &ComparisonPage::tableWanted);
  auto* close = new QPushButton(tr("Close"));
  close->setObjectName(QStringLiteral("closeComparison"));
  close->setToolTip(tr("Back to the usual views; no tree is kept"));
  connect(close, &QPushButton::clicked, this, &ComparisonPage::closed);
  row->addWidget(all_);
  row->addWidget(note_, 1);
  row->addWidget(save);
  row->addWidget(actionButton(actions.copyCommand, "copyComparison"));
  row->addWidget(close);
  return foot;
}

void ComparisonPage::show(const std::vector<SceneSurface>& surfaces, const SceneOptions& options,
                          ViewDirection from) {
  const MethodComparison& comparison = *document_.comparison();
  if (columns_.empty()) {
    std::vector<SceneView*> views;
    for (std::size_t i = 0; i < comparison.growths.size(); ++i) {
      columns_.push_back(makeColumn(i));
      views.push_back(columns_.back().view);
    }
    linked_ = new LinkedCameras(std::move(views), this);
  }
  std::vector<std::shared_ptr<const AirwayTree>> trees;
  for (const ComparedTree& tree : comparison.measured.trees) trees.push_back(tree.opened.tree);
  for (std::size_t i = 0; i < columns_.size(); ++i) {
    const Column& column = columns_[i];
    column.count->setText(
        QStringLiteral("%1, %2").arg(counted(trees[i]->size(), "branch", "branches"),
                                     secondsText(comparison.growths[i]->growSeconds)));
    column.view->setSurfaces(surfaces);
    column.view->setTree(trees[i]);
    column.view->setPeers(trees);
  }
  shown_ = true;
  setOptions(options);
  for (const Column& column : columns_) column.view->look(from);
  fillTable();
}

QString ComparisonPage::lookingFrom() const {
  QStringList texts;
  for (const Column& column : columns_) texts << viewText(column.view->lookingFrom());
  return texts.join(QLatin1String("; "));
}

void ComparisonPage::elideTitle(const Column& column) {
  const QString whole = column.keep->property("method").toString();
  column.title->setText(
      column.title->fontMetrics().elidedText(whole, Qt::ElideRight, column.title->width()));
}

void ComparisonPage::resizeEvent(QResizeEvent* event) {
  QWidget::resizeEvent(event);
  // Once the columns have their new widths.
  QTimer::singleShot(0, this, [this] {
    for (const Column& column : columns_) elideTitle(column);
  });
  table_->setFixedHeight(
      std::clamp(static_cast<int>(TableShare * height()), LeastTable, MostTable));
}

void ComparisonPage::clear() {
  if (!std::exchange(shown_, false)) return;
  for (const Column& column : columns_) {
    column.view->setPeers({});
    column.view->setTree(nullptr);
    column.view->setSurfaces({});
  }
}

void ComparisonPage::setOptions(const SceneOptions& options) {
  SceneOptions narrow = options;
  // The slider for generations is of the tree that was shown before.
  narrow.maxGeneration = SceneOptions{}.maxGeneration;
  // The structures beside the views tell the lobes' colours.
  narrow.legend = options.legend && options.colourBy != ColourBy::Lobe;
  for (const Column& column : columns_) column.view->setOptions(narrow);
}

void ComparisonPage::fillTable() {
  const auto comparison = document_.comparison();
  if (!comparison) return;
  const auto lines = comparisonLines(
      *comparison, all_->isChecked() ? ComparisonFigures::All : ComparisonFigures::Main);
  const int methods = static_cast<int>(comparison->growths.size());
  QStringList headings = {tr("Figure")};
  for (const auto& growth : comparison->growths) {
    headings << qtText(growthMethod(growth->options).title);
  }
  headings << tr("Published");
  table_->setColumnCount(methods + 2);
  table_->setHorizontalHeaderLabels(headings);
  for (int i = 0; i < methods + 2; ++i) {
    table_->horizontalHeaderItem(i)->setTextAlignment(Qt::AlignLeft | Qt::AlignVCenter);
    table_->horizontalHeaderItem(i)->setToolTip(
        i <= methods ? headings[i]
                     : tr("Of both lungs of an adult; each source where the mouse rests"));
  }
  table_->setRowCount(static_cast<int>(lines.size()));
  QStringList texts;
  bool anySide = false;
  for (int row = 0; row < table_->rowCount(); ++row) {
    const ComparisonLine& line = lines[static_cast<std::size_t>(row)];
    table_->setItem(row, 0, item(line.label));
    for (int i = 0; i < methods; ++i) {
      const BandSide side = line.sides[static_cast<std::size_t>(i)];
      const bool off = side == BandSide::Below || side == BandSide::Above;
      anySide = anySide || off;
      const QString arrow = side == BandSide::Below   ? QStringLiteral("  ↓")
                            : side == BandSide::Above ? QStringLiteral("  ↑")
                                                      : QString();
      auto* cell = item(line.values[i] + arrow,
                        off ? tr("%1 the published values")
                                  .arg(side == BandSide::Below ? tr("Below") : tr("Above"))
                            : QString());
      if (off) cell->setForeground(currentTheme().look);
      table_->setItem(row, i + 1, cell);
    }
    table_->setItem(row, methods + 1, item(line.published, line.source));
    texts << QStringLiteral("%1: %2").arg(line.label, line.values.join(QStringLiteral(", ")));
  }
  table_->horizontalHeader()->setSectionResizeMode(QHeaderView::Stretch);
  table_->horizontalHeader()->setSectionResizeMode(0, QHeaderView::ResizeToContents);
  text_ = texts.join(QLatin1Char('\n'));
  note_->setText(anySide ? tr("↓ ↑ below or above the published values") : QString());
}

}  // namespace pneuma
