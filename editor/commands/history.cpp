#include "editor/commands/history.h"

namespace lamplighter {

void History::run(std::unique_ptr<Command> command) {
  if (!open_ && command->changesNothing()) return;
  command->apply(document_);
  dirty_ = true;
  if (!open_) {
    Step step;
    step.label = command->label();
    step.commands.push_back(std::move(command));
    push(std::move(step));
    return;
  }
  if (open_->label.empty()) open_->label = command->label();
  if (open_->commands.empty() || !open_->commands.back()->absorb(*command)) {
    open_->commands.push_back(std::move(command));
  }
}

void History::push(Step step) {
  steps_.resize(done_);  // what was undone cannot be redone any more
  steps_.push_back(std::move(step));
  done_ = steps_.size();
  tell(steps_.back().label);
}

void History::begin(std::string label) {
  commit();
  open_ = std::make_unique<Step>();
  open_->label = std::move(label);
}

void History::commit() {
  if (!open_) return;
  Step step = std::move(*open_);
  open_.reset();
  std::erase_if(step.commands, [](const auto& c) { return c->changesNothing(); });
  if (!step.commands.empty()) push(std::move(step));
}

void History::cancel() {
  if (!open_) return;
  for (auto c = open_->commands.rbegin(); c != open_->commands.rend(); ++c) (*c)->revert(document_);
  open_.reset();
  dirty_ = true;
}

bool History::inTransaction() const { return open_ != nullptr; }

bool History::canUndo() const { return done_ > 0 || (open_ && !open_->commands.empty()); }
bool History::canRedo() const { return !open_ && done_ < steps_.size(); }
std::string History::undoLabel() const { return done_ > 0 ? steps_[done_ - 1].label : ""; }
std::string History::redoLabel() const { return canRedo() ? steps_[done_].label : ""; }

void History::undo() {
  commit();
  if (done_ == 0) return;
  Step& step = steps_[--done_];
  for (auto c = step.commands.rbegin(); c != step.commands.rend(); ++c) (*c)->revert(document_);
  dirty_ = true;
  tell("Undo: " + step.label);
}

void History::redo() {
  commit();
  if (done_ == steps_.size()) return;
  for (const auto& c : steps_[done_++].commands) c->apply(document_);
  dirty_ = true;
  tell("Redo: " + steps_[done_ - 1].label);
}

void History::clear() {
  steps_.clear();
  done_ = 0;
  open_.reset();
  first_ = true;
}

size_t History::position() const { return done_; }

SceneChanges History::takeChanges() {
  SceneChanges changes;
  if (first_) {
    changes = SceneChanges::all();
  } else if (dirty_) {
    changes = compare(shown_, document_.scene);
  } else {
    return changes;
  }
  shown_ = document_.scene;
  first_ = dirty_ = false;
  return changes;
}

}  // namespace lamplighter
