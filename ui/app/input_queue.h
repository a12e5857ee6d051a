// The one way in for input, from a hand or a file. It hands out what fits one frame.
#pragma once

#include <deque>
#include <vector>

#include "editor/input/event.h"

namespace lamplighter {

class InputQueue {
 public:
  void push(InputEvent event);
  bool empty() const { return queue_.empty(); }
  // The next events that one frame can show. A frame samples the state of buttons and keys once, so
  // it stops before an event that would hide an earlier one: the pointer leaving where a button has
  // just gone down, a button or key that changes twice.
  std::vector<InputEvent> takeFrame();

 private:
  std::deque<InputEvent> queue_;
};

}  // namespace lamplighter
