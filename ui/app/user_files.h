// The user's settings.json and keys.json. Both are read when the window opens; settings.json is
// written after a change. Replays and recordings do not use them.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "editor/keys/key_bindings.h"
#include "editor/preferences/preferences.h"

namespace lamplighter {

class UserFiles {
 public:
  // Empty: there is no such folder, and nothing is read or written.
  explicit UserFiles(std::filesystem::path folder) : folder_(std::move(folder)) {}

  // Reads the settings; missing or invalid values get their defaults. A broken settings file is
  // renamed. If the renaming fails, the file stays and is never overwritten.
  Preferences readPreferences();
  KeyList readKeys();
  // Problems of the files, one line each, with the file name.
  const std::vector<std::string>& problems() const { return problems_; }

  // Call once per frame. Writes the preferences after they have not changed for several calls.
  void keep(const Preferences& preferences);
  // Writes unsaved preferences at once.
  void flush(const Preferences& preferences);
  // The reason why writing failed, once; "": no failure.
  std::string takeWriteProblem();

 private:
  bool putAside(const std::filesystem::path& file);

  std::filesystem::path folder_;
  std::vector<std::string> problems_;
  std::string writeProblem_;
  bool writes_ = true;
  std::string written_;  // content of the file
  Preferences last_;
  int unchanged_ = 0;  // calls of keep() since last_ changed
};

}  // namespace lamplighter
