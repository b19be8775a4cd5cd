#include "widgets/ct_views.h"

#include <QGridLayout>
#include <QHBoxLayout>
#include <QSlider>
#include <QVariant>
#include <algorithm>

#include "document/text.h"
#include "widgets/actions.h"
#include "widgets/slice_view.h"

namespace pneuma {

namespace {

constexpr int LineBetween = 2;  // pixels
constexpr double OpacityStep = 0.05;

struct Cell {
  int row;
  int column;
};

constexpr Cell SceneCell{0, 1};
constexpr std::array<Cell, 3> SliceCells = {{{0, 0}, {1, 0}, {1, 1}}};

}  // namespace

CtViews::CtViews(SliceViews& views, QWidget* scene, const Actions& actions, QWidget* parent)
    : QWidget(parent), views_(views), scene_(scene) {
  setObjectName(QStringLiteral("ctViews"));
  setAttribute(Qt::WA_StyledBackground);
  grid_ = new QGridLayout(this);
  grid_->setContentsMargins(0, 0, 0, 0);
  grid_->setSpacing(0);
  grid_->addWidget(scene_, SceneCell.row, SceneCell.column);
  for (const SlicePlane plane : SlicePlanes) {
    const auto index = static_cast<std::size_t>(plane);
    panes_[index] = makePane(plane);
    grid_->addWidget(panes_[index], SliceCells[index].row, SliceCells[index].column);
    panes_[index]->hide();
  }
  connectActions(actions);
  connect(&views_, &SliceViews::changed, this, &CtViews::follow);
}

void CtViews::setMouse(MouseProfile profile) {
  for (SliceView* slice : slices_) slice->setMouse(profile);
}

QWidget* CtViews::makePane(SlicePlane plane) {
  const auto index = static_cast<std::size_t>(plane);
  const QString name = qtText(choices(SlicePlane{})[index]);
  auto* pane = new QWidget;
  pane->setProperty("role", "slicePane");
  pane->setAttribute(Qt::WA_StyledBackground);
  auto* row = new QHBoxLayout(pane);
  row->setContentsMargins(0, 0, 0, 0);
  row->setSpacing(0);
  slices_[index] = new SliceView(views_, plane);
  bars_[index] = new QSlider(Qt::Vertical);
  bars_[index]->setObjectName(QStringLiteral("sliceBar_") + name);
  bars_[index]->setAccessibleName(tr("%1 slice").arg(capitalised(name.toStdString())));
  bars_[index]->setToolTip(tr("Drag through the slices"));
  bars_[index]->setFocusPolicy(Qt::TabFocus);
  row->addWidget(slices_[index], 1);
  row->addWidget(bars_[index]);
  connect(bars_[index], &QSlider::valueChanged, this,
          [this, plane](int slice) { views_.setSlice(plane, slice); });
  connect(slices_[index], &SliceView::hovered, this, &CtViews::hovered);
  connect(slices_[index], &SliceView::doubleClicked, this,
          [this, pane] { arrange(only_ == pane ? nullptr : pane); });
  return pane;
}

void CtViews::connectActions(const Actions& actions) {
  const SliceActions& slices = actions.slices;
  addActions(slices.all());
  for (SliceView* slice : slices_) slice->addActions(actions.ofFissures());
  for (SliceView* slice : slices_) slice->addActions(actions.ofLungs());
  const auto change = [this](const QAction* action, auto edit) {
    connect(action, &QAction::triggered, this, [this, edit](bool checked) {
      SliceLook look = views_.look();
      edit(look, checked);
      views_.setLook(look);
    });
  };
  for (std::size_t i = 0; i < slices.windows.size(); ++i) {
    change(slices.windows[i],
           [i](SliceLook& look, bool) { look.window = greyWindows()[i].window; });
  }
  const auto setLabels = [overlay = slices.overlay, outlines = slices.outlines](SliceLook& look,
                                                                                bool) {
    look.labels = !overlay->isChecked()   ? LabelStyle::Hidden
                  : outlines->isChecked() ? LabelStyle::Outlined
                                          : LabelStyle::Filled;
  };
  change(slices.overlay, setLabels);
  change(slices.outlines, setLabels);
  change(slices.denser,
         [](SliceLook& look, bool) { look.opacity = std::min(1.0, look.opacity + OpacityStep); });
  change(slices.fainter,
         [](SliceLook& look, bool) { look.opacity = std::max(0.0, look.opacity - OpacityStep); });
  change(slices.annotations, [](SliceLook& look, bool on) { look.annotations = on; });
  connect(slices.crosshair, &QAction::triggered, &views_, &SliceViews::showCrosshair);
  connect(slices.fourViews, &QAction::triggered, this, [this] { arrange(nullptr); });
  connect(slices.sceneAlone, &QAction::triggered, this, [this] { arrange(scene_); });
}

void CtViews::follow() {
  for (const SlicePlane plane : SlicePlanes) {
    if (views_.empty()) break;
    QSlider* bar = bars_[static_cast<std::size_t>(plane)];
    const QSignalBlocker quiet(bar);
    bar->setRange(0, views_.stack(plane).count - 1);
    bar->setValue(views_.slice(plane));
  }
  if (shown_ == views_.empty()) {
    shown_ = !views_.empty();
    arrange(nullptr);
  }
}

void CtViews::arrange(QWidget* only) {
  only_ = only;
  const auto place = [&](QWidget* view, const Cell& cell, bool there) {
    const bool visible = there && (only == nullptr || only == view);
    view->setVisible(visible);
    return visible ? cell : Cell{-1, -1};
  };
  std::array<bool, 2> rows{};
  std::array<bool, 2> columns{};
  const auto note = [&](const Cell& cell) {
    if (cell.row < 0) return;
    rows[static_cast<std::size_t>(cell.row)] = true;
    columns[static_cast<std::size_t>(cell.column)] = true;
  };
  note(place(scene_, SceneCell, true));
  for (std::size_t i = 0; i < panes_.size(); ++i) note(place(panes_[i], SliceCells[i], shown_));
  for (int i = 0; i < 2; ++i) {
    grid_->setRowStretch(i, rows[static_cast<std::size_t>(i)] ? 1 : 0);
    grid_->setColumnStretch(i, columns[static_cast<std::size_t>(i)] ? 1 : 0);
  }
  grid_->setSpacing(rows[0] && rows[1] ? LineBetween : 0);
}

}  // namespace pneuma
