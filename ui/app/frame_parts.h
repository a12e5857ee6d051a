// Runs the parts of a frame so that an exception ends only the part that throws it.
#pragma once

#include <exception>
#include <functional>
#include <map>
#include <string>

#include "editor/session/session.h"

namespace lamplighter {

class FrameParts {
 public:
  // true: exceptions are passed on instead. A replay ends with them.
  void setStrict(bool strict) { strict_ = strict; }

  // Runs a part. If it throws, undoes the edit that it was making, ends the ImGui windows that it
  // began, and sets the status: once for consecutive failures with the same message. `part` is the
  // name for that message. Not for use within a window of ImGui.
  void run(Session& session, const std::string& part, const std::function<void()>& work);

 private:
  bool strict_ = false;
  std::map<std::string, std::string> told_;  // messages by part, while it fails
};

}  // namespace lamplighter
