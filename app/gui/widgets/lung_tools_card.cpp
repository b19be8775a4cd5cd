#include "widgets/lung_tools_card.h"

#include <QCheckBox>
#include <QComboBox>
#include <QGridLayout>
#include <QHBoxLayout>
#include <QLabel>
#include <QPushButton>
#include <QSignalBlocker>
#include <QVBoxLayout>
#include <QVariant>
#include <utility>

#include "document/text.h"
#include "widgets/action_button.h"
#include "widgets/actions.h"
#include "widgets/heading.h"
#include "widgets/number_box.h"
#include "widgets/options_form.h"

namespace pneuma {

namespace {

constexpr double LowestLimitHu = -1000.0;
constexpr double HighestLimitHu = 1000.0;

QLabel* labelled(const QString& text, QWidget* of) {
  auto* label = new QLabel(text);
  label->setProperty("role", "dim");
  label->setBuddy(of);
  return label;
}

}  // namespace

LungToolsCard::LungToolsCard(Document& document, LungEditor& editor, const Actions& actions,
                             QWidget* parent)
    : QWidget(parent), document_(document), editor_(editor) {
  auto* column = new QVBoxLayout(this);
  column->setContentsMargins(0, 0, 0, 0);
  column->setSpacing(6);
  column->addWidget(heading(tr("Correct by hand")));
  auto* frame = new QFrame;
  frame->setProperty("role", "segmented");
  auto* tools = new QHBoxLayout(frame);
  tools->setContentsMargins(2, 2, 2, 2);
  tools->setSpacing(1);
  tools->addWidget(shortButton(actions.brush, "brush"));
  tools->addWidget(shortButton(actions.eraser, "eraser"));
  tools->addWidget(shortButton(actions.seed, "seed"));
  column->addWidget(frame);

  radius_ = new NumberBox;
  radius_->setObjectName(QStringLiteral("brushRadius"));
  radius_->setAccessibleName(tr("Radius of the brush"));
  radius_->setToolTip(tr("Radius of the brush; + and - change it in the slices"));
  radius_->setRange(LeastBrushMm, MostBrushMm);
  radius_->setDecimals(1);
  radius_->setSuffix(QStringLiteral(" mm"));
  shape_ = new QComboBox;
  shape_->setObjectName(QStringLiteral("brushShape"));
  shape_->setAccessibleName(tr("Shape of the brush"));
  shape_->setToolTip(tr("A ball reaches into the slices beside; a disc is in one slice"));
  shape_->addItems({tr("Ball"), tr("Disc in the slice")});
  lung_ = new QComboBox;
  lung_->setObjectName(QStringLiteral("brushLung"));
  lung_->setAccessibleName(tr("Lung that is corrected"));
  lung_->setToolTip(
      tr("Which lung the brush and the seed add to: the one under the stroke or nearest to it, or "
         "always the same. The eraser takes from that one, or from either."));
  lung_->addItems({tr("Nearest"), tr("Right"), tr("Left")});
  limit_ = new NumberBox;
  limit_->setObjectName(QStringLiteral("brushLimit"));
  limit_->setAccessibleName(tr("Limit of density"));
  limit_->setToolTip(tr("The seed takes in what is less dense, and so does a limited brush"));
  limit_->setRange(LowestLimitHu, HighestLimitHu);
  limit_->setDecimals(0);
  limit_->setSingleStep(25.0);
  limit_->setSuffix(QStringLiteral(" HU"));
  limited_ = new QCheckBox(tr("Brush only below it"));
  limited_->setObjectName(QStringLiteral("brushLimited"));
  limited_->setToolTip(tr("Paint and erase only voxels that are less dense than the limit"));
  auto* grid = new QGridLayout;
  grid->setHorizontalSpacing(6);
  grid->setVerticalSpacing(5);
  grid->setColumnStretch(1, 1);
  grid->setColumnMinimumWidth(0, NarrowLabelWidth);
  int row = 0;
  for (const auto& [text, box] : {std::pair<QString, QWidget*>{tr("Radius"), radius_},
                                  {tr("Shape"), shape_},
                                  {tr("Lung"), lung_},
                                  {tr("Limit"), limit_}}) {
    grid->addWidget(labelled(text, box), row, 0);
    grid->addWidget(box, row++, 1);
  }
  column->addLayout(grid);
  column->addWidget(limited_);
  note_ = new QLabel;
  note_->setObjectName(QStringLiteral("correctionsNote"));
  note_->setProperty("role", "dim");
  note_->setWordWrap(true);
  column->addWidget(note_);

  connect(radius_, qOverload<double>(&QDoubleSpinBox::valueChanged), &editor_,
          &LungEditor::setRadius);
  connect(limit_, qOverload<double>(&QDoubleSpinBox::valueChanged), &editor_,
          &LungEditor::setLimit);
  connect(shape_, qOverload<int>(&QComboBox::currentIndexChanged), this,
          [this](int at) { editor_.setDisc(at == 1); });
  connect(lung_, qOverload<int>(&QComboBox::currentIndexChanged), this,
          [this](int at) { editor_.setChoice(static_cast<LungEditor::Choice>(at)); });
  connect(limited_, &QCheckBox::toggled, &editor_, &LungEditor::setLimited);
  connect(&editor_, &LungEditor::changed, this, &LungToolsCard::follow);
  connect(&document_, &Document::changed, this, &LungToolsCard::follow);
  follow();
}

void LungToolsCard::follow() {
  const QSignalBlocker quietRadius(radius_);
  const QSignalBlocker quietShape(shape_);
  const QSignalBlocker quietLung(lung_);
  const QSignalBlocker quietLimit(limit_);
  const QSignalBlocker quietLimited(limited_);
  radius_->setValue(editor_.radiusMm());
  shape_->setCurrentIndex(editor_.disc() ? 1 : 0);
  lung_->setCurrentIndex(static_cast<int>(editor_.choice()));
  limit_->setValue(editor_.limitHu());
  limited_->setChecked(editor_.limited());
  const bool seed = editor_.tool() == LungEditor::Tool::Seed;
  for (QWidget* ofBrush : {static_cast<QWidget*>(radius_), static_cast<QWidget*>(shape_),
                           static_cast<QWidget*>(limited_)}) {
    ofBrush->setEnabled(!seed);
  }
  limit_->setEnabled(seed || editor_.limited() || editor_.tool() == LungEditor::Tool::None);
  const auto& corrections = document_.model().corrections;
  note_->setVisible(corrections != nullptr);
  if (!corrections) return;
  note_->setText(
      tr("Corrected by hand: %1").arg(counted(corrections->edits.size(), "edit", "edits")));
}

}  // namespace pneuma
