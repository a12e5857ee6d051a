#include "editor/edits/history.h"

#include "renderer/base/error.h"

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
  // What was undone cannot be redone any more.
  for (size_t i = done_; i < steps_.size(); ++i) bytes_ -= steps_[i].bytes;
  steps_.resize(done_);
  step.bytes = sizeof step + step.label.size();
  for (const auto& c : step.commands) step.bytes += c->bytes();
  bytes_ += step.bytes;
  steps_.push_back(std::move(step));
  done_ = steps_.size();
  forget();
  tell(steps_.back().label);
}

void History::forget() {
  size_t count = 0;
  // Steps that are undone go last: nothing brings them back.
  for (; bytes_ > budget_ && count < done_ && count + 1 < steps_.size(); ++count)
    bytes_ -= steps_[count].bytes;
  steps_.erase(steps_.begin(), steps_.begin() + static_cast<std::ptrdiff_t>(count));
  done_ -= count;
  forgotten_ += count;
}

void History::setBudget(size_t bytes) {
  budget_ = bytes;
  forget();
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

void History::undoStep() {
  const Step& step = steps_[--done_];
  for (auto c = step.commands.rbegin(); c != step.commands.rend(); ++c) (*c)->revert(document_);
  dirty_ = true;
}

void History::redoStep() {
  for (const auto& c : steps_[done_++].commands) c->apply(document_);
  dirty_ = true;
}

void History::undo() {
  commit();
  if (done_ == 0) return;
  undoStep();
  tell("Undo: " + steps_[done_].label);
}

void History::redo() {
  commit();
  if (done_ == steps_.size()) return;
  redoStep();
  tell("Redo: " + steps_[done_ - 1].label);
}

void History::goTo(size_t step) {
  commit();
  if (step < first() || step > last())
    throw InputError("step " + std::to_string(step), "is not in the history",
                     "give one from " + std::to_string(first()) + " to " + std::to_string(last()));
  if (step == position()) return;
  while (position() > step) undoStep();
  while (position() < step) redoStep();
  tell("Go to step " + std::to_string(step));
}

void History::clear() {
  steps_.clear();
  done_ = forgotten_ = bytes_ = 0;
  open_.reset();
  first_ = true;
}

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
