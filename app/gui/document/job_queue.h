#pragma once

#include <QElapsedTimer>
#include <QObject>
#include <QString>
#include <QTimer>
#include <array>
#include <condition_variable>
#include <cstdint>
#include <deque>
#include <functional>
#include <initializer_list>
#include <memory>
#include <mutex>
#include <stop_token>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include "core/progress.h"

namespace pneuma {

/// What a job is for, where anybody asks whether such a job runs.
enum class JobKind {
  Other,
  FindingLungs,
  FollowingLungs,   ///< what follows corrections of the lungs
  CorrectingLungs,  ///< by edits that take a while
  LookingForFissures,
  TracingFissures,
  Splitting,
  Growing,
  Comparing,
  Breathing,
  Exporting,      ///< a case or its report
  DrawingSeries,  // last: JobQueue counts up to it
};

/// Runs long work one job after the other on a thread of its own and delivers the results on the
/// thread the queue lives on.
///
/// The worker touches no Qt object: a timer, running only while there is work, collects progress
/// and results. Every member function is for the queue's own thread.
class JobQueue : public QObject {
  Q_OBJECT

 public:
  /// What is left to do with a result, on the queue's thread.
  using Continuation = std::function<void()>;

  /// The work itself, on the worker. What it throws becomes failed() or cancelled(), unless it is
  /// superseded.
  using Compute = std::function<Continuation(const Progress& progress)>;

  /// So many points wait at most to be told by placed(), 48 MB of them; what a job places while
  /// that many wait, because this thread is held up, is not told.
  static constexpr std::size_t MostPointsWaiting = 2'000'000;

  explicit JobQueue(QObject* parent = nullptr);

  /// Cancels what runs and waits for it (a job stops within 0.5 s).
  ~JobQueue() override;

  /// @param title what people read while it runs, for example "Growing airways"
  void push(JobKind kind, const QString& title, Compute compute);

  void push(const QString& title, Compute compute) {
    push(JobKind::Other, title, std::move(compute));
  }

  /// Stops what runs and forgets what waits. A result that is ready but not delivered yet is thrown
  /// away too: after cancel() no continuation of an earlier push() runs.
  void cancel();

  /// As cancel(), of such jobs alone, which something newer makes useless: cancelled() is not told,
  /// and has() is false.
  void supersede(std::initializer_list<JobKind> kinds);

  /// True from push() until the last job's result has been delivered, thrown away or failed.
  bool busy() const { return pending_ > 0; }

  /// True from push() until a job of this kind is about to be delivered or thrown away, or failed.
  bool has(JobKind kind) const { return of(kind).pending > 0; }

  /// True while has() is true of any kind but these.
  bool hasOthersThan(std::initializer_list<JobKind> kinds) const;

 signals:
  void busyChanged(bool busy);

  /// @param fraction of the running job in [0, 1]
  /// @param what the step it is at, may be empty
  void progressed(const QString& title, double fraction, const QString& what);

  /// @param points that the running job has placed since the last time, LPS, mm; told ten times a
  /// second at most, so that those of the last moment before finished() may be missing
  void placed(const std::vector<pneuma::Vec3>& points);

  void finished(const QString& title);
  void cancelled(const QString& title, pneuma::JobKind kind);

  /// @param sentence what is wrong and what to do
  void failed(const QString& title, const QString& sentence);

 private:
  struct Job;

  struct OfOneKind {
    int pending = 0;                   ///< and not superseded
    std::uint64_t supersededUpTo = 0;  ///< which job, as they were pushed
  };

  static constexpr std::size_t Kinds = static_cast<std::size_t>(JobKind::DrawingSeries) + 1;

  OfOneKind& of(JobKind kind) { return kinds_[static_cast<std::size_t>(kind)]; }

  const OfOneKind& of(JobKind kind) const { return kinds_[static_cast<std::size_t>(kind)]; }

  bool isSuperseded(const Job& job) const;
  bool isVoid(const Job& job) const;
  void work(const std::stop_token& stop);
  void collect();
  void deliver(Job& job);
  void tellProgress(Job& job);
  void tellPoints(Job& job);

  QTimer timer_;
  QElapsedTimer sincePoints_;
  int pending_ = 0;
  std::array<OfOneKind, Kinds> kinds_{};
  std::uint64_t last_ = 0;           ///< job, as they were pushed
  std::uint64_t cancelledUpTo_ = 0;  ///< which job

  std::mutex mutex_;  ///< guards the three below
  std::deque<std::shared_ptr<Job>> waiting_;
  std::shared_ptr<Job> running_;
  std::deque<std::shared_ptr<Job>> done_;
  std::condition_variable_any wake_;
  std::jthread worker_;  ///< last: joined before anything it uses goes
};

}  // namespace pneuma

Q_DECLARE_METATYPE(pneuma::JobKind)
