// The user's settings.json and keys.json: read when the window opens, the first written when
// something has changed. Replays and recordings have none of this.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "editor/keys/key_bindings.h"
#include "editor/preferences/preferences.h"

namespace lamplighter {

class UserFiles {
 public:
  // Empty: there is no such folder, so nothing is read or kept.
  explicit UserFiles(std::filesystem::path folder) : folder_(std::move(folder)) {}

  // What is there; defaults for what is not or is broken. A broken settings file is put aside under
  // another name, or where that fails is left alone and never written.
  Preferences readPreferences();
  KeyList readKeys();
  // What was wrong, each one line that names the file.
  const std::vector<std::string>& problems() const { return problems_; }

  // Writes them once they have stayed the same for some calls, one a frame.
  void keep(const Preferences& preferences);
  // At once, if they are not written yet.
  void flush(const Preferences& preferences);
  // What kept them from being written, once; "": nothing.
  std::string takeWriteProblem();

 private:
  bool putAside(const std::filesystem::path& file);

  std::filesystem::path folder_;
  std::vector<std::string> problems_;
  std::string writeProblem_;
  bool writes_ = true;
  std::string written_;  // as it is in the file
  Preferences last_;
  int unchanged_ = 0;  // calls of keep() since last_ was another
};

}  // namespace lamplighter
