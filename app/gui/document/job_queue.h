#pragma once

#include <QElapsedTimer>
#include <QObject>
#include <QString>
#include <QTimer>
#include <condition_variable>
#include <cstdint>
#include <deque>
#include <functional>
#include <memory>
#include <mutex>
#include <stop_token>
#include <string>
#include <thread>
#include <vector>

#include "core/progress.h"

namespace pneuma {

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

  /// The work itself, on the worker. What it throws becomes failed() or cancelled().
  using Compute = std::function<Continuation(const Progress& progress)>;

  /// So many points wait at most to be told by placed(), 48 MB of them; what a job places while
  /// that many wait, because this thread is held up, is not told.
  static constexpr std::size_t MostPointsWaiting = 2'000'000;

  explicit JobQueue(QObject* parent = nullptr);

  /// Cancels what runs and waits for it (a job stops within 0.5 s).
  ~JobQueue() override;

  /// @param title what people read while it runs, for example "Growing airways"
  void push(const QString& title, Compute compute);

  /// Stops what runs and forgets what waits. A result that is ready but not delivered yet is thrown
  /// away too: after cancel() no continuation of an earlier push() runs.
  void cancel();

  /// True from push() until the last job's result has been delivered, thrown away or failed.
  bool busy() const { return pending_ > 0; }

 signals:
  void busyChanged(bool busy);

  /// @param fraction of the running job in [0, 1]
  /// @param what the step it is at, may be empty
  void progressed(const QString& title, double fraction, const QString& what);

  /// @param points that the running job has placed since the last time, LPS, mm; told ten times a
  /// second at most, so that those of the last moment before finished() may be missing
  void placed(const std::vector<pneuma::Vec3>& points);

  void finished(const QString& title);
  void cancelled(const QString& title);

  /// @param sentence what is wrong and what to do
  void failed(const QString& title, const QString& sentence);

 private:
  struct Job;

  void work(const std::stop_token& stop);
  void collect();
  void deliver(Job& job);
  void tellProgress(Job& job);
  void tellPoints(Job& job);

  QTimer timer_;
  QElapsedTimer sincePoints_;
  int pending_ = 0;
  std::uint64_t epoch_ = 0;  ///< raised by cancel(): results of an earlier epoch are void

  std::mutex mutex_;  ///< guards the three below
  std::deque<std::shared_ptr<Job>> waiting_;
  std::shared_ptr<Job> running_;
  std::deque<std::shared_ptr<Job>> done_;
  std::condition_variable_any wake_;
  std::jthread worker_;  ///< last: joined before anything it uses goes
};

}  // namespace pneuma
