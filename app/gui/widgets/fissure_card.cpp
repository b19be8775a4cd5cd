#include "widgets/fissure_card.h"

#include <QHBoxLayout>
#include <QLabel>
#include <QListWidget>
#include <QPushButton>
#include <QSignalBlocker>
#include <QVBoxLayout>
#include <QVariant>
#include <algorithm>

#include "document/lobes_sheet.h"
#include "document/slice_views.h"
#include "document/text.h"

namespace pneuma {

namespace {

constexpr int ListHeight = 92;

}  // namespace

FissureCard::FissureCard(FissureEditor& editor, SliceViews& slices, Fissure fissure,
                         QWidget* parent)
    : QFrame(parent), editor_(editor), slices_(slices), fissure_(fissure) {
  setProperty("role", "card");
  setObjectName(nameOf("fissure"));
  auto* column = new QVBoxLayout(this);
  column->setContentsMargins(10, 6, 10, 8);
  column->setSpacing(4);
  name_ = new QPushButton(capitalised(longName(fissure)));
  name_->setObjectName(nameOf("edit"));
  name_->setProperty("role", "fissure");
  name_->setCheckable(true);
  name_->setToolTip(tr("Edit this fissure (Tab: the next)"));
  connect(name_, &QPushButton::clicked, this, [this] {
    editor_.setCurrent(fissure_);
    follow();
  });
  column->addWidget(name_);
  methods_ = makeMethods();
  column->addWidget(methods_);
  state_ = new QLabel;
  state_->setObjectName(nameOf("fissureState"));
  state_->setProperty("role", "dim");
  state_->setWordWrap(true);
  column->addWidget(state_);
  edits_ = makePoints();
  column->addWidget(edits_);
}

QString FissureCard::nameOf(const char* part) const {
  return QString::fromUtf8(part) + QLatin1Char('_') + qtText(shortName(fissure_));
}

QWidget* FissureCard::makeMethods() {
  auto* frame = new QFrame;
  frame->setProperty("role", "segmented");
  auto* row = new QHBoxLayout(frame);
  row->setContentsMargins(2, 2, 2, 2);
  row->setSpacing(1);
  const auto add = [&](const QString& text, const char* part, const QString& tip,
                       FissureMethod method) {
    auto* button = new QPushButton(text);
    button->setObjectName(nameOf(part));
    button->setCheckable(true);
    button->setToolTip(tip);
    connect(button, &QPushButton::clicked, this, [this, method] {
      editor_.setMethod(fissure_, method);
      follow();
    });
    row->addWidget(button);
    return button;
  };
  points_ = add(tr("Points"), "points", tr("Given by points that are clicked along it"),
                FissureMethod::Points);
  plane_ = add(tr("Plane"), "plane", tr("Given by a plane with three handles to drag"),
               FissureMethod::Plane);
  return frame;
}

QWidget* FissureCard::makePoints() {
  auto* box = new QWidget;
  auto* column = new QVBoxLayout(box);
  column->setContentsMargins(0, 2, 0, 0);
  column->setSpacing(4);
  list_ = new QListWidget;
  list_->setObjectName(nameOf("fissurePoints"));
  list_->setAccessibleName(tr("Points of the %1").arg(qtText(longName(fissure_))));
  list_->setToolTip(
      tr("Place, and how far the other points put it from there. Select one to go there."));
  list_->setFixedHeight(ListHeight);
  list_->setHorizontalScrollBarPolicy(Qt::ScrollBarAlwaysOff);
  connect(list_, &QListWidget::currentRowChanged, this, [this](int row) {
    const std::vector<Vec3>& points = editor_.edit(fissure_).points;
    remove_->setEnabled(row >= 0);
    if (row < 0 || static_cast<std::size_t>(row) >= points.size() || slices_.empty()) return;
    slices_.moveTo(points[static_cast<std::size_t>(row)]);
  });
  column->addWidget(list_);
  auto* buttons = new QHBoxLayout;
  buttons->setSpacing(6);
  remove_ = new QPushButton(tr("Delete"));
  remove_->setObjectName(nameOf("deletePoint"));
  remove_->setToolTip(tr("Delete the selected point"));
  connect(remove_, &QPushButton::clicked, this, [this] {
    const int row = list_->currentRow();
    if (row >= 0) editor_.removePoint(fissure_, static_cast<std::size_t>(row));
  });
  auto* clear = new QPushButton(tr("Clear"));
  clear->setObjectName(nameOf("clearPoints"));
  clear->setToolTip(tr("Back to the proposal"));
  connect(clear, &QPushButton::clicked, &editor_, &FissureEditor::clear);
  buttons->addWidget(remove_);
  buttons->addWidget(clear);
  column->addLayout(buttons);
  return box;
}

void FissureCard::follow() {
  const std::vector<Fissure> there = editor_.fissures();
  const bool shown = std::find(there.begin(), there.end(), fissure_) != there.end();
  setVisible(shown);
  if (!shown) return;
  const bool current = editor_.current() == fissure_;
  const FissureEdit& edit = editor_.edit(fissure_);
  const bool plane = edit.method == FissureMethod::Plane;
  name_->setChecked(current);
  methods_->setVisible(current);
  points_->setChecked(!plane);
  plane_->setChecked(plane);
  state_->setText(fissureLine(editor_, fissure_));
  const bool listed = current && !plane && !edit.points.empty();
  edits_->setVisible(listed);
  const QSignalBlocker quiet(list_);
  const int row = list_->currentRow();
  list_->clear();
  if (!listed) return;
  for (const QString& line : fissurePointLines(editor_, fissure_)) list_->addItem(line);
  if (row < list_->count()) list_->setCurrentRow(row);
  remove_->setEnabled(list_->currentRow() >= 0);
}

}  // namespace pneuma
