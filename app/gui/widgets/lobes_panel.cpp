#include "widgets/lobes_panel.h"

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
#include <tuple>

#include "core/error.h"
#include "document/lobes_sheet.h"
#include "document/review_walk.h"
#include "document/shell_command.h"
#include "document/text.h"
#include "pipeline/lobe_shares.h"
#include "widgets/action_button.h"
#include "widgets/actions.h"
#include "widgets/fissure_card.h"
#include "widgets/heading.h"
#include "widgets/scrolled.h"
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

/// Layouts remember the heights of their parts, and a scroll area squeezes what has grown since.
void forgetHeights(QWidget& column) {
  const QList<QWidget*> parts = column.findChildren<QWidget*>();
  // From the inside out.
  for (auto part = parts.crbegin(); part != parts.crend(); ++part) {
    if ((*part)->layout() == nullptr) continue;
    (*part)->layout()->invalidate();
    (*part)->updateGeometry();
  }
  column.layout()->invalidate();
  column.layout()->activate();
}

QLabel* dimLabel(const char* name) {
  auto* label = new QLabel;
  label->setObjectName(QString::fromUtf8(name));
  label->setProperty("role", "dim");
  label->setWordWrap(true);
  return label;
}

/// Two buttons of the same width.
QWidget* rowOf(QPushButton* first, QPushButton* second) {
  auto* box = new QWidget;
  auto* row = new QHBoxLayout(box);
  row->setContentsMargins(0, 0, 0, 0);
  row->setSpacing(6);
  row->addWidget(first, 1);
  row->addWidget(second, 1);
  return box;
}

}  // namespace

LobesPanel::LobesPanel(Document& document, FissureEditor& editor, ReviewWalk& review,
                       SliceViews& slices, const Actions& actions, QWidget* parent)
    : QWidget(parent), document_(document), editor_(editor), review_(review) {
  auto* content = new QWidget;
  auto* column = new QVBoxLayout(content);
  column->setContentsMargins(0, 0, 0, 0);
  column->setSpacing(6);
  addStation(*column, actions);
  addFiles(*column, actions);
  for (const Fissure fissure :
       {Fissure::LeftOblique, Fissure::RightOblique, Fissure::RightHorizontal}) {
    cards_.push_back(new FissureCard(document_, editor_, slices, fissure));
    column->addWidget(cards_.back());
  }
  addTools(*column, actions);
  addSplit(*column, actions);
  volumes_ = new SheetCard;
  volumes_->setObjectName(QStringLiteral("lobeVolumes"));
  volumes_->setAccessibleName(tr("Volumes of the lobes, share of their lung"));
  column->addWidget(volumes_);
  checks_ = new SheetCard;
  checks_->setObjectName(QStringLiteral("lobeChecks"));
  checks_->setAccessibleName(tr("Checks of the lobes"));
  column->addWidget(checks_);
  addReview(*column, actions);
  column->addSpacing(4);
  addSmoothness(*column);
  addShares(*column);
  column->addStretch();
  QScrollArea* scroll = fillScrolling(this, content);
  scroll->setObjectName(QStringLiteral("lobesScroll"));
  scroll->verticalScrollBar()->setObjectName(QStringLiteral("lobesScrollBar"));

  column_ = content;
  fitting_ = new QTimer(this);
  fitting_->setSingleShot(true);
  fitting_->setInterval(0);
  connect(fitting_, &QTimer::timeout, this, &LobesPanel::fit);

  connect(&editor_, &FissureEditor::changed, this, &LobesPanel::follow);
  connect(&review_, &ReviewWalk::changed, this, &LobesPanel::followReview);
  follow();
}

void LobesPanel::addFiles(QBoxLayout& column, const Actions& actions) {
  auto* row = new QHBoxLayout;
  row->setSpacing(2);
  row->addWidget(heading(tr("Fissures")), 1);
  for (const auto& [action, name, text] :
       {std::tuple{actions.openFissures, "openFissures", tr("Open")},
        std::tuple{actions.saveFissures, "saveFissures", tr("Save")}}) {
    QPushButton* button = actionButton(action, name, "link");
    const auto shorten = [button, word = text] { button->setText(word); };
    shorten();
    connect(action, &QAction::changed, button, shorten);
    row->addWidget(button);
    row->addSpacing(8);
  }
  column.addLayout(row);
}

