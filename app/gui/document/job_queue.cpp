#include "document/job_queue.h"

#include <algorithm>
#include <atomic>
#include <new>
#include <utility>

#include "core/error.h"

namespace pneuma {

namespace {

constexpr int CollectEveryMs = 20;
constexpr int TellPointsEveryMs = 100;

/// What to say of the exception that is being handled. @param after closes a sentence about a fault
std::string sentenceOfException(const std::string& after) {
  try {
    throw;
  } catch (const Error& error) {
    return error.what();
  } catch (const std::bad_alloc&) {
    return "There is not enough memory for this; ask for fewer branches or close other programs.";
  } catch (const std::exception& error) {
    return std::string("Something went wrong inside Pneuma (") + error.what() + ")" + after;
  }
}

}  // namespace

/// One piece of work, its progress and what became of it.
struct JobQueue::Job final : ProgressSink {
  enum class Outcome { Finished, Cancelled, Failed };

  JobKind kind = JobKind::Other;
  std::string title;
  Compute compute;
  std::uint64_t number = 0;  ///< as they were pushed, from 1

  std::atomic<double> fraction = 0.0;
  std::atomic<bool> stop = false;
  std::mutex whatMutex;
  std::string what;
  std::mutex pointsMutex;
  std::vector<Vec3> points;  ///< placed and not told yet

  // Written by the worker before the job is handed over, read afterwards.
  Outcome outcome = Outcome::Finished;
  Continuation continuation;
  std::string sentence;

  void report(double newFraction, std::string_view newWhat) override {
    fraction = newFraction;
    // A name that cannot be stored at once is stored by the next report: never hold up the work.
    const std::unique_lock lock(whatMutex, std::try_to_lock);
    if (lock && what != newWhat) what = newWhat;
  }

  bool stopRequested() const override { return stop; }

  void placed(std::span<const Vec3> newPoints) override {
    const std::lock_guard lock(pointsMutex);
    const std::size_t room = MostPointsWaiting - points.size();
    const auto kept = newPoints.first(std::min(room, newPoints.size()));
    points.insert(points.end(), kept.begin(), kept.end());
  }

  bool wantsPoints() const override { return true; }

  void run() {
    try {
      const Progress progress(*this);
      progress.throwIfStopped();
      continuation = compute(progress);
    } catch (const Cancelled&) {
      outcome = Outcome::Cancelled;
    } catch (const std::exception&) {
      outcome = Outcome::Failed;
      sentence = sentenceOfException("; what was there before is unchanged.");
    }
    compute = nullptr;
  }
};

JobQueue::JobQueue(QObject* parent) : QObject(parent) {
  timer_.setInterval(CollectEveryMs);
  connect(&timer_, &QTimer::timeout, this, &JobQueue::collect);
  worker_ = std::jthread([this](const std::stop_token& stop) { work(stop); });
}

JobQueue::~JobQueue() {
  const std::lock_guard lock(mutex_);
  waiting_.clear();
  if (running_) running_->stop = true;
}

void JobQueue::push(JobKind kind, const QString& title, Compute compute) {
  auto job = std::make_shared<Job>();
  job->kind = kind;
  job->title = title.toStdString();
  job->compute = std::move(compute);
  job->number = last_ + 1;
  {
    const std::lock_guard lock(mutex_);
    waiting_.push_back(std::move(job));
  }
  wake_.notify_one();
  ++last_;
  ++of(kind).pending;
  timer_.start();
  if (++pending_ == 1) emit busyChanged(true);
}

void JobQueue::cancel() {
  cancelledUpTo_ = last_;
  const std::lock_guard lock(mutex_);
  // Those that wait are handed over like those that ran, so that each is answered.
  for (auto& job : waiting_) {
    job->outcome = Job::Outcome::Cancelled;
    done_.push_back(std::move(job));
  }
  waiting_.clear();
  if (running_) running_->stop = true;
}

void JobQueue::supersede(std::initializer_list<JobKind> kinds) {
  for (const JobKind kind : kinds) of(kind) = {0, last_};
  const std::lock_guard lock(mutex_);
  // Those that wait stop at once when it is their turn.
  for (const auto& job : waiting_) {
    if (isSuperseded(*job)) job->stop = true;
  }
  if (running_ && isSuperseded(*running_)) running_->stop = true;
}

bool JobQueue::hasOthersThan(std::initializer_list<JobKind> kinds) const {
  int pending = 0;
  for (const OfOneKind& one : kinds_) pending += one.pending;
  for (const JobKind kind : kinds) pending -= of(kind).pending;
  return pending > 0;
}

bool JobQueue::isSuperseded(const Job& job) const {
  return job.number <= of(job.kind).supersededUpTo;
}

bool JobQueue::isVoid(const Job& job) const {
  return job.number <= cancelledUpTo_ || isSuperseded(job);
}

void JobQueue::work(const std::stop_token& stop) {
  std::unique_lock lock(mutex_);
  while (wake_.wait(lock, stop, [this] { return !waiting_.empty(); })) {
    running_ = std::move(waiting_.front());
    waiting_.pop_front();
    Job& job = *running_;
    lock.unlock();
    job.run();
    lock.lock();
    done_.push_back(std::move(running_));
    running_ = nullptr;
  }
}

void JobQueue::collect() {
  std::deque<std::shared_ptr<Job>> done;
  std::shared_ptr<Job> running;
  {
    const std::lock_guard lock(mutex_);
    done.swap(done_);
    running = running_;
  }
  for (const auto& job : done) deliver(*job);
  if (running) tellProgress(*running);
  if (running) tellPoints(*running);
  if (done.empty()) return;
  pending_ -= static_cast<int>(done.size());
  if (pending_ > 0) return;
  timer_.stop();
  emit busyChanged(false);
}

void JobQueue::tellProgress(Job& job) {
  if (isVoid(job)) return;
  std::string what;
  {
    const std::lock_guard lock(job.whatMutex);
    what = job.what;
  }
  emit progressed(QString::fromStdString(job.title), job.fraction, QString::fromStdString(what));
}

void JobQueue::tellPoints(Job& job) {
  if (isVoid(job)) return;
  if (sincePoints_.isValid() && !sincePoints_.hasExpired(TellPointsEveryMs)) return;
  std::vector<Vec3> points;
  {
    const std::lock_guard lock(job.pointsMutex);
    points.swap(job.points);
  }
  if (points.empty()) return;
  sincePoints_.start();
  emit placed(points);
}

void JobQueue::deliver(Job& job) {
  const QString title = QString::fromStdString(job.title);
  const bool superseded = isSuperseded(job);
  if (!superseded) --of(job.kind).pending;
  if (isVoid(job) || job.outcome == Job::Outcome::Cancelled) {
    job.continuation = nullptr;
    if (!superseded) emit cancelled(title, job.kind);
  } else if (job.outcome == Job::Outcome::Failed) {
    emit failed(title, QString::fromStdString(job.sentence));
  } else {
    std::string problem;
    try {
      if (job.continuation) job.continuation();
    } catch (const std::exception&) {
      problem = sentenceOfException(".");
    }
    if (problem.empty()) {
      emit finished(title);
    } else {
      emit failed(title, QString::fromStdString(problem));
    }
  }
}

}  // namespace pneuma
