// What a session does so that no work is lost: it keeps a journal and offers what others have left.
// Does nothing until it is started: replays and most headless runs have no journal.
#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "editor/recovery/journal.h"
#include "editor/recovery/recovery.h"

namespace lamplighter {

class CrashRecovery {
 public:
  // Keeps a journal in `root` from now on, and looks for what is left there.
  void start(std::filesystem::path root, int process, Journal::Clock clock,
             const Document& document);
  bool isOn() const { return journal_ != nullptr; }
  Journal* journal() { return journal_.get(); }

  // What can be recovered, newest first.
  const std::vector<Recoverable>& found() const { return found_; }
  void look();

  void opened(const Document& document);
  // Why the edit is not in the journal, or empty.
  std::string committed(const Document& document, const std::string& label);
  // Around a save, which a journal that cannot be written does not hold up; why, or empty.
  std::string saving();
  std::string saved(const Document& document);
  void adopt(Recovered recovered);
  void close();

 private:
  template <typename Write>
  std::string tried(Write write);

  std::filesystem::path root_;
  std::unique_ptr<Journal> journal_;
  std::vector<Recoverable> found_;
};

}  // namespace lamplighter
