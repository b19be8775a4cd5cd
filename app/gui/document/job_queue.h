#pragma once

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

  void finished(const QString& title);
  void cancelled(const QString& title);

  /// @param sentence what is wrong and what to do
  void failed(const QString& title, const QString& sentence);

 private:
  struct Job;

  void work(const std::stop_token& stop);
  void collect();
  void deliver(Job& job);

  QTimer timer_;
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
