#include "widgets/fissure_card.h"

#include <QDoubleSpinBox>
#include <QHBoxLayout>
#include <QLabel>
#include <QListWidget>
#include <QPushButton>
#include <QSignalBlocker>
#include <QVBoxLayout>
#include <QVariant>
#include <algorithm>

#include "core/error.h"
#include "document/lobes_sheet.h"
#include "document/slice_views.h"
#include "document/text.h"
#include "widgets/dialogs.h"

namespace pneuma {

namespace {

constexpr int ListHeight = 72;
constexpr double LeastWeight = 0.1;
constexpr double MostWeight = 100.0;

QLabel* dimLabel(const QString& text, const QString& name) {
  auto* label = new QLabel(text);
  label->setObjectName(name);
  label->setProperty("role", "dim");
  label->setWordWrap(true);
  return label;
}

}  // namespace

FissureCard::FissureCard(Document& document, FissureEditor& editor, SliceViews& slices,
                         Fissure fissure, QWidget* parent)
    : QFrame(parent), document_(document), editor_(editor), slices_(slices), fissure_(fissure) {
  setProperty("role", "card");
  setObjectName(nameOf("fissure"));
  auto* column = new QVBoxLayout(this);
  column->setContentsMargins(10, 3, 10, 4);
  column->setSpacing(4);
  auto* top = new QHBoxLayout;
  top->setSpacing(6);
  name_ = new QPushButton(capitalised(longName(fissure)).remove(tr(" fissure")));
  name_->setObjectName(nameOf("edit"));
  name_->setAccessibleName(capitalised(longName(fissure)));
  name_->setProperty("role", "fissure");
  name_->setCheckable(true);
  name_->setToolTip(tr("Edit this fissure (Tab: the next)"));
  connect(name_, &QPushButton::clicked, this, [this] {
    editor_.setCurrent(fissure_);
    follow();
  });
  brief_ = dimLabel({}, nameOf("fissureBrief"));
  brief_->setWordWrap(false);
  top->addWidget(name_, 1);
  top->addWidget(brief_);
  column->addLayout(top);
  methods_ = makeMethods();
  column->addWidget(methods_);
  state_ = dimLabel({}, nameOf("fissureState"));
  column->addWidget(state_);
  shows_ = dimLabel({}, nameOf("fissureShows"));
  column->addWidget(shows_);
  points_ = makePoints();
  column->addWidget(points_);
  angles_ = makeAngles();
  column->addWidget(angles_);
  extend_ = new QPushButton(tr("Extend it to the wall"));
  extend_->setObjectName(nameOf("extend"));
  extend_->setToolTip(tr("Lets the surface go on smoothly, up to 15 mm"));
  connect(extend_, &QPushButton::clicked, &editor_, &FissureEditor::extendSurfaces);
  column->addWidget(extend_);
}

QString FissureCard::nameOf(const char* part) const {
  return QString::fromUtf8(part) + QLatin1Char('_') + qtText(shortName(fissure_));
}

QWidget* FissureCard::makeMethods() {
  struct Method {
    FissureMethod method;
    const char* name;
    const char* text;
    const char* tip;
  };

  static const std::array<Method, 3> methods = {{
      {FissureMethod::Points, "points", QT_TR_NOOP("Points"),
       QT_TR_NOOP("Given by points that are clicked along it")},
      {FissureMethod::Plane, "plane", QT_TR_NOOP("Plane"),
       QT_TR_NOOP("Given by a plane with three handles to drag")},
      {FissureMethod::Surface, "surface", QT_TR_NOOP("File..."),
       QT_TR_NOOP("Given by an open surface in a file: STL, OBJ, PLY or VTP")},
  }};
  auto* frame = new QFrame;
  frame->setProperty("role", "segmented");
  auto* row = new QHBoxLayout(frame);
  row->setContentsMargins(2, 2, 2, 2);
  row->setSpacing(1);
  for (std::size_t i = 0; i < methods.size(); ++i) {
    auto* button = new QPushButton(tr(methods[i].text));
    button->setObjectName(nameOf(methods[i].name));
    button->setCheckable(true);
    button->setToolTip(tr(methods[i].tip));
    connect(button, &QPushButton::clicked, this,
            [this, method = methods[i].method] { chooseMethod(method); });
    row->addWidget(button);
    methodButtons_[i] = button;
  }
  return frame;
}

void FissureCard::chooseMethod(FissureMethod method) {
  const FissureEdit& edit = editor_.edit(fissure_);
  // Asked again where one is there: it may be another file.
  if (method == FissureMethod::Surface && (!edit.read || edit.method == method)) {
    askForSurface();
  } else {
    editor_.setMethod(fissure_, method);
  }
  follow();
}

void FissureCard::askForSurface() {
  askForFile(
      window(), tr("Surface of the %1").arg(qtText(longName(fissure_))),
      {tr("Surfaces (*.stl *.obj *.ply *.vtp)"), tr("All files (*)")},
      [this](const QString& file) { document_.openFissureSurface(fissure_, file.toStdString()); });
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
    followSelection();
    const std::vector<Vec3> points = editor_.points(fissure_);
    if (row < 0 || static_cast<std::size_t>(row) >= points.size() || slices_.empty()) return;
    slices_.moveTo(points[static_cast<std::size_t>(row)]);
  });
  column->addWidget(list_);
  auto* row = new QHBoxLayout;
  row->setSpacing(4);
  remove_ = new QPushButton(tr("Delete"));
  remove_->setObjectName(nameOf("deletePoint"));
  remove_->setToolTip(tr("Delete the selected point"));
  remove_->setProperty("role", "quiet");
  connect(remove_, &QPushButton::clicked, this, [this] {
    const int at = list_->currentRow();
    if (at >= 0) editor_.removePoint(fissure_, static_cast<std::size_t>(at));
  });
  auto* clear = new QPushButton(tr("Clear"));
  clear->setObjectName(nameOf("clearPoints"));
  clear->setToolTip(tr("Back to the proposal"));
  clear->setProperty("role", "quiet");
  connect(clear, &QPushButton::clicked, &editor_, &FissureEditor::clear);
  weight_ = new QDoubleSpinBox;
  weight_->setObjectName(nameOf("weight"));
  weight_->setAccessibleName(tr("Weight of the selected point"));
  weight_->setToolTip(
      tr("How much the selected point counts: 1 like the others, more to hold "
         "the fissure, less where it is hardly seen"));
  weight_->setRange(LeastWeight, MostWeight);
  weight_->setDecimals(1);
  weight_->setPrefix(QStringLiteral("x "));
  weight_->setKeyboardTracking(false);
  connect(weight_, qOverload<double>(&QDoubleSpinBox::valueChanged), this, [this](double weight) {
    const int at = list_->currentRow();
    if (at >= 0) editor_.setWeight(fissure_, static_cast<std::size_t>(at), weight);
  });
  row->addWidget(remove_);
  row->addWidget(clear);
  row->addStretch();
  row->addWidget(weight_);
  column->addLayout(row);
  return box;
}

