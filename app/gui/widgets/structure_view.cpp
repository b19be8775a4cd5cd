#include "widgets/structure_view.h"

#include <QContextMenuEvent>
#include <QKeyEvent>
#include <QMenu>
#include <QMouseEvent>
#include <QPainter>
#include <QStyledItemDelegate>
#include <algorithm>
#include <iterator>

#include "document/structure_model.h"
#include "render/colour_map.h"
#include "widgets/icons.h"
#include "widgets/theme.h"

namespace pneuma {

namespace {

constexpr int DensityGap = 10;  ///< between how dense it is and its size
constexpr int RowHeight = 27;
constexpr int EyeLeft = 4;
constexpr int EyeSize = 16;
constexpr int Indent = 16;

QColor chipColour(StructureModel::Kind kind, Lobe lobe) {
  if (kind != StructureModel::Kind::Surface && kind != StructureModel::Kind::Airways) {
    return currentTheme().dim;
  }
  const Rgb colour = lobeColour(lobe, Palette::Pneuma);
  return QColor::fromRgbF(colour.r, colour.g, colour.b);
}

class RowPainter : public QStyledItemDelegate {
 public:
  using QStyledItemDelegate::QStyledItemDelegate;

  QSize sizeHint(const QStyleOptionViewItem&, const QModelIndex&) const override {
    return {200, RowHeight};
  }

