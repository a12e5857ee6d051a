#include "ui/app/autosave_worker.h"

#include <spdlog/spdlog.h>

#include "editor/notices/failure_text.h"

namespace lamplighter {

namespace {

// The journal already has every edit. An autosave helps if the level's file is lost, and other
// programs can open it.
constexpr double kSecondsBetween = 120.0;

}  // namespace

void AutosaveWorker::finish() {
  if (thread_.joinable()) thread_.join();
}

void AutosaveWorker::frame(Session& session, double seconds) {
  Journal* journal = session.crashRecovery().journal();
  if (journal == nullptr) return;
  // Not during a drag, because it may be cancelled.
  if (session.editing().inTransaction()) return;
  if (work_ && written_) {
    finish();
    if (journal->folder() != work_->folder) {
      // Another level was opened meanwhile; drop the result.
    } else if (!error_.empty()) {
      session.setStatus("Autosave: " + error_);
    } else {
      try {
        journal->restart(session.document(), work_->needsLevel);
        spdlog::info("autosaved to {}", (work_->folder / "autosave.glb").string());
      } catch (const std::exception& e) {
        session.setStatus("Autosave: " + failureText(e));
      }
    }
    work_.reset();
  }
  if (last_ < 0.0) last_ = seconds;
  if (work_ || seconds - last_ < kSecondsBetween) return;
  last_ = seconds;
  if (journal->edits() == editsThen_) return;
  work_ = journal->autosave(session.document());
  if (!work_) return;
  editsThen_ = journal->edits();
  written_ = false;
  error_.clear();
  thread_ = std::thread([this] {
    try {
      work_->write();
    } catch (const std::exception& e) {
      error_ = failureText(e);
    }
    written_ = true;
  });
}

}  // namespace lamplighter