QDoubleSpinBox* FissureCard::makeAngle(const char* name, const QString& accessible,
                                       const QString& tip) {
  auto* box = new QDoubleSpinBox;
  box->setObjectName(nameOf(name));
  box->setAccessibleName(accessible);
  box->setToolTip(tip);
  box->setRange(-90.0, 90.0);
  box->setDecimals(1);
  box->setSuffix(QStringLiteral("°"));
  box->setSizePolicy(QSizePolicy::Ignored, QSizePolicy::Fixed);
  box->setKeyboardTracking(false);
  connect(box, qOverload<double>(&QDoubleSpinBox::valueChanged), this, [this] {
    editor_.setAngles(fissure_, {tilt_->value(), turn_->value()});
  });
  return box;
}

QWidget* FissureCard::makeAngles() {
  auto* box = new QWidget;
  auto* row = new QHBoxLayout(box);
  row->setContentsMargins(0, 2, 0, 0);
  row->setSpacing(4);
  tilt_ = makeAngle("tilt", tr("Tilt of the plane"),
                    tr("Turns the plane about the left-right axis: its back edge rises"));
  turn_ = makeAngle("turn", tr("Turn of the plane"),
                    tr("Then about the front-back axis: its left edge sinks"));
  row->addWidget(dimLabel(tr("Tilt"), nameOf("tiltLabel")));
  row->addWidget(tilt_, 1);
  row->addWidget(dimLabel(tr("Turn"), nameOf("turnLabel")));
  row->addWidget(turn_, 1);
  return box;
}

void FissureCard::follow() {
  const std::vector<Fissure> there = editor_.fissures();
  const bool shown = std::find(there.begin(), there.end(), fissure_) != there.end();
  setVisible(shown);
  if (!shown) return;
  const bool current = editor_.current() == fissure_;
  const FissureEdit& edit = editor_.edit(fissure_);
  name_->setChecked(current);
  brief_->setText(fissureBrief(editor_, fissure_) +
                  (document_.reviewed(fissure_) ? QStringLiteral("  ✓") : QString()));
  brief_->setToolTip(fissureLine(editor_, fissure_));
  methods_->setVisible(current);
  for (std::size_t i = 0; i < methodButtons_.size(); ++i) {
    methodButtons_[i]->setChecked(edit.method == static_cast<FissureMethod>(i));
  }
  state_->setText(fissureLine(editor_, fissure_));
  state_->setVisible(current);
  shows_->setText(fissureShows(editor_, fissure_));
  shows_->setVisible(current && !shows_->text().isEmpty());
  points_->setVisible(current && edit.method == FissureMethod::Points && !edit.points.empty());
  angles_->setVisible(current && edit.method == FissureMethod::Plane && edit.handles);
  extend_->setVisible(current && editor_.canExtend(fissure_));
  followPoints();
  followAngles();
}

void FissureCard::followPoints() {
  const QSignalBlocker quiet(list_);
  const int row = list_->currentRow();
  list_->clear();
  if (points_->isHidden()) return;
  for (const QString& line : fissurePointLines(editor_, fissure_)) list_->addItem(line);
  if (row < list_->count()) list_->setCurrentRow(row);
  followSelection();
}

void FissureCard::followSelection() {
  const int row = list_->currentRow();
  const std::vector<double>& weights = editor_.edit(fissure_).weights;
  const bool any = row >= 0 && static_cast<std::size_t>(row) < weights.size();
  remove_->setEnabled(any);
  weight_->setEnabled(any);
  const QSignalBlocker quiet(weight_);
  weight_->setValue(any ? weights[static_cast<std::size_t>(row)] : UsualWeight);
}

void FissureCard::followAngles() {
  if (angles_->isHidden()) return;
  const QSignalBlocker quietTilt(tilt_);
  const QSignalBlocker quietTurn(turn_);
  try {
    const PlaneAngles angles = anglesOf(*editor_.edit(fissure_).handles);
    tilt_->setValue(angles.tiltDeg);
    turn_->setValue(angles.turnDeg);
  } catch (const InvalidInput&) {
    return;  // handles on one line: the state says so
  }
}

}  // namespace pneuma
