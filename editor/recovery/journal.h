// What keeps the work when the program is killed: every committed edit is a line on the disk before
// the edit counts as done. A session that has edits has a folder:
//
//   lock           held by the process that lives
//   journal.jsonl  a header, the document as a whole, then each edit as the values it leaves
//   level.glb      the level as it was opened, for its meshes and textures, once it is needed
//   autosave.glb   the document as of the last autosave, for anybody to open
//   blob-*         meshes and pixels that were pasted, pictures of skies
//
// An undo is an edit too. The last line of a process that was killed may be torn and then does not
// count: it was not confirmed.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "editor/document/document.h"
#include "editor/recovery/append_file.h"
#include "editor/recovery/blobs.h"
#include "renderer/scene/gltf/scene_files.h"

namespace lamplighter {

struct Recovered;

class Journal {
 public:
  using Clock = std::function<int64_t()>;  // seconds since 1970
  // Folders are made in `root`, with the process's number in their names. Makes nothing yet.
  Journal(std::filesystem::path root, int process, Clock clock);

  // Another level is edited from now on; what was written of the one before goes away.
  void begin(const Document& document);
  // The same level goes on that another process was killed with.
  void adopt(Recovered recovered);
  // An edit was committed. On the disk when this returns; throws InputError when it cannot be, and
  // the next call writes what is missing.
  void record(const Document& document, const std::string& label);
  // Before and after the level's file is replaced.
  void saving();
  void saved(const Document& document);
  // The end of a session that has nothing more to lose.
  void close();

  // What an autosave writes, by value: it may run on another thread, beside record().
  struct Autosave {
    std::filesystem::path folder;
    Scene base, scene;
    bool needsLevel = false;
    void write() const;  // throws InputError
  };
  std::optional<Autosave> autosave(const Document& document) const;  // nothing: no edits to lose
  // After it was written: the journal begins anew, at once or not at all.
  void restart(const Document& document, bool hasLevel);

  int edits() const { return edits_; }  // since the level was opened or saved
  const std::filesystem::path& folder() const { return folder_; }  // empty: none yet

 private:
  void start(const Document& document);
  void writeLevel();

  std::filesystem::path root_, folder_;
  int process_;
  Clock clock_;
  FileLock lock_;
  AppendFile file_;
  Scene base_;  // as opened
  std::vector<FileStamp> files_;
  bool hasLevel_ = false;    // level.glb is there
  bool isReplaced_ = false;  // the file that was opened is not as it was any more
  Document last_;            // as of the last line
  uint64_t savedHash_ = 0;
  int edits_ = 0;
};

}  // namespace lamplighter
