// Protects a session against loss of work: it keeps a journal, and offers the journals that killed
// processes left. It does nothing until start(): replays and most headless runs have no journal.
#pragma once

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "editor/recovery/journal.h"
#include "editor/recovery/recovery.h"

namespace lamplighter {

class CrashRecovery {
 public:
  // Starts a journal in `root` and searches there for recoverable journals.
  void start(std::filesystem::path root, int process, Journal::Clock clock,
             const Document& document);
  bool isOn() const { return journal_ != nullptr; }
  Journal* journal() { return journal_.get(); }

  // The recoverable sessions, newest first.
  const std::vector<Recoverable>& found() const { return found_; }
  void look();

  // Call after a level was opened, and after a committed edit. Returns why the journal is not
  // complete, or an empty text: the next edit then includes what is missing.
  std::string opened(const Document& document);
  std::string committed(const Document& document, const DocumentChange& change,
                        const std::string& label);
  // Call before and after a save. A failure of the journal does not stop the save. Returns the
  // reason, or an empty text.
  std::string saving(const Document& document);
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
