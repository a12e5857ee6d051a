// The command palette lists every action. The user types a part of the name, chooses with the arrow
// keys, and runs the action with Enter. Words after the name are the arguments.
#pragma once

#include <string>
#include <vector>

#include "ui/widgets/widgets.h"

namespace lamplighter {

// The actions that match the typed text, best first. All typed words must occur in the name or the
// label. After the full name of an action and a space, only that action matches, and the rest of
// the text is its arguments.
std::vector<const Action*> matchingActions(const ActionRegistry& registry, const std::string& text);

class CommandPalette {
 public:
  // Opens with an initial text, for example "edit.duplicate_line ".
  void open(std::string text = "");
  // The action text to run, once; "": none.
  std::string draw(PanelContext ui);

 private:
  std::string text_;
  int chosen_ = 0;
  bool opening_ = false, takesFocus_ = false;
};

}  // namespace lamplighter
