// Finds and reads the journals of killed processes (journal.h).
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "editor/recovery/journal.h"

namespace lamplighter {

struct Recoverable {
  std::filesystem::path folder;
  std::filesystem::path scene;  // empty: the document had no file
  int64_t time = 0;             // of the last edit, seconds since 1970
  int edits = 0;                // since the level was opened or saved
};

// Newest first. Leaves out journals of running processes and journals without unsaved edits.
std::vector<Recoverable> findRecoverable(const std::filesystem::path& root);

struct Recovered {
  Document document;  // state after the last complete line
  Scene base;
  std::filesystem::path folder;
  FileLock lock;
  std::vector<FileStamp> files;
  bool hasLevel = false;
  uint64_t savedHash = 0;  // hash of the scene in its file
  int edits = 0;
  std::vector<std::string> labels;  // labels of the edits since the last autosave, oldest first
  std::string warning;              // "": the document is restored bit for bit
};

// Throws InputError with the problem and, if there is an autosave, its path. Keeps the folder.
Recovered recover(const std::filesystem::path& folder);
// Deletes the folder. Throws InputError if a running process owns it.
void discard(const std::filesystem::path& folder);

// $XDG_STATE_HOME/lamplighter/recovery. The default of the first part is ~/.local/state (XDG Base
// Directory Specification). Empty if neither is set.
std::filesystem::path recoveryFolder();

}  // namespace lamplighter
