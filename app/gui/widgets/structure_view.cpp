#include "widgets/structure_view.h"

#include <QKeyEvent>
#include <QMouseEvent>
#include <QPainter>
#include <QStyledItemDelegate>

#include "document/structure_model.h"
#include "render/colour_map.h"
#include "widgets/icons.h"
#include "widgets/theme.h"

namespace pneuma {

namespace {

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
    painter->drawText(text, Qt::AlignRight | Qt::AlignVCenter,
                      index.data(StructureModel::ValueRole).toString());
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
  QListView::keyPressEvent(event);
}

}  // namespace pneuma
