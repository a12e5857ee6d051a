// Undo and redo, without limit but what they may keep in memory.
#pragma once

#include <cstddef>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "editor/edits/command.h"
#include "renderer/scene/scene_changes.h"

namespace lamplighter {

class History {
 public:
  explicit History(Document& document) : document_(document) {}

  // Applies the command and makes it the newest step. Within a transaction it joins the open step.
  void run(std::unique_ptr<Command> command);

  // A drag or another edit in many small changes that is one step. Nothing is added when nothing
  // changed. Transactions do not nest: beginning one commits the open one.
  void begin(std::string label);
  void commit();
  void cancel();  // puts back what was before begin()
  bool inTransaction() const;

  bool canUndo() const;
  bool canRedo() const;
  std::string undoLabel() const;
  std::string redoLabel() const;
  void undo();  // commits an open transaction first
  void redo();
  void clear();

  // Steps are numbered from 1 as they are made, also those that were forgotten for lack of memory.
  size_t position() const { return forgotten_ + done_; }  // the newest step that is done; 0: none
  size_t first() const { return forgotten_; }             // as far back as undo goes
  size_t last() const { return forgotten_ + steps_.size(); }
  const std::string& label(size_t step) const { return steps_.at(step - forgotten_ - 1).label; }
  // Undoes or redoes until `step` is the newest that is done. Throws InputError when that is not
  // between first() and last().
  void goTo(size_t step);

  // What steps keep may take so many bytes; then the oldest are forgotten, but never the newest.
  void setBudget(size_t bytes);
  size_t budget() const { return budget_; }
  size_t bytes() const { return bytes_; }

  // Told of every step done, undone or redone, once the document is so; never within a transaction.
  using Listener = std::function<void(const std::string& label)>;
  void setListener(Listener listener) { listener_ = std::move(listener); }

  // What changed since the last call, found by comparing scenes; the frame's SceneChanges.
  SceneChanges takeChanges();
  // What was taken did not arrive: the next changes are everything.
  void showAll() { first_ = true; }

 private:
  struct Step {
    std::string label;
    std::vector<std::unique_ptr<Command>> commands;
    size_t bytes = 0;
  };
  void push(Step step);
  void undoStep();
  void redoStep();
  void forget();  // steps beyond the budget
  void tell(const std::string& label) const {
    if (listener_) listener_(label);
  }

  Document& document_;
  std::vector<Step> steps_;
  size_t done_ = 0, forgotten_ = 0;
  size_t bytes_ = 0, budget_ = size_t{256} << 20;
  std::unique_ptr<Step> open_;
  Listener listener_;
  Scene shown_;         // the scene as of the last takeChanges()
  bool first_ = true;   // nothing was shown yet: everything is new
  bool dirty_ = false;  // something was done since the last takeChanges()
};

}  // namespace lamplighter
