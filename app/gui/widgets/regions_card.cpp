#include "widgets/regions_card.h"

#include <QGridLayout>
#include <QHBoxLayout>
#include <QLabel>
#include <QListWidget>
#include <QPushButton>
#include <QSignalBlocker>
#include <QVBoxLayout>
#include <QVariant>

#include "widgets/number_box.h"
#include "widgets/options_form.h"

namespace pneuma {

namespace {

constexpr int RowHeight = 24;
constexpr int MostRows = 4;
constexpr double LeastRadiusMm = 1.0;
constexpr double MostRadiusMm = 100.0;

}  // namespace

RegionsCard::RegionsCard(RegionEditor& editor, QWidget* parent) : QWidget(parent), editor_(editor) {
  auto* column = new QVBoxLayout(this);
  column->setContentsMargins(0, 0, 0, 0);
  column->setSpacing(5);
  auto* frame = new QFrame;
  frame->setProperty("role", "segmented");
  auto* modes = new QHBoxLayout(frame);
  modes->setContentsMargins(2, 2, 2, 2);
  modes->setSpacing(1);
  lobe_ = placingButton(RegionEditor::Placing::Lobe, tr("Click a lobe"),
                        tr("A click on a lobe in the 3-D view makes it stiffer or softer"),
                        "placeLobe");
  ball_ = placingButton(RegionEditor::Placing::Ball, tr("Click a ball"),
                        tr("A click on a lung in the 3-D view places a ball there, such as a "
                           "tumour"),
                        "placeBall");
  modes->addWidget(lobe_);
  modes->addWidget(ball_);
  column->addWidget(frame);

  factor_ = new NumberBox;
  factor_->setObjectName(QStringLiteral("regionFactor"));
  factor_->setAccessibleName(tr("Stiffness"));
  factor_->setToolTip(
      tr("How many times as stiff as healthy lung: below 1 softer, 0.5 as in "
         "emphysema"));
  factor_->setRange(LeastStiffness, MostStiffness);
  factor_->setDecimals(2);
  factor_->setSuffix(QStringLiteral(" ×"));
  connect(factor_, qOverload<double>(&QDoubleSpinBox::valueChanged), &editor_,
          &RegionEditor::setFactor);
  radius_ = new NumberBox;
  radius_->setObjectName(QStringLiteral("regionRadius"));
  radius_->setAccessibleName(tr("Radius"));
  radius_->setToolTip(tr("Radius of the ball; around it the change fades over 10 mm"));
  radius_->setRange(LeastRadiusMm, MostRadiusMm);
  radius_->setDecimals(1);
  radius_->setSuffix(QStringLiteral(" mm"));
  connect(radius_, qOverload<double>(&QDoubleSpinBox::valueChanged), &editor_,
          &RegionEditor::setRadius);
  auto* grid = new QGridLayout;
  grid->setHorizontalSpacing(6);
  grid->setVerticalSpacing(5);
  grid->setColumnStretch(1, 1);
  grid->setColumnMinimumWidth(0, NarrowLabelWidth);
  int row = 0;
  for (const auto& [text, box] : {std::pair{tr("Stiffness"), factor_}, {tr("Radius"), radius_}}) {
    auto* label = new QLabel(text);
    label->setProperty("role", "dim");
    label->setBuddy(box);
    grid->addWidget(label, row, 0);
    grid->addWidget(box, row++, 1);
  }
  column->addLayout(grid);

  list_ = new QListWidget;
  list_->setObjectName(QStringLiteral("regionList"));
  list_->setAccessibleName(tr("Stiff and soft parts"));
  list_->setToolTip(tr("Select one to change or remove it"));
  list_->setHorizontalScrollBarPolicy(Qt::ScrollBarAlwaysOff);
  connect(list_, &QListWidget::currentRowChanged, this, [this](int at) {
    editor_.choose(at < 0 ? std::nullopt : std::optional(static_cast<std::size_t>(at)));
  });
  column->addWidget(list_);
  remove_ = new QPushButton(tr("Remove"));
  remove_->setObjectName(QStringLiteral("removeRegion"));
  remove_->setToolTip(tr("Remove the selected part"));
  remove_->setProperty("role", "quiet");
  connect(remove_, &QPushButton::clicked, &editor_, &RegionEditor::removeChosen);
  column->addWidget(remove_, 0, Qt::AlignLeft);

  connect(&editor_, &RegionEditor::changed, this, &RegionsCard::follow);
  follow();
}

QPushButton* RegionsCard::placingButton(RegionEditor::Placing placing, const QString& text,
                                        const QString& tip, const char* name) {
  auto* button = new QPushButton(text);
  button->setObjectName(QString::fromUtf8(name));
  button->setCheckable(true);
  button->setToolTip(tip);
  connect(button, &QPushButton::clicked, this, [this, placing](bool on) {
    editor_.setPlacing(on ? placing : RegionEditor::Placing::Nothing);
  });
  return button;
}

void RegionsCard::setChangeable(bool changeable) { setEnabled(changeable); }

void RegionsCard::follow() {
  lobe_->setChecked(editor_.placing() == RegionEditor::Placing::Lobe);
  ball_->setChecked(editor_.placing() == RegionEditor::Placing::Ball);
  const QSignalBlocker quietFactor(factor_);
  const QSignalBlocker quietRadius(radius_);
  const QSignalBlocker quietList(list_);
  factor_->setValue(editor_.factor());
  radius_->setValue(editor_.radiusMm());
  const std::optional<std::size_t> chosen = editor_.chosen();
  const auto& regions = editor_.regions();
  radius_->setEnabled(!chosen || regions[*chosen].isBall());
  list_->clear();
  for (const StiffnessRegion& region : regions) list_->addItem(editor_.textOf(region));
  list_->setCurrentRow(chosen ? static_cast<int>(*chosen) : -1);
  const int rows = std::min(MostRows, list_->count());
  list_->setFixedHeight(RowHeight * rows + 8);
  list_->setVisible(rows > 0);
  remove_->setVisible(rows > 0);
  remove_->setEnabled(chosen.has_value());
}

}  // namespace pneuma
