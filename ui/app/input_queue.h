// The only entry for input, from the user or from a file. It returns the events in portions that
// fit one frame.
#pragma once

#include <deque>
#include <vector>

#include "editor/input/event.h"

namespace lamplighter {

class InputQueue {
 public:
  void push(InputEvent event);
  bool empty() const { return queue_.empty(); }
  // The next events that one frame can show. A frame reads the state of buttons and keys once. So
  // this stops before an event that would hide an earlier one: for example, the pointer leaves the
  // place of a button press, or a button or key changes twice.
  std::vector<InputEvent> takeFrame();

 private:
  std::deque<InputEvent> queue_;
};

}  // namespace lamplighter
