#include "widgets/series_page.h"

#include <QCheckBox>
#include <QHBoxLayout>
#include <QHeaderView>
#include <QKeyEvent>
#include <QLabel>
#include <QPainter>
#include <QPixmap>
#include <QPushButton>
#include <QStyledItemDelegate>
#include <QTableView>
#include <QVBoxLayout>
#include <QVariant>
#include <algorithm>
#include <array>

#include "widgets/theme.h"

namespace pneuma {

namespace {

constexpr int SeriesRowHeight = SeriesModel::PictureSize + 12;
constexpr int NarrowestDescription = 130;
constexpr int NarrowestWhy = 240;
constexpr double DescriptionShare = 0.32;  ///< of what the columns of figures leave

/// Of the columns whose content is short; 0: they share what is left.
constexpr std::array<int, SeriesModel::ColumnCount> SeriesColumns = {
    SeriesModel::PictureSize + 16, 0, 56, 60, 130, 130, 96, 0};

/// A picture as it is: selecting a row must not colour it.
class PicturePainter : public QStyledItemDelegate {
 public:
  using QStyledItemDelegate::QStyledItemDelegate;

  void paint(QPainter* painter, const QStyleOptionViewItem& option,
             const QModelIndex& index) const override {
    if (option.state.testFlag(QStyle::State_Selected)) {
      painter->fillRect(option.rect, currentTheme().selection);
    }
    const auto picture = index.data(Qt::DecorationRole).value<QPixmap>();
    if (picture.isNull()) return;
    QRectF place(QPointF(), QSizeF(picture.size()) / picture.devicePixelRatio());
    place.moveCenter(QRectF(option.rect).center());
    painter->setRenderHint(QPainter::SmoothPixmapTransform);
    painter->drawPixmap(place, picture, QRectF(picture.rect()));
  }
};

}  // namespace

SeriesPage::SeriesPage(QWidget* parent) : QWidget(parent) {
  setObjectName(QStringLiteral("seriesPage"));
  setAttribute(Qt::WA_StyledBackground);
  auto* column = new QVBoxLayout(this);
  column->setContentsMargins(24, 20, 24, 18);
  column->setSpacing(10);
  auto* title = new QLabel(tr("Which series?"));
  title->setProperty("role", "title");
  sentence_ = new QLabel;
  sentence_->setObjectName(QStringLiteral("seriesSentence"));
  sentence_->setProperty("role", "dim");
  sentence_->setWordWrap(true);

  table_ = new QTableView;
  table_->setObjectName(QStringLiteral("seriesTable"));
  table_->setAccessibleName(tr("Series"));
  table_->setModel(&model_);
  table_->setSelectionBehavior(QAbstractItemView::SelectRows);
  table_->setSelectionMode(QAbstractItemView::SingleSelection);
  table_->setEditTriggers(QAbstractItemView::NoEditTriggers);
  table_->setIconSize({SeriesModel::PictureSize, SeriesModel::PictureSize});
  table_->setShowGrid(false);
  table_->setTabKeyNavigation(false);
  table_->setHorizontalScrollMode(QAbstractItemView::ScrollPerPixel);
  table_->setVerticalScrollMode(QAbstractItemView::ScrollPerPixel);
  table_->verticalHeader()->hide();
  table_->verticalHeader()->setDefaultSectionSize(SeriesRowHeight);
  table_->horizontalHeader()->setDefaultAlignment(Qt::AlignLeft | Qt::AlignVCenter);
  table_->horizontalHeader()->setHighlightSections(false);
  table_->setItemDelegateForColumn(SeriesModel::Picture, new PicturePainter(table_));
  table_->installEventFilter(this);
  table_->viewport()->installEventFilter(this);

  why_ = new QLabel;
  why_->setObjectName(QStringLiteral("seriesWhy"));
  why_->setTextFormat(Qt::PlainText);
  why_->setWordWrap(true);
  why_->setTextInteractionFlags(Qt::TextSelectableByMouse);
  why_->setMinimumHeight(2 * why_->fontMetrics().lineSpacing());
  why_->setAlignment(Qt::AlignLeft | Qt::AlignTop);
  fill_ = new QCheckBox(tr("Fill in the missing slices"));
  fill_->setObjectName(QStringLiteral("seriesFill"));
  fill_->setToolTip(tr("From the slices on both sides; the CT then counts as corrected"));
  auto* leave = new QPushButton(tr("Cancel"));
  leave->setObjectName(QStringLiteral("seriesCancel"));
  open_ = new QPushButton(tr("Open"));
  open_->setObjectName(QStringLiteral("seriesOpen"));
  open_->setProperty("role", "primary");

  auto* buttons = new QHBoxLayout;
  buttons->setSpacing(8);
  buttons->addWidget(fill_);
  buttons->addStretch();
  buttons->addWidget(leave);
  buttons->addWidget(open_);
  column->addWidget(title);
  column->addWidget(sentence_);
  column->addWidget(table_, 1);
  column->addWidget(why_);
  column->addLayout(buttons);

  connect(table_->selectionModel(), &QItemSelectionModel::currentChanged, this,
          &SeriesPage::follow);
  connect(fill_, &QCheckBox::toggled, this, &SeriesPage::follow);
  connect(table_, &QTableView::doubleClicked, this, &SeriesPage::open);
  connect(open_, &QPushButton::clicked, this, &SeriesPage::open);
  connect(leave, &QPushButton::clicked, this, &SeriesPage::left);
}

void SeriesPage::show(const SeriesList& list) {
  model_.show(list);
  sentence_->setText(list.sentence());
  fill_->setChecked(false);
  table_->setCurrentIndex(model_.index(std::max(0, list.chosen), SeriesModel::Description));
  fitColumns();
  follow();
  table_->setFocus();
}

void SeriesPage::clear() { model_.show({}); }

void SeriesPage::follow() {
  const QModelIndex current = table_->currentIndex();
  if (!current.isValid()) return;
  const SeriesRow& row = model_.list().rows[static_cast<std::size_t>(current.row())];
  const bool gaps = row.use == SeriesRow::Use::WithGapsOnly;
  why_->setText(row.why);
  fill_->setVisible(gaps);
  open_->setEnabled(row.canOpen() && (!gaps || fill_->isChecked()));
  open_->setToolTip(open_->isEnabled() ? tr("Open this series (Return)") : row.why);
}

void SeriesPage::open() {
  if (!open_->isEnabled()) return;
  emit chosen(model_.list(), table_->currentIndex().row(), fill_->isChecked());
}

bool SeriesPage::eventFilter(QObject* watched, QEvent* event) {
  if (watched == table_ && event->type() == QEvent::KeyPress) {
    const int key = static_cast<QKeyEvent*>(event)->key();
    if (key == Qt::Key_Return || key == Qt::Key_Enter) {
      open();
      return true;
    }
    if (key == Qt::Key_Escape) {
      emit left();
      return true;
    }
  }
  if (watched == table_->viewport() && event->type() == QEvent::Resize) fitColumns();
  return QWidget::eventFilter(watched, event);
}

void SeriesPage::fitColumns() {
  int left = table_->viewport()->width();
  for (int column = 0; column < SeriesModel::ColumnCount; ++column) {
    const int width = SeriesColumns[static_cast<std::size_t>(column)];
    if (width > 0) table_->setColumnWidth(column, width);
    left -= width;
  }
  const int description = std::max(NarrowestDescription, static_cast<int>(left * DescriptionShare));
  table_->setColumnWidth(SeriesModel::Description, description);
  table_->setColumnWidth(SeriesModel::Why, std::max(NarrowestWhy, left - description));
}

}  // namespace pneuma
