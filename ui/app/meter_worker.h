// Traces the error meter's reference beside the frames, on what they leave of the processor.
#pragma once

#include <atomic>
#include <condition_variable>
#include <memory>
#include <mutex>
#include <thread>

#include "editor/error_meter/error_meter.h"

namespace lamplighter {

class MeterWorker {
 public:
  MeterWorker() = default;
  ~MeterWorker();
  MeterWorker(const MeterWorker&) = delete;
  MeterWorker& operator=(const MeterWorker&) = delete;

  // Once a frame: takes what the meter wants traced, hands it what was traced since.
  void exchange(ErrorMeter& meter);

 private:
  void run();
  void trace(const std::shared_ptr<const MeterSubject>& subject);

  std::thread thread_;  // started when something is wanted first
  std::mutex mutex_;
  std::condition_variable changed_;
  std::shared_ptr<const MeterSubject> wanted_;     // null: nothing
  std::shared_ptr<const ReferenceHalves> traced_;  // not handed over yet
  std::atomic<bool> stop_ = false;                 // what is traced is not wanted any more
  bool quit_ = false;
  std::unique_ptr<ReferenceSampler> sampler_;  // the thread's
};

}  // namespace lamplighter
