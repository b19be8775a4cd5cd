#include "widgets/lobes_panel.h"

#include <QEvent>
#include <QHBoxLayout>
#include <QLabel>
#include <QLineEdit>
#include <QPushButton>
#include <QScrollArea>
#include <QScrollBar>
#include <QSignalBlocker>
#include <QSlider>
#include <QTimer>
#include <QVBoxLayout>
#include <QVariant>
#include <cmath>

#include "core/error.h"
#include "document/lobes_sheet.h"
#include "document/text.h"
#include "pipeline/lobe_shares.h"
#include "widgets/action_button.h"
#include "widgets/actions.h"
#include "widgets/fissure_card.h"
#include "widgets/heading.h"
#include "widgets/sheet_card.h"

namespace pneuma {

namespace {

constexpr int SmoothnessSteps = 100;
constexpr double LeastSmoothness = 1e-4;
constexpr double MostSmoothness = 1.0;

/// Equal steps of the slider are equal factors.
double smoothnessAt(int step) {
  return LeastSmoothness *
         std::pow(MostSmoothness / LeastSmoothness, static_cast<double>(step) / SmoothnessSteps);
}

int stepOf(double smoothness) {
  if (smoothness <= LeastSmoothness) return 0;
  return static_cast<int>(std::lround(SmoothnessSteps * std::log(smoothness / LeastSmoothness) /
                                      std::log(MostSmoothness / LeastSmoothness)));
}

/// Scrolls a column whose parts come and go. A scroll area asks wrapped texts for their height too
/// early, and squeezes what is there then.
class ColumnScroll : public QScrollArea {
 public:
  explicit ColumnScroll(QWidget* content) {
    setWidget(content);
    setWidgetResizable(true);
    setFrameShape(QFrame::NoFrame);
    setHorizontalScrollBarPolicy(Qt::ScrollBarAlwaysOff);
    setFocusPolicy(Qt::NoFocus);
  }

 protected:
  bool eventFilter(QObject* watched, QEvent* event) override {
    const bool changed = event->type() == QEvent::LayoutRequest || event->type() == QEvent::Resize;
    if (watched == widget() && changed) QTimer::singleShot(0, this, [this] { fit(); });
    return QScrollArea::eventFilter(watched, event);
  }

