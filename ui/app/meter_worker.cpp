#include "ui/app/meter_worker.h"

#include <algorithm>
#include <exception>
#include <utility>

#include <sys/resource.h>
#include <sys/syscall.h>
#include <tbb/task_arena.h>
#include <unistd.h>

#include "editor/notices/failure_text.h"

namespace lamplighter {
namespace {

// Paths per block in each half; more would not change the displayed figures.
constexpr int kMostSamples = 4096;

// Number of threads of the worker. Frames use all threads if they can.
int threadsBeside() { return std::max(1, tbb::this_task_arena::max_concurrency() / 4); }

// Lowers the priority of this thread: if others want the core, it gets a tenth of it. A figure then
// appears after some seconds even during refinement. Linux has priorities per thread.
void yieldToOthers() {
  constexpr int kNice = 10;
  const auto thread = static_cast<id_t>(::syscall(SYS_gettid));
  ::setpriority(PRIO_PROCESS, thread, kNice);  // on failure the priority is unchanged
}

}  // namespace

MeterWorker::~MeterWorker() {
  if (!thread_.joinable()) return;
  {
    const std::lock_guard lock(mutex_);
    quit_ = true;
    stop_ = true;
  }
  changed_.notify_one();
  thread_.join();
}

std::string MeterWorker::exchange(ErrorMeter& meter) {
  const std::shared_ptr<const MeterSubject> wanted = meter.wanted();
  if (!thread_.joinable()) {
    if (!wanted) return {};
    thread_ = std::thread([this] { run(); });
  }
  std::shared_ptr<const ReferenceHalves> traced;
  std::string problem;
  {
    const std::lock_guard lock(mutex_);
    traced = std::exchange(traced_, nullptr);
    problem = std::exchange(problem_, {});
    if (wanted != wanted_) {
      wanted_ = wanted;
      stop_ = true;
      changed_.notify_one();
    }
  }
  if (traced) meter.take(std::move(traced));
  return problem;
}

void MeterWorker::run() {
  yieldToOthers();
  tbb::task_arena beside(threadsBeside(), 1, tbb::task_arena::priority::low);
  std::shared_ptr<const MeterSubject> done;
  std::string told;  // the problem of the last subject
  for (;;) {
    std::shared_ptr<const MeterSubject> subject;
    {
      std::unique_lock lock(mutex_);
      changed_.wait(lock, [&] { return quit_ || (wanted_ && wanted_ != done); });
      if (quit_) return;
      subject = wanted_;
      stop_ = false;
    }
    try {
      beside.execute([&] { trace(subject); });
      told.clear();
    } catch (const std::exception& e) {
      sampler_.reset();
      if (const std::string why = failureText(e); why != told) {
        told = why;
        const std::lock_guard lock(mutex_);
        problem_ = why;
      }
    }
    done = std::move(subject);
  }
}

void MeterWorker::trace(const std::shared_ptr<const MeterSubject>& subject) {
  if (!sampler_) sampler_ = std::make_unique<ReferenceSampler>();
  sampler_->begin(*subject);
  for (int i = 0; i < kMostSamples; ++i) {
    if (!sampler_->step([&] { return stop_.load(); })) return;
    auto halves = std::make_shared<const ReferenceHalves>(sampler_->halves());
    const std::lock_guard lock(mutex_);
    if (stop_) return;
    traced_ = std::move(halves);
  }
}

}  // namespace lamplighter
