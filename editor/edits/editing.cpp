#include "editor/edits/editing.h"

#include <algorithm>
#include <unordered_set>

#include "renderer/base/error.h"

namespace lamplighter {

Transaction Editing::begin(std::string label) {
  if (!open_.empty() && open_.front().label.empty()) open_.front().label = label;
  open_.push_back({++lastId_, std::move(label), {}});
  return Transaction(*this, lastId_);
}

void Editing::hold(std::string label) {
  commit();
  open_.push_back({++lastId_, std::move(label), {}});
}

bool Editing::isOpen(uint64_t id) const {
  return std::any_of(open_.begin(), open_.end(), [&](const Open& o) { return o.id == id; });
}

void Editing::commit() {
  if (!open_.empty()) commit(open_.front().id);
}

void Editing::cancel() {
  if (!open_.empty()) cancel(open_.front().id);
}

void Editing::commit(uint64_t id) {
  if (!isOpen(id)) return;
  while (open_.back().id != id) open_.pop_back();
  if (open_.size() > 1) return open_.pop_back();
  open_.back().change.complete(document_);
  Open done = std::move(open_.back());
  open_.pop_back();
  if (done.change.empty()) return;
  history_.push(std::move(done.label), std::move(done.change));
  tell(history_.undoLabel());
}

void Editing::cancel(uint64_t id) {
  if (!isOpen(id)) return;
  while (open_.back().id != id) open_.pop_back();
  // It is closed last: after an exception it can be cancelled again.
  DocumentChange& change = open_.back().change;
  change.complete(document_);
  put(change, &DocumentChange::revert);
  open_.pop_back();
}

void Editing::put(const DocumentChange& change, void (DocumentChange::*side)(Document&) const) {
  recordInAll([&](DocumentChange& c) { c.recordAll(document_, change); });
  (change.*side)(document_);
  select(std::move(document_.selection));  // what is selected may be gone
}

bool Editing::canUndo() const {
  return history_.position() > history_.first() ||
         (!open_.empty() && !open_.front().change.empty());
}

bool Editing::canRedo() const { return open_.empty() && history_.position() < history_.last(); }

void Editing::undo() {
  commit();
  if (!canUndo()) return;
  const std::string label = history_.undoLabel();
  put(history_.stepBack(), &DocumentChange::revert);
  tell("Undo: " + label);
}

void Editing::redo() {
  commit();
  if (!canRedo()) return;
  put(history_.stepForward(), &DocumentChange::apply);
  tell("Redo: " + history_.undoLabel());
}

void Editing::goTo(size_t step) {
  commit();
  if (step < history_.first() || step > history_.last())
    throw InputError("step " + std::to_string(step), "is not in the history",
                     "give one from " + std::to_string(history_.first()) + " to " +
                         std::to_string(history_.last()));
  if (step == history_.position()) return;
  while (history_.position() > step) put(history_.stepBack(), &DocumentChange::revert);
  while (history_.position() < step) put(history_.stepForward(), &DocumentChange::apply);
  tell("Go to step " + std::to_string(step));
}

void Editing::open(Document document) {
  document_ = std::move(document);
  history_.clear();
  open_.clear();
  untold_ = unshown_ = {};
  showsAll_ = true;
}

void Editing::setInitialRender(RenderSettings render) {
  DocumentChange::record(untold_.render, document_.render);
  document_.render = std::move(render);
}

void Editing::select(std::vector<NodeId> ids) {
  // If an id is given twice, the last one counts.
  std::unordered_set<NodeId> taken;
  std::reverse(ids.begin(), ids.end());
  std::erase_if(ids, [&](NodeId id) {
    return document_.scene.find(id) == nullptr || !taken.insert(id).second;
  });
  std::reverse(ids.begin(), ids.end());
  document_.selection = std::move(ids);
}

void Editing::setListener(Listener listener) {
  listener_ = std::move(listener);
  untold_ = {};
}

void Editing::tell(const std::string& label) {
  if (listener_) {
    untold_.complete(document_);
    if (!listener_(untold_, label)) return;
  }
  untold_ = {};
}

SceneChanges Editing::takeChanges() {
  SceneChanges changes = SceneChanges::all();
  if (!showsAll_) {
    unshown_.complete(document_);
    changes = sceneChanges(unshown_, document_.scene);
  }
  unshown_ = {};
  showsAll_ = false;
  return changes;
}

}  // namespace lamplighter
