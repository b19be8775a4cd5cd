#include <QBuffer>
#include <QCloseEvent>
#include <QFileInfo>
#include <QImage>
#include <QLabel>
#include <algorithm>
#include <utility>

#include "document/text.h"
#include "widgets/dialogs.h"
#include "widgets/error_card.h"
#include "widgets/main_window.h"
#include "widgets/scene_view.h"
#include "widgets/status_strip.h"
#include "widgets/step_button.h"
#include "widgets/stereo_menu.h"

// What the window does with projects: opening, saving, asking before work is lost.
namespace pneuma {

namespace {

constexpr int ThumbnailWidth = 320;

std::filesystem::path projectPath(const QString& name) { return name.toStdString(); }

/// What an eye of the list of structures is called in a project; empty for lists of others.
std::string nameOf(const StructureModel::Structure& structure) {
  if (structure.kind == StructureModel::Kind::Surface) {
    return std::string(shortName(structure.lobe));
  }
  return structure.kind == StructureModel::Kind::Airways ? "airways" : "";
}

/// Dialogs that were answered may still be there.
bool questionIsOpen(const QWidget& window) {
  return std::ranges::any_of(window.findChildren<QWidget*>(QStringLiteral("closeQuestion")),
                             &QWidget::isVisible);
}

/// A job that was cancelled takes a moment to stop.
void closeWhenIdle(QWidget& window, const JobQueue& jobs) {
  const auto closeSoon = [&window] {
    QMetaObject::invokeMethod(&window, &QWidget::close, Qt::QueuedConnection);
  };
  if (!jobs.busy()) {
    closeSoon();
    return;
  }
  auto* once = new QObject(&window);
  QObject::connect(&jobs, &JobQueue::busyChanged, once, [once, closeSoon](bool busy) {
    if (busy) return;
    once->deleteLater();
    closeSoon();
  });
}

}  // namespace

void MainWindow::connectProject() {
  connect(actions_.saveProject, &QAction::triggered, this, [this] { saveProject(); });
  connect(actions_.saveProjectAs, &QAction::triggered, this, [this] { saveProjectAs(); });
  for (QAction* recent : actions_.recents) {
    connect(recent, &QAction::triggered, this,
            [this, recent] { open({projectPath(recent->data().toString())}); });
  }
  setRecent({});
  connect(actions_.clearRecent, &QAction::triggered, this, [this] { changeRecent({}); });
  connect(&document_, &Document::projectWasSaved, this, [this] {
    addRecent(document_.projectPath());
    // Later: the job that saved is not over yet.
    if (const auto then = std::exchange(whenSaved_, {})) {
      QMetaObject::invokeMethod(this, then, Qt::QueuedConnection);
    }
  });
  connect(&document_, &Document::projectWasOpened, this, [this] {
    actions_.packCt->setChecked(document_.ctStorage() == CtStorage::Packed);
    if (!document_.projectPath().empty()) addRecent(document_.projectPath());
    showView(document_.openedView());
  });
  connect(&document_, &Document::failed, this, [this] { whenSaved_ = {}; });
  connect(&document_.jobs(), &JobQueue::cancelled, this, [this] { whenSaved_ = {}; });
}

void MainWindow::open(std::vector<std::filesystem::path> paths) {
  if (paths.empty()) return;
  if (document_.jobs().busy() && !document_.drawingSeries()) {
    status_->say(tr("A job is running: cancel it or wait before opening something else."));
    return;
  }
  errorCard_->hide();
  const bool project = paths.size() == 1 && isProjectFileName(paths.front());
  if (!project || !document_.workUnsaved()) {
    document_.open(std::move(paths));
    return;
  }
  if (questionIsOpen(*this)) return;
  const auto open = [this, paths] { document_.open(paths); };
  askBeforeLosing(
      this, tr("before another one is opened"), [this, open] { saveProject(open); }, open);
}

void MainWindow::closeEvent(QCloseEvent* event) {
  const bool busy = document_.jobs().busy();
  if (leaving_ || (!busy && !document_.workUnsaved())) {
    event->accept();
    return;
  }
  event->ignore();
  if (questionIsOpen(*this)) return;
  if (busy) {
    askBeforeStopping(this, [this] {
      document_.jobs().cancel();
      closeWhenIdle(*this, document_.jobs());
    });
    return;
  }
  const auto discard = [this] {
    leaving_ = true;
    close();
    leaving_ = false;
  };
  askBeforeLosing(
      this, tr("before the window closes"), [this] { saveProject([this] { close(); }); }, discard);
}

void MainWindow::saveProject(std::function<void()> then) {
  if (document_.projectPath().empty()) {
    saveProjectAs(std::move(then));
  } else {
    saveProjectTo(document_.projectPath(), std::move(then));
  }
}

void MainWindow::saveProjectAs(std::function<void()> then) {
  askWhereToSave(this, tr("Save the project"), tr("Pneuma project (*.pneuma)"),
                 QStringLiteral("pneuma"), [this, then = std::move(then)](const QString& name) {
                   saveProjectTo(projectPath(name), then);
                 });
}

void MainWindow::saveProjectTo(const std::filesystem::path& path, std::function<void()> then) {
  errorCard_->hide();
  whenSaved_ = std::move(then);
  document_.saveProject(path, actions_.packCt->isChecked() ? CtStorage::Packed : CtStorage::Linked,
                        viewNow(), thumbnail());
}

std::string MainWindow::thumbnail() const {
  if (!shownSurfaces_ && !shownTree_) return {};
  const QImage picture = view_->picture();
  if (picture.isNull()) return {};
  QBuffer png;
  png.open(QIODevice::WriteOnly);
  picture.scaledToWidth(ThumbnailWidth, Qt::SmoothTransformation).save(&png, "PNG");
  return png.data().toStdString();
}

Json MainWindow::viewNow() const {
  Json view = document_.projectPath().empty() ? Json::object() : document_.openedView();
  for (const StepButton* step : steps_) {
    if (step->isChecked()) view["step"] = step->objectName().toStdString();
  }
  const ViewDirection from = view_->lookingFrom();
  view["camera"]["azimuth_deg"] = from.azimuthDeg;
  view["camera"]["elevation_deg"] = from.elevationDeg;
  const StereoOptions stereo = actions_.stereo->stereo();
  view["stereo"] = {{"kind", choices(Stereo{})[static_cast<std::size_t>(stereo.stereo)]},
                    {"eye_distance_mm", stereo.eyeDistanceMm}};
  view["hidden"] = Json::array();
  view["density"] = Json::object();
  for (int row = 0; row < structures_.rowCount(); ++row) {
    const auto& structure = structures_.structure(row);
    const std::string name = nameOf(structure);
    if (!name.empty() && !structure.visible) view["hidden"].push_back(name);
    if (!name.empty() && structure.density != 1.0) view["density"][name] = structure.density;
  }
  if (!sliceViews_.empty()) {
    const Vec3& point = sliceViews_.point();
    view["point"] = {point.x(), point.y(), point.z()};
  }
  return view;
}

void MainWindow::showView(const Json& view) {
  try {
    const std::string wanted = view.value("step", std::string());
    for (int i = 0; i < StepCount; ++i) {
      const StepButton& step = *steps_[static_cast<std::size_t>(i)];
      if (step.objectName().toStdString() == wanted && !step.isHidden()) goTo(static_cast<Step>(i));
    }
    const auto hidden = view.value("hidden", std::vector<std::string>());
    for (int row = 0; row < structures_.rowCount(); ++row) {
      const std::string name = nameOf(structures_.structure(row));
      if (name.empty()) continue;
      const bool shown = std::ranges::find(hidden, name) == hidden.end();
      structures_.setData(structures_.index(row), shown ? Qt::Checked : Qt::Unchecked,
                          Qt::CheckStateRole);
      structures_.setData(structures_.index(row),
                          view.value("density", Json::object()).value(name, 1.0),
                          StructureModel::DensityRole);
    }
    if (view.contains("camera")) {
      const Json& camera = view.at("camera");
      view_->look(
          {camera.at("azimuth_deg").get<double>(), camera.at("elevation_deg").get<double>()});
    }
    if (view.contains("stereo")) showStereo(view.at("stereo"));
    if (view.contains("point") && !sliceViews_.empty()) {
      const Json& point = view.at("point");
      sliceViews_.moveTo(
          {point.at(0).get<double>(), point.at(1).get<double>(), point.at(2).get<double>()});
    }
  } catch (const Json::exception&) {
    status_->say(tr("The project does not say how it was looked at."));
  }
}

void MainWindow::showStereo(const Json& view) {
  const auto names = choices(Stereo{});
  const auto kind = std::ranges::find(names, view.at("kind").get<std::string>());
  if (kind == names.end()) return;  // of a newer program
  const StereoOptions stereo{static_cast<Stereo>(kind - names.begin()),
                             view.at("eye_distance_mm").get<double>()};
  actions_.stereo->setStereo(stereo);
  view_->setStereo(actions_.stereo->stereo());
}

void MainWindow::showTitle() {
  const auto& path = document_.projectPath();
  const QString name = path.empty() ? document_.snapshot().name : fileNameOf(path);
  const bool marked = !path.empty() && document_.modified();
  caseName_->setText(name.isEmpty() ? tr("Nothing open")
                     : marked       ? name + QStringLiteral(" *")
                                    : name);
  setWindowTitle(name.isEmpty() ? QStringLiteral("Pneuma") : name + QStringLiteral("[*] - Pneuma"));
  setWindowModified(!name.isEmpty() && document_.workUnsaved());
}

void MainWindow::setRecent(const QStringList& paths) {
  recent_.clear();
  for (const QString& path : paths) {
    if (recent_.size() < RecentProjects && QFileInfo::exists(path)) recent_ << path;
  }
  for (int i = 0; i < RecentProjects; ++i) {
    QAction* action = actions_.recents[static_cast<std::size_t>(i)];
    action->setVisible(i < recent_.size());
    if (!action->isVisible()) continue;
    action->setData(recent_[i]);
    action->setText(QStringLiteral("&%1  %2").arg(i + 1).arg(QFileInfo(recent_[i]).fileName()));
    action->setToolTip(recent_[i]);
  }
  allow(*actions_.clearRecent, !recent_.empty(), tr("Forget which projects were opened of late"),
        tr("No project was opened of late"));
}

void MainWindow::addRecent(const std::filesystem::path& path) {
  const QString name = QFileInfo(qtText(path.string())).absoluteFilePath();
  QStringList paths = recent_;
  paths.removeAll(name);
  paths.prepend(name);
  changeRecent(paths);
}

void MainWindow::changeRecent(const QStringList& paths) {
  setRecent(paths);
  emit recentChanged(recent_);
}

}  // namespace pneuma
