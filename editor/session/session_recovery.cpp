// What a session does so that no work is lost.
#include "editor/session/session.h"
#include "renderer/base/error.h"

namespace lamplighter {

void Session::keepJournal(const std::filesystem::path& root, int process, Journal::Clock clock) {
  crashRecovery_.start(root, process, std::move(clock), document_);
  history_.setListener([this](const std::string& label) {
    if (std::string why = crashRecovery_.committed(document_, label); !why.empty()) setStatus(why);
  });
}

void Session::recoverWork(size_t number) {
  if (modified())
    throw InputError("recovery.recover", "this level has changes", "save them or undo them first");
  Recovered recovered = recover(crashRecovery_.found().at(number).folder);
  const Document document = recovered.document;
  open(recovered.base, document.path, {});
  document_.scene = document.scene;
  document_.render = document.render;
  history_.showAll();
  savedHash_ = recovered.savedHash;
  status_ = recovered.warning.empty()
                ? "Recovered " + std::to_string(recovered.edits) + " edits of " +
                      (document.path.empty() ? "a new level" : document.path.filename().string())
                : recovered.warning;
  crashRecovery_.adopt(std::move(recovered));
}

void Session::autosave() {
  if (crashRecovery_.journal() == nullptr) return;
  history_.commit();
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
