#include "document/recovery.h"

#include <QDateTime>
#include <QDir>
#include <QFileInfo>
#include <QLocale>
#include <QUuid>
#include <utility>

#include "document/text.h"
#include "pipeline/ct_source.h"

namespace pneuma {

namespace {

namespace fs = std::filesystem;

constexpr int SoonMs = 500;  ///< steps that follow one another faster are kept together
constexpr qint64 ForgottenSeconds = 600;  ///< nothing is written for so long
/// Of the steps to undo that are kept with the work: a hundred would take longer than an edit does.
constexpr std::size_t HistoryBytes = std::size_t{64} << 20;

QString qtPath(const fs::path& path) { return qtText(path.string()); }

/// Stops a save whose result nobody wants any more.
class StopSink : public ProgressSink {
 public:
  explicit StopSink(const std::atomic<bool>& stop) : stop_(stop) {}

  void report(double /*fraction*/, std::string_view /*what*/) override {}

  bool stopRequested() const override { return stop_; }

 private:
  const std::atomic<bool>& stop_;
};

void removeKept(const fs::path& file) {
  std::error_code ignored;
  fs::remove(file, ignored);
  fs::remove(file.string() + "~", ignored);
}

/// Takes away what a program that was killed while it wrote left half written.
void removeForgotten(const fs::path& folder) {
  const QDateTime before = QDateTime::currentDateTime().addSecs(-ForgottenSeconds);
  const auto parts =
      QDir(qtPath(folder))
          .entryInfoList({QStringLiteral(".pneuma-*.part")}, QDir::Files | QDir::Hidden);
  for (const QFileInfo& part : parts) {
    if (part.lastModified() < before) QFile::remove(part.filePath());
  }
}

QString lockOf(const fs::path& file) { return qtPath(file) + QStringLiteral(".lock"); }

/// Saves the project, and returns where its CT comes from with its hash.
std::shared_ptr<const CtSource> write(const fs::path& file, Project project,
                                      const std::atomic<bool>& stop) {
  StopSink sink(stop);
  const Progress progress(sink);
  auto source = project.state.model.ctSource;
  if (source && project.state.model.ct) {
    const auto plain =
        std::exchange(source, std::make_shared<const CtSource>(hashed(*source, progress)));
    replaceCtSource(project, plain, source);
  }
  writeProject(file, project, progress);
  return source;
}

}  // namespace

fs::path Recovery::usualFolder() {
  const QByteArray state = qgetenv("XDG_STATE_HOME");
  if (!state.isEmpty()) return fs::path(state.toStdString()) / "pneuma/recovery";
  const QString home = QDir::homePath();
  return home.isEmpty() ? fs::path()
                        : fs::path(home.toStdString()) / ".local/state/pneuma/recovery";
}

Recovery::Recovery(Document& document, const fs::path& folder, QObject* parent)
    : QObject(parent), document_(document) {
  std::error_code error;
  fs::create_directories(folder, error);
  fs::permissions(folder, fs::perms::owner_all, error);
  if (error) return;
  removeForgotten(folder);
  file_ = folder / (QUuid::createUuid().toString(QUuid::WithoutBraces).toStdString() + ".pneuma");
  lock_ = std::make_unique<QLockFile>(lockOf(file_));
  lock_->setStaleLockTime(0);
  if (!lock_->tryLock()) file_.clear();
  timer_.setInterval(SoonMs);
  connect(&timer_, &QTimer::timeout, this, &Recovery::keep);
  connect(&document_, &Document::changed, this, [this] {
    if (!file_.empty() && !timer_.isActive()) timer_.start();
  });
}

Recovery::~Recovery() {
  stop_ = true;
  if (writing_.valid()) writing_.wait();
  if (!file_.empty()) removeKept(file_);
}

bool Recovery::writing() {
  if (!writing_.valid()) return false;
  if (writing_.wait_for(std::chrono::seconds(0)) != std::future_status::ready) return true;
  try {
    hashed_ = writing_.get();
    if (!takenOver_.empty()) removeKept(std::exchange(takenOver_, {}));
  } catch (const std::exception&) {
    // No room or no permission: the user's own saving will say so.
  }
  return false;
}

void Recovery::keep() {
  if (writing() || document_.jobs().busy()) return;
  const std::uint64_t revision = document_.snapshot().revision;
  if (!document_.modified()) removeKept(file_);
  if (!document_.modified() || revision == kept_) {
    kept_ = revision;
    timer_.stop();
    return;
  }
  try {
    startWriting();
    kept_ = revision;
  } catch (const std::exception&) {
    // No memory or no thread just now: tried again in a while.
  }
}

void Recovery::startWriting() {
  Project project = document_.projectNow(HistoryBytes);
  project.view["project"] = document_.projectPath().string();
  // A CT is hashed once.
  if (hashed_ && plain_ == project.state.model.ctSource) {
    replaceCtSource(project, plain_, hashed_);
  } else {
    plain_ = project.state.model.ctSource;
    hashed_ = nullptr;
  }
  writing_ = std::async(std::launch::async, [this, project = std::move(project)]() mutable {
    return write(file_, std::move(project), stop_);
  });
}

std::vector<LostWork> Recovery::lostWork(const fs::path& folder) {
  std::vector<LostWork> lost;
  const QDir directory(qtPath(folder));
  const auto files = directory.entryInfoList({QStringLiteral("*.pneuma")}, QDir::Files, QDir::Time);
  for (const QFileInfo& info : files) {
    const fs::path file = info.filePath().toStdString();
    QLockFile lock(lockOf(file));
    lock.setStaleLockTime(0);
    if (!lock.tryLock()) continue;  // another window is at work on it
    lost.push_back(
        {file, QLocale().toString(info.lastModified(), QStringLiteral("d MMM yyyy, hh:mm"))});
  }
  return lost;
}

void Recovery::throwAway(const LostWork& lost) { removeKept(lost.file); }

void Recovery::recover(const LostWork& lost) {
  takenOver_ = lost.file;
  document_.recover(lost.file);
}

}  // namespace pneuma
