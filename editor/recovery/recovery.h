// Finds and reads what processes that were killed have left (journal.h).
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "editor/recovery/journal.h"

namespace lamplighter {

struct Recoverable {
  std::filesystem::path folder;
  std::filesystem::path scene;  // empty: it had no file
  int64_t time = 0;             // of the last edit, seconds since 1970
  int edits = 0;                // since it was opened or saved
};

// Newest first. Without those of processes that live, and those that have nothing to lose.
std::vector<Recoverable> findRecoverable(const std::filesystem::path& root);

struct Recovered {
  Document document;  // as of the last whole line
  Scene base;
  std::filesystem::path folder;
  FileLock lock;
  std::vector<FileStamp> files;
  bool hasLevel = false;
  uint64_t savedHash = 0;  // of the scene as it is in its file
  int edits = 0;
  std::vector<std::string> labels;  // of the edits, oldest first, since the last autosave
  std::string warning;              // "": it is to the last bit what it was
};

// Throws InputError: what is wrong, and where the autosave is, if there is one. Leaves the folder.
Recovered recover(const std::filesystem::path& folder);
// Takes the folder away; throws InputError when a process lives in it.
void discard(const std::filesystem::path& folder);

// $XDG_STATE_HOME/lamplighter/recovery, or ~/.local/state for the first part (XDG Base Directory
// Specification). Empty where there is neither.
std::filesystem::path recoveryFolder();

}  // namespace lamplighter
