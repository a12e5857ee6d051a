// Writes autosaves beside the frames: a large level takes seconds.
#pragma once

#include <atomic>
#include <optional>
#include <string>
#include <thread>

#include "editor/session/session.h"

namespace lamplighter {

class AutosaveWorker {
 public:
  AutosaveWorker() = default;
  ~AutosaveWorker() { finish(); }
  AutosaveWorker(const AutosaveWorker&) = delete;
  AutosaveWorker& operator=(const AutosaveWorker&) = delete;

  // Once a frame, `seconds` by a clock: begins one when it is time, takes in what was written.
  void frame(Session& session, double seconds);
  void finish();  // waits for what is being written

 private:
  std::thread thread_;
  std::atomic<bool> written_ = false;
  std::optional<Journal::Autosave> work_;
  std::string error_;   // the thread's, until it is written
  double last_ = -1.0;  // when one was begun; < 0: never looked
  int editsThen_ = 0;   // in the journal when the last one was begun
};

}  // namespace lamplighter
