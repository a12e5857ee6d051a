// The journal of a session, autosave and recovery.
#include "editor/session/session.h"
#include "renderer/base/error.h"

namespace lamplighter {

void Session::keepJournal(const std::filesystem::path& root, int process, Journal::Clock clock) {
  crashRecovery_.start(root, process, std::move(clock), document_);
  editing_.setListener([this](const DocumentChange& change, const std::string& label) {
    const std::string why = crashRecovery_.committed(document_, change, label);
    if (!why.empty()) setStatus(why);
    return why.empty();
  });
}

void Session::recoverWork(size_t number) {
  if (modified())
    throw InputError("recovery.recover", "this level has changes", "save them or undo them first");
  Recovered recovered = recover(crashRecovery_.found().at(number).folder);
  open(recovered.base, recovered.document.path, {});
  editing_.open(recovered.document);
  savedHash_ = recovered.savedHash;
  status_ = recovered.warning.empty()
                ? "Recovered " + std::to_string(recovered.edits) + " edits of " +
                      (document_.path.empty() ? "a new level" : document_.path.filename().string())
                : recovered.warning;
  crashRecovery_.adopt(std::move(recovered));
}

void Session::autosave() {
  if (crashRecovery_.journal() == nullptr) return;
  editing_.commit();
  const auto work = crashRecovery_.journal()->autosave(document_);
  if (!work) return;
  work->write();
  crashRecovery_.journal()->restart(document_, work->needsLevel);
  status_ = "Autosaved to " + (work->folder / "autosave.glb").string();
}

void Session::discardWork(size_t number) {
  discard(crashRecovery_.found().at(number).folder);
  crashRecovery_.look();
  status_ = "Discarded";
}

}  // namespace lamplighter
