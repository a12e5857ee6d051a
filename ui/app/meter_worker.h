// Traces the reference of the error meter in parallel with the frames, with the CPU time that they
// leave.
#pragma once

#include <atomic>
#include <condition_variable>
#include <memory>
#include <mutex>
#include <string>
#include <thread>

#include "editor/error_meter/error_meter.h"

namespace lamplighter {

class MeterWorker {
 public:
  MeterWorker() = default;
  ~MeterWorker();
  MeterWorker(const MeterWorker&) = delete;
  MeterWorker& operator=(const MeterWorker&) = delete;

  // Call once per frame: gets the wanted subject from the meter, and gives it the latest result.
  // Returns why there is no figure, for example for lack of memory: once, until there is one again.
  std::string exchange(ErrorMeter& meter);

 private:
  void run();
  void trace(const std::shared_ptr<const MeterSubject>& subject);

  std::thread thread_;  // started with the first subject
  std::mutex mutex_;
  std::condition_variable changed_;
  std::shared_ptr<const MeterSubject> wanted_;     // null: no subject
  std::shared_ptr<const ReferenceHalves> traced_;  // result that the meter does not have yet
  std::string problem_;                            // that exchange() has not returned yet
  std::atomic<bool> stop_ = false;                 // the current subject is no longer wanted
  bool quit_ = false;
  std::unique_ptr<ReferenceSampler> sampler_;  // used only by the thread
};

}  // namespace lamplighter
