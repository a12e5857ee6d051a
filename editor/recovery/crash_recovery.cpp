#include "editor/recovery/crash_recovery.h"

#include "editor/notices/failure_text.h"

namespace lamplighter {

void CrashRecovery::start(std::filesystem::path root, int process, Journal::Clock clock,
                          const Document& document) {
  root_ = std::move(root);
  journal_ = std::make_unique<Journal>(root_, process, std::move(clock));
  journal_->begin(document);
  look();
}

void CrashRecovery::look() { found_ = findRecoverable(root_); }

template <typename Write>
std::string CrashRecovery::tried(Write write) {
  if (!journal_) return {};
  try {
    write(*journal_);
    return {};
  } catch (const std::exception& e) {
    return "The journal is not complete: " + failureText(e);
  }
}

std::string CrashRecovery::opened(const Document& document) {
  return tried([&](Journal& j) { j.begin(document); });
}

std::string CrashRecovery::committed(const Document& document, const DocumentChange& change,
                                     const std::string& label) {
  return tried([&](Journal& j) { j.record(document, change, label); });
}

std::string CrashRecovery::saving(const Document& document) {
  return tried([&](Journal& j) { j.saving(document); });
}

std::string CrashRecovery::saved(const Document& document) {
  return tried([&](Journal& j) { j.saved(document); });
}

void CrashRecovery::adopt(Recovered recovered) {
  if (journal_) journal_->adopt(std::move(recovered));
  look();
}

void CrashRecovery::close() {
  if (journal_) journal_->close();
}

}  // namespace lamplighter