 private:
  void fit() {
    QLayout& layout = *widget()->layout();
    layout.activate();
    const int height = layout.totalHeightForWidth(widget()->width());
    if (height != widget()->minimumHeight()) widget()->setMinimumHeight(height);
  }
};

QLabel* dimLabel(const char* name) {
  auto* label = new QLabel;
  label->setObjectName(QString::fromUtf8(name));
  label->setProperty("role", "dim");
  label->setWordWrap(true);
  return label;
}

}  // namespace

LobesPanel::LobesPanel(Document& document, FissureEditor& editor, SliceViews& slices,
                       const Actions& actions, QWidget* parent)
    : QWidget(parent), document_(document), editor_(editor) {
  auto* content = new QWidget;
  auto* column = new QVBoxLayout(content);
  column->setContentsMargins(0, 0, 0, 0);
  column->setSpacing(8);
  column->addWidget(heading(tr("Fissures")));
  for (const Fissure fissure :
       {Fissure::LeftOblique, Fissure::RightOblique, Fissure::RightHorizontal}) {
    cards_.push_back(new FissureCard(editor_, slices, fissure));
    column->addWidget(cards_.back());
  }
  auto* place = actionButton(actions.placePoints, "placePoints");
  place->setCheckable(true);
  connect(actions.placePoints, &QAction::changed, place,
          [place, action = actions.placePoints] { place->setChecked(action->isChecked()); });
  column->addWidget(place);
  addSmoothness(*column);
  addShares(*column);
  addSplit(*column, actions);
  column->addSpacing(4);
  column->addWidget(heading(tr("Lobes")));
  volumes_ = new SheetCard;
  volumes_->setObjectName(QStringLiteral("lobeVolumes"));
  volumes_->setAccessibleName(tr("Volumes of the lobes, share of their lung"));
  column->addWidget(volumes_);
  checks_ = new SheetCard;
  checks_->setObjectName(QStringLiteral("lobeChecks"));
  checks_->setAccessibleName(tr("Checks of the lobes"));
  column->addWidget(checks_);
  column->addStretch();
  auto* scroll = new ColumnScroll(content);
  scroll->setObjectName(QStringLiteral("lobesScroll"));
  scroll->verticalScrollBar()->setObjectName(QStringLiteral("lobesScrollBar"));
  auto* whole = new QVBoxLayout(this);
  whole->setContentsMargins(0, 0, 0, 0);
  whole->addWidget(scroll);

  connect(&editor_, &FissureEditor::changed, this, &LobesPanel::follow);
  follow();
}

void LobesPanel::addSmoothness(QBoxLayout& column) {
  auto* row = new QHBoxLayout;
  auto* label = new QLabel(tr("Smoothness"));
  label->setProperty("role", "dim");
  smoothnessValue_ = new QLabel;
  smoothnessValue_->setObjectName(QStringLiteral("smoothnessValue"));
  row->addWidget(label);
  row->addStretch();
  row->addWidget(smoothnessValue_);
  column.addLayout(row);
  smoothness_ = new QSlider(Qt::Horizontal);
  smoothness_->setObjectName(QStringLiteral("smoothness"));
  smoothness_->setAccessibleName(tr("Smoothness of the fissures"));
  smoothness_->setToolTip(tr("How far a fissure may leave its points to bend less"));
  smoothness_->setRange(0, SmoothnessSteps);
  smoothness_->setPageStep(10);
  column.addWidget(smoothness_);
  connect(smoothness_, &QSlider::valueChanged, this, [this](int step) {
    editor_.dragSmoothness(smoothnessAt(step));
    // With the keyboard or a click beside the handle there is no release.
    if (!smoothness_->isSliderDown()) editor_.release();
  });
  connect(smoothness_, &QSlider::sliderReleased, &editor_, &FissureEditor::release);
}

void LobesPanel::addShares(QBoxLayout& column) {
  auto* label = new QLabel(tr("Wanted volumes, % of the lung"));
  label->setProperty("role", "dim");
  column.addWidget(label);
  auto* row = new QHBoxLayout;
  row->setSpacing(6);
  shares_ = new QLineEdit;
  shares_->setObjectName(QStringLiteral("lobeShares"));
  shares_->setAccessibleName(tr("Wanted volumes of the lobes"));
  shares_->setPlaceholderText(QStringLiteral("RUL,RML,RLL/LUL,LLL"));
  shares_->setToolTip(
      tr("Moves the fissures until the lobes have these shares of their lung, for example "
         "36,18,46/55,45; empty: the fissures stay where they are"));
  connect(shares_, &QLineEdit::editingFinished, this, &LobesPanel::takeShares);
  auto* usual = new QPushButton(tr("Usual"));
  usual->setObjectName(QStringLiteral("usualShares"));
  usual->setToolTip(tr("The shares that most people have"));
  connect(usual, &QPushButton::clicked, this, [this] {
    shares_->setText(QStringLiteral("usual"));
    takeShares();
  });
  row->addWidget(shares_, 1);
  row->addWidget(usual);
  column.addLayout(row);
  sharesNote_ = dimLabel("lobeSharesNote");
  column.addWidget(sharesNote_);
  sharesNote_->hide();
}

void LobesPanel::addSplit(QBoxLayout& column, const Actions& actions) {
  auto* row = new QHBoxLayout;
  row->setSpacing(8);
  row->addWidget(actionButton(actions.splitLobes, "splitLobes", "primary"), 1);
  auto* cancel = new QPushButton(tr("Cancel"));
  cancel->setObjectName(QStringLiteral("splitCancel"));
  connect(cancel, &QPushButton::clicked, &document_.jobs(), &JobQueue::cancel);
  connect(&document_.jobs(), &JobQueue::busyChanged, cancel,
          [this, cancel](bool busy) { cancel->setVisible(busy && document_.splitting()); });
  cancel->hide();
  row->addWidget(cancel);
  column.addLayout(row);
  note_ = dimLabel("lobesNote");
  column.addWidget(note_);
}

void LobesPanel::takeShares() {
  try {
    editor_.setShares(lobeSharesOfText(shares_->text().trimmed().toStdString()));
    sharesNote_->hide();
  } catch (const InvalidOption& error) {
    sharesNote_->setText(qtText(error.what()));
    sharesNote_->show();
  }
}

void LobesPanel::follow() {
  for (FissureCard* card : cards_) card->follow();
  const double smoothness = editor_.edits().options.smoothness;
  const QSignalBlocker quiet(smoothness_);
  if (!smoothness_->isSliderDown()) smoothness_->setValue(stepOf(smoothness));
  smoothnessValue_->setText(
      QString::number(static_cast<double>(smoothness_->value()) / SmoothnessSteps, 'f', 2));
  if (editor_.edits().shares.empty() && !shares_->hasFocus() && sharesNote_->isHidden()) {
    shares_->clear();
  }
  note_->setText(note());
  note_->setVisible(!note_->text().isEmpty());
  const PropertySheet volumes = lobeVolumesSheet(editor_);
  volumes_->show(volumes);
  volumes_->setVisible(!volumes.rows.empty());
  const PropertySheet checks = lobeChecksSheet(editor_, document_);
  checks_->show(checks);
  checks_->setVisible(!checks.rows.empty());
}

QString LobesPanel::note() const {
  if (!editor_.available()) {
    return document_.model().ct ? tr("Find the lungs first: there is nothing to split.")
                                : tr("Open surfaces of whole lungs or a CT first.");
  }
  if (document_.splitting()) return tr("The lobes follow...");
  if (document_.lobesOutOfDate()) return tr("Changed since the lungs were split.");
  if (!document_.model().lobes) return tr("A preview: split to grow in the lobes.");
  return {};
}

}  // namespace pneuma
