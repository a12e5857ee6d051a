// Writes autosaves on another thread, because a large level takes seconds.
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

  // Call once per frame. Starts an autosave when it is time, and handles a finished one. `seconds`:
  // the time of a clock.
  void frame(Session& session, double seconds);
  void finish();  // waits for the current autosave

 private:
  std::thread thread_;
  std::atomic<bool> written_ = false;
  std::optional<Journal::Autosave> work_;
  std::string error_;   // written by the thread
  double last_ = -1.0;  // start time of the last autosave; < 0: frame() was never called
  int editsThen_ = 0;   // edits in the journal when the last autosave started
};

}  // namespace lamplighter