void LobesPanel::addTools(QBoxLayout& column, const Actions& actions) {
  column.addWidget(
      rowOf(shortButton(actions.placePoints, "placePoints"), shortButton(actions.snap, "snap")));
  snapNote_ = dimLabel("snapNote");
  column.addWidget(snapNote_);
}

void LobesPanel::addStation(QBoxLayout& column, const Actions& actions) {
  station_ = dimLabel("reviewStation");
  column.addWidget(station_);
  walking_ = rowOf(shortButton(actions.looksRight, "looksRight", "primary"),
                   shortButton(actions.editHere, "editHere"));
  column.addWidget(walking_);
}

void LobesPanel::addReview(QBoxLayout& column, const Actions& actions) {
  reviewNote_ = dimLabel("reviewNote");
  column.addWidget(reviewNote_);
  waiting_ = rowOf(shortButton(actions.review, "review"),
                   shortButton(actions.acceptFissures, "acceptFissures"));
  column.addWidget(waiting_);
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
  connect(&document_.jobs(), &JobQueue::busyChanged, cancel, [this, cancel](bool busy) {
    cancel->setVisible(busy && (document_.splitting() || document_.lookingForFissures()));
  });
  cancel->hide();
  row->addWidget(cancel);
  column.addLayout(row);
  note_ = dimLabel("lobesNote");
  column.addWidget(note_);
}

bool LobesPanel::showsShares() const {
  try {
    return lobeSharesOfText(shares_->text().trimmed().toStdString()) == editor_.edits().shares;
  } catch (const InvalidOption&) {
    return false;
  }
}

void LobesPanel::takeShares() {
  try {
    editor_.setShares(lobeSharesOfText(shares_->text().trimmed().toStdString()));
    sharesNote_->hide();
  } catch (const InvalidOption& error) {
    sharesNote_->setText(qtText(error.what()));
    sharesNote_->show();
    fitting_->start();
  }
}

void LobesPanel::follow() {
  for (FissureCard* card : cards_) card->follow();
  const double smoothness = editor_.edits().options.smoothness;
  const QSignalBlocker quiet(smoothness_);
  if (!smoothness_->isSliderDown()) smoothness_->setValue(stepOf(smoothness));
  smoothnessValue_->setText(
      QString::number(static_cast<double>(smoothness_->value()) / SmoothnessSteps, 'f', 2));
  if (!shares_->hasFocus() && sharesNote_->isHidden() && !showsShares()) {
    shares_->setText(qtText(textOfLobeShares(editor_.edits().shares)));
  }
  note_->setText(note());
  note_->setVisible(!note_->text().isEmpty());
  snapNote_->setText(snapNote());
  snapNote_->setVisible(!snapNote_->text().isEmpty());
  followReview();
  const PropertySheet volumes = lobeVolumesSheet(editor_);
  volumes_->show(volumes);
  volumes_->setVisible(!volumes.rows.empty());
  const PropertySheet checks = lobeChecksSheet(editor_, document_);
  checks_->show(checks);
  checks_->setVisible(!checks.rows.empty());
  fit();
  fitting_->start();  // and once what is new has its style
}

void LobesPanel::fit() {
  forgetHeights(*column_);
  column_->setMinimumHeight(column_->layout()->totalHeightForWidth(column_->width()));
}

void LobesPanel::resizeEvent(QResizeEvent* event) {
  QWidget::resizeEvent(event);
  fitting_->start();
}

void LobesPanel::followReview() {
  for (FissureCard* card : cards_) card->follow();
  const bool active = review_.active();
  walking_->setVisible(active);
  waiting_->setVisible(!active && editor_.available() && !review_.complete());
  station_->setVisible(active);
  if (active) {
    station_->setText(tr("%1, station %2 of %3: is the line on the fissure?")
                          .arg(capitalised(longName(review_.fissure())))
                          .arg(review_.station() + 1)
                          .arg(review_.stations()));
  }
  reviewNote_->setText(review_.complete()
                           ? tr("All fissures were reviewed or accepted.")
                           : tr("Done once all fissures were reviewed or accepted."));
  reviewNote_->setVisible(editor_.available() && !active);
  fitting_->start();
}

QString LobesPanel::snapNote() const {
  if (!editor_.available()) return {};
  if (document_.lookingForFissures()) return tr("Looking for fissures in the CT...");
  const QString obstacle = document_.snapObstacle();
  return obstacle.isEmpty() ? QString() : tr("No snapping. %1").arg(obstacle);
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