  void paint(QPainter* painter, const QStyleOptionViewItem& option,
             const QModelIndex& index) const override {
    const Theme& theme = currentTheme();
    const QRect row = option.rect;
    painter->save();
    painter->setRenderHint(QPainter::Antialiasing);
    painter->setPen(Qt::NoPen);
    if (option.state.testFlag(QStyle::State_Selected)) {
      painter->setBrush(theme.selection);
      painter->drawRoundedRect(row, 6, 6);
    } else if (option.state.testFlag(QStyle::State_MouseOver)) {
      painter->setBrush(theme.card);
      painter->drawRoundedRect(row, 6, 6);
    }
    const bool visible = index.data(StructureModel::VisibleRole).toInt() == Qt::Checked;
    const QPixmap eye = iconPixmap(visible ? "eye" : "eye-off", theme.dim, EyeSize,
                                   painter->device()->devicePixelRatioF());
    painter->drawPixmap(row.left() + EyeLeft, row.top() + (RowHeight - EyeSize) / 2, eye);

    const int left =
        row.left() + EyeLeft + EyeSize + 8 + Indent * index.data(StructureModel::DepthRole).toInt();
    const auto kind =
        static_cast<StructureModel::Kind>(index.data(StructureModel::KindRole).toInt());
    const auto lobe = static_cast<Lobe>(index.data(StructureModel::LobeRole).toInt());
    painter->setBrush(chipColour(kind, lobe));
    painter->setPen(QPen(theme.line, 1.0));
    painter->drawRoundedRect(QRectF(left, row.top() + 8, 11, 11), 3, 3);
    painter->setPen(visible ? theme.text : theme.dim);
    const QRect text(left + 20, row.top(), row.right() - left - 26, RowHeight);
    painter->drawText(text, Qt::AlignLeft | Qt::AlignVCenter, index.data().toString());
    const QString value = index.data(StructureModel::ValueRole).toString();
    painter->drawText(text, Qt::AlignRight | Qt::AlignVCenter, value);
    const double density = index.data(StructureModel::DensityRole).toDouble();
    if (density != 1.0) {
      painter->setPen(theme.dim);
      painter->drawText(
          text.adjusted(0, 0, -option.fontMetrics.horizontalAdvance(value) - DensityGap, 0),
          Qt::AlignRight | Qt::AlignVCenter, QStringLiteral("\u00d7%1").arg(density));
    }
    painter->restore();
  }
};

}  // namespace

StructureView::StructureView(QWidget* parent) : QListView(parent) {
  setObjectName(QStringLiteral("structures"));
  setAccessibleName(tr("Structures"));
  setItemDelegate(new RowPainter(this));
  setMouseTracking(true);
  setEditTriggers(NoEditTriggers);
  setUniformItemSizes(true);
  setVerticalScrollBarPolicy(Qt::ScrollBarAlwaysOff);
  setHorizontalScrollBarPolicy(Qt::ScrollBarAlwaysOff);
  setSizePolicy(QSizePolicy::Preferred, QSizePolicy::Fixed);
}

void StructureView::setModel(QAbstractItemModel* model) {
  QListView::setModel(model);
  connect(model, &QAbstractItemModel::modelReset, this, [this] { updateGeometry(); });
  const auto tell = [this] {
    setAccessibleDescription(currentIndex().data(Qt::AccessibleTextRole).toString());
  };
  connect(model, &QAbstractItemModel::dataChanged, this, tell);
  connect(selectionModel(), &QItemSelectionModel::currentChanged, this, tell);
}

QSize StructureView::sizeHint() const {
  const int rows = model() == nullptr ? 0 : model()->rowCount();
  return {200, rows * RowHeight + 2 * frameWidth() + 2};
}

void StructureView::toggle(const QModelIndex& index) {
  const bool visible = index.data(Qt::CheckStateRole).toInt() == Qt::Checked;
  model()->setData(index, visible ? Qt::Unchecked : Qt::Checked, Qt::CheckStateRole);
}

void StructureView::mousePressEvent(QMouseEvent* event) {
  const QModelIndex index = indexAt(event->pos());
  if (index.isValid() && event->pos().x() < visualRect(index).left() + EyeLeft + EyeSize + 6) {
    toggle(index);
    return;
  }
  QListView::mousePressEvent(event);
}

void StructureView::keyPressEvent(QKeyEvent* event) {
  if (event->key() == Qt::Key_Space && currentIndex().isValid()) {
    toggle(currentIndex());
    return;
  }
  if ((event->key() == Qt::Key_BracketRight || event->key() == Qt::Key_BracketLeft) &&
      currentIndex().isValid()) {
    makeDenser(currentIndex(), event->key() == Qt::Key_BracketRight ? 1 : -1);
    return;
  }
  QListView::keyPressEvent(event);
}

void StructureView::makeDenser(const QModelIndex& index, int steps) {
  const std::span<const double> densities = StructureModel::densities();
  const double now = index.data(StructureModel::DensityRole).toDouble();
  const auto at = std::ranges::find(densities, steps == 0 ? 1.0 : now) - densities.begin();
  const auto next = std::clamp<std::ptrdiff_t>(at + steps, 0, std::ssize(densities) - 1);
  model()->setData(index, densities[static_cast<std::size_t>(next)], StructureModel::DensityRole);
}

void StructureView::contextMenuEvent(QContextMenuEvent* event) {
  const QModelIndex row = indexAt(event->pos());
  if (!row.isValid()) return;
  setCurrentIndex(row);
  auto* menu = new QMenu(this);
  menu->setAttribute(Qt::WA_DeleteOnClose);
  const bool visible = row.data(Qt::CheckStateRole).toInt() == Qt::Checked;
  const QPersistentModelIndex index = row;
  menu->addAction(visible ? tr("Hide") : tr("Show"), this, [this, index] {
    if (index.isValid()) toggle(index);
  });
  const auto kind = static_cast<StructureModel::Kind>(row.data(StructureModel::KindRole).toInt());
  if (kind != StructureModel::Kind::Airways) {
    menu->addSeparator();
    const auto add = [&](const QString& text, int steps) {
      menu->addAction(text, this, [this, index, steps] {
        if (index.isValid()) makeDenser(index, steps);
      });
    };
    add(tr("Denser"), 1);
    add(tr("Fainter"), -1);
    add(tr("As usual"), 0);
  }
  menu->popup(event->globalPos());
}

}  // namespace pneuma
