#include "tour.h"

#include <QFile>
#include <QJsonDocument>

#include "widgets/main_window.h"
#include "widgets/tour_card.h"

namespace pneuma {

namespace {

constexpr int LookMs = 100;  ///< how often it is seen whether a job still runs

bool is(const QJsonObject& step, const char* what) {
  return step[QStringLiteral("do")].toString() == QLatin1String(what);
}

QString textOf(const QJsonObject& step) {
  return QObject::tr(step[QStringLiteral("text")].toString().toUtf8().constData());
}

}  // namespace

Tour::Tour(MainWindow& window, QObject* parent)
    : QObject(parent), window_(window), player_(window, {}) {
  QFile file(QStringLiteral(":/tour.json"));
  if (file.open(QIODevice::ReadOnly)) steps_ = QJsonDocument::fromJson(file.readAll()).array();
  for (const auto& step : steps_) stops_ += is(step.toObject(), "say") ? 1 : 0;
  waiting_.setInterval(LookMs);
  connect(&waiting_, &QTimer::timeout, this, &Tour::look);
}

void Tour::start() {
  leave();
  at_ = 0;
  stop_ = 0;
  before_ = window_.document().model().surfaces;
  sample_ = nullptr;
  keepOptions();
  card_ = new TourCard(&window_);
  // Queued: a button must be done with its click before the card goes.
  connect(card_, &TourCard::next, this, &Tour::go, Qt::QueuedConnection);
  connect(card_, &TourCard::left, this, &Tour::leave, Qt::QueuedConnection);
  go();
}

void Tour::leave() {
  waiting_.stop();
  if (card_ != nullptr) card_->deleteLater();
  card_ = nullptr;
  giveOptionsBack();
}

void Tour::giveUp() {
  leave();
  emit window_.document().said(
      tr("The tour ended: the window was used for something else. Help > Tour begins again."));
}

void Tour::keepOptions() {
  Document& document = window_.document();
  chosen_ = document.growthOptions();
  options_.clear();
  for (std::size_t method = 0; method < growthMethods().size(); ++method) {
    document.setGrowthMethod(method);
    options_.push_back(document.growthOptions());
  }
  document.setGrowthOptions(*chosen_);
}

void Tour::giveOptionsBack() {
  // A project that was opened meanwhile brought its own.
  if (chosen_ && window_.document().projectPath().empty()) {
    for (const GrowthOptions& options : options_) window_.document().setGrowthOptions(options);
    window_.document().setGrowthOptions(*chosen_);
  }
  chosen_.reset();
}

void Tour::go() {
  if (sample_ && window_.document().model().surfaces != sample_) {
    giveUp();
    return;
  }
  while (card_ != nullptr && at_ < steps_.size()) {
    const QJsonObject step = steps_[at_++].toObject();
    if (is(step, "wait")) {
      card_->waitFor(textOf(step));
      waiting_.start();
      return;
    }
    try {
      if (is(step, "say")) {
        card_->tell(player_.widget(step[QStringLiteral("name")].toString()), textOf(step), ++stop_,
                    stops_);
        return;
      }
      player_.perform(step);
    } catch (const ScriptError&) {
      // Somebody did other things meanwhile, and what comes next is not there.
      giveUp();
    }
  }
  leave();
}

void Tour::look() {
  if (window_.document().jobs().busy()) return;
  waiting_.stop();
  if (!sample_) {
    const auto& surfaces = window_.document().model().surfaces;
    if (surfaces == before_) {  // opening the sample was stopped
      giveUp();
      return;
    }
    sample_ = surfaces;
  }
  go();
}

}  // namespace pneuma
