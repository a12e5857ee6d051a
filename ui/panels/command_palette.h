// Every action by its name: type a part of it, choose with the arrow keys, Enter runs it. Words
// after the name are the action's arguments.
#pragma once

#include <string>
#include <vector>

#include "ui/widgets/widgets.h"

namespace lamplighter {

// The actions that fit what was typed, best first: each of its words occurs in the name or the
// label. Once the name of an action and a space stand there it is that action alone, and what
// follows are arguments.
std::vector<const Action*> matchingActions(const ActionRegistry& registry, const std::string& text);

class CommandPalette {
 public:
  // With a text to begin with, such as "edit.duplicate_line ".
  void open(std::string text = "");
  // What is to be run, once; "": nothing yet.
  std::string draw(PanelContext ui);

 private:
  std::string text_;
  int chosen_ = 0;
  bool opening_ = false, takesFocus_ = false;
};

}  // namespace lamplighter
