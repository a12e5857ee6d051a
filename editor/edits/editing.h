// The document that is being edited, with its history. All changes go through transactions: they
// become steps that can be undone, are reported to a listener, and tell the renderer what to
// update.
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "editor/edits/history.h"
#include "editor/edits/transaction.h"

namespace lamplighter {

class Editing {
 public:
  const Document& document() const { return document_; }
  const History& history() const { return history_; }

  // Starts an edit that becomes one step, if it changes something. Within another one it joins that
  // step, but can still be rolled back on its own. With an empty label, the step gets the label of
  // the first edit inside.
  Transaction begin(std::string label);
  // Starts an edit that lasts over several frames without an owner, as in a field of a panel, until
  // commit() or cancel(). Commits an open edit.
  void hold(std::string label);
  bool inTransaction() const { return !open_.empty(); }
  void commit();  // commits all open edits as one step
  void cancel();

  bool canUndo() const;
  bool canRedo() const;
  // These commit an open transaction first.
  void undo();
  void redo();
  // Undoes or redoes until `step` is the newest applied step. Throws InputError if it is not
  // between first() and last() of the history.
  void goTo(size_t step);
  void setBudget(size_t bytes) { history_.setBudget(bytes); }  // of the history

  // Replaces the document and clears the history.
  void open(Document document);
  void setPath(std::filesystem::path path) { document_.path = std::move(path); }
  // Sets the initial render settings; not a step that can be undone.
  void setInitialRender(RenderSettings render);
  // Selects the nodes that exist; the last one is active. This does not count as a modification.
  void select(std::vector<NodeId> ids);
  // An id that was never used before in this document, not even by removed nodes.
  NodeId newNodeId() { return document_.scene.nextId++; }

  // Called after every step that was applied, undone or redone, with the changes since the last
  // call. If it returns false, the next call includes this change.
  using Listener = std::function<bool(const DocumentChange& change, const std::string& label)>;
  void setListener(Listener listener);

  // Changes since the last call.
  SceneChanges takeChanges();

 private:
  friend class Transaction;
  struct Open {
    uint64_t id;
    std::string label;
    DocumentChange change;
  };
  // Calls record(change) for every change that is being recorded.
  template <typename Record>
  void recordInAll(Record record) {
    for (Open& o : open_) record(o.change);
    record(untold_);
    record(unshown_);
  }
  void put(const DocumentChange& change, void (DocumentChange::*side)(Document&) const);
  bool isOpen(uint64_t id) const;
  void commit(uint64_t id);  // with all edits that were started in it
  void cancel(uint64_t id);
  void tell(const std::string& label);

  Document document_;
  History history_;
  std::vector<Open> open_;  // each one is nested in the previous one
  uint64_t lastId_ = 0;
  DocumentChange untold_;   // since the listener was called
  DocumentChange unshown_;  // since takeChanges()
  bool showsAll_ = true;
  Listener listener_;
};

}  // namespace lamplighter
