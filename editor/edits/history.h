// The steps that can be undone and redone, limited only by the memory that they may use.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "editor/edits/document_change.h"

namespace lamplighter {

class History {
 public:
  std::string undoLabel() const { return done_ > 0 ? steps_[done_ - 1].label : ""; }
  std::string redoLabel() const { return done_ < steps_.size() ? steps_[done_].label : ""; }

  // Steps are numbered from 1 in the order they were made, including deleted ones.
  size_t position() const { return forgotten_ + done_; }  // the newest applied step; 0: none
  size_t first() const { return forgotten_; }             // the oldest position that undo can reach
  size_t last() const { return forgotten_ + steps_.size(); }
  const std::string& label(size_t step) const { return steps_.at(step - forgotten_ - 1).label; }

  size_t budget() const { return budget_; }  // bytes
  size_t bytes() const { return bytes_; }    // in use

  // Deletes the oldest steps beyond the budget, but never the newest.
  void setBudget(size_t bytes);
  // Adds an applied step. Deletes the undone steps.
  void push(std::string label, DocumentChange change);
  // The step to undo or redo; the position moves past it.
  const DocumentChange& stepBack() { return steps_[--done_].change; }
  const DocumentChange& stepForward() { return steps_[done_++].change; }
  void clear();

 private:
  struct Step {
    std::string label;
    DocumentChange change;
    size_t bytes = 0;
  };
  void forget();

  std::vector<Step> steps_;
  size_t done_ = 0, forgotten_ = 0;
  size_t bytes_ = 0, budget_ = size_t{256} << 20;
};

}  // namespace lamplighter
