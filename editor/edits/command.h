// One undoable change. A command holds the values that differ and swaps them with the document's,
// so that doing and undoing are the same code.
#pragma once

#include <cstddef>
#include <memory>
#include <string>

#include "editor/document/document.h"

namespace lamplighter {

class Command {
 public:
  virtual ~Command() = default;
  virtual std::string label() const = 0;        // "Move Lamp"
  virtual void apply(Document& document) = 0;   // do and redo
  virtual void revert(Document& document) = 0;  // undo
  // Takes in a later command of the same drag, so that a drag is one step; false: not the same.
  virtual bool absorb(const Command& later) = 0;
  // Before and after are equal: not worth a step.
  virtual bool changesNothing() const { return false; }
  // What it keeps, about, for the history's budget. What it brought in or took out counts though
  // the document may share it, since an undo may leave the command the only owner.
  virtual size_t bytes() const = 0;
};

}  // namespace lamplighter
