#include "renderer/prt/transfers.h"

#include <algorithm>
#include <utility>

namespace lamplighter {

Transfers::~Transfers() {
  {
    const std::scoped_lock lock(mutex_);
    queue_.clear();
    if (current_) current_->isCancelled = true;
  }
  if (thread_.joinable()) thread_.join();
}

void Transfers::want(std::vector<Wanted> wanted, const TransferOptions& options) {
  std::unique_lock lock(mutex_);
  options_ = options;
  std::map<TransferKey, std::shared_ptr<const Transfer>> kept;
  queue_.clear();
  bool currentIsWanted = false;
  for (Wanted& w : wanted) {
    const auto it = ready_.find(w.key);
    if (it != ready_.end()) {
      kept.insert(*it);
    } else if (current_ && w.key == currentKey_ && !current_->isCancelled) {
      currentIsWanted = true;
    } else if (std::none_of(queue_.begin(), queue_.end(),
                            [&](const Wanted& q) { return q.key == w.key; })) {
      queue_.push_back(std::move(w));
    }
  }
  std::reverse(queue_.begin(), queue_.end());
  ready_ = std::move(kept);
  if (current_ && !currentIsWanted) current_->isCancelled = true;
  if (queue_.empty() || isRunning_) return;
  isRunning_ = true;
  std::thread last = std::move(thread_);
  lock.unlock();
  if (last.joinable()) last.join();  // it has finished its work
  thread_ = std::thread([this] { work(); });
}

std::shared_ptr<const Transfer> Transfers::find(const TransferKey& key) const {
  const std::scoped_lock lock(mutex_);
  const auto it = ready_.find(key);
  return it == ready_.end() ? nullptr : it->second;
}

void Transfers::wait() {
  std::unique_lock lock(mutex_);
  changed_.wait(lock, [&] { return !isRunning_; });
  if (error_) std::rethrow_exception(std::exchange(error_, nullptr));
}

std::exception_ptr Transfers::takeError() {
  const std::scoped_lock lock(mutex_);
  return std::exchange(error_, nullptr);
}

Transfers::Progress Transfers::progress() const {
  const std::scoped_lock lock(mutex_);
  Progress out;
  out.pending = queue_.size() + (current_ ? 1 : 0);
  if (current_)
    out.share = static_cast<float>(current_->done) /
                static_cast<float>(std::max<uint64_t>(current_->total, 1));
  return out;
}

void Transfers::work() {
  std::unique_lock lock(mutex_);
  while (!queue_.empty()) {
    const Wanted job = std::move(queue_.back());
    queue_.pop_back();
    const auto progress = std::make_shared<TransferProgress>();
    current_ = progress;
    currentKey_ = job.key;
    const TransferOptions options = options_;
    lock.unlock();
    std::optional<Transfer> transfer;
    std::exception_ptr error;
    try {
      transfer = cache_.load(job.key, job.own->positions.size());
      if (!transfer) {
        transfer = compute_(*job.own, options, progress.get());
        if (transfer) cache_.save(job.key, *transfer);
      }
    } catch (...) {  // such as Embree's, out of memory: taken by wait() or takeError()
      error = std::current_exception();
    }
    lock.lock();
    current_.reset();
    if (error) {
      error_ = error;
      queue_.clear();
    } else if (transfer && !progress->isCancelled) {
      ready_[job.key] = std::make_shared<const Transfer>(std::move(*transfer));
    }
  }
  isRunning_ = false;
  changed_.notify_all();
}

}  // namespace lamplighter
