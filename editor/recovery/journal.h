// Keeps the work if the program is killed: every committed edit is written to the disk as one line
// before the edit counts as done. A session with edits has a folder:
//
//   lock           held by the running process
//   journal.jsonl  a header, the whole document, then the new values of each edit
//   level.glb      the level as opened, for its meshes and textures; written on demand
//   autosave.glb   the document of the last autosave, a normal glTF file
//   blob-*         pasted meshes and pixels, pictures of skies
//
// An undo is also an edit. If the process was killed, the last line may be incomplete. It is then
// ignored, because the edit was not confirmed.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "editor/document/document.h"
#include "editor/edits/document_change.h"
#include "editor/recovery/append_file.h"
#include "editor/recovery/blobs.h"
#include "renderer/scene/gltf/scene_files.h"

namespace lamplighter {

struct Recovered;

class Journal {
 public:
  using Clock = std::function<int64_t()>;  // seconds since 1970
  // Folders in `root` have the process id in their names. The constructor creates nothing.
  Journal(std::filesystem::path root, int process, Clock clock);

  // Call when another level is opened. Deletes the journal of the previous level.
  void begin(const Document& document);
  // Continues the level of a killed process.
  void adopt(Recovered recovered);
  // Call after a committed edit, with what it changed. The edit is on the disk when this returns.
  // If it cannot be written, throws InputError; the next change must then include this one.
  void record(const Document& document, const DocumentChange& change, const std::string& label);
  // Call before and after the level's file is replaced.
  void saving(const Document& document);
  void saved(const Document& document);
  // Ends a session that has nothing to lose.
  void close();

  // The data of an autosave, as a copy: it may be written on another thread in parallel with
  // record().
  struct Autosave {
    std::filesystem::path folder;
    Scene base, scene;
    bool needsLevel = false;
    void write() const;  // throws InputError
  };
  std::optional<Autosave> autosave(const Document& document) const;  // nothing: no unsaved edits
  // Call after the autosave was written. Restarts the journal, atomically.
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
  Scene base_;  // the level as opened
  std::vector<FileStamp> files_;
  bool hasLevel_ = false;    // level.glb exists
  bool isReplaced_ = false;  // the opened file has changed since
  uint64_t savedHash_ = 0;
  int edits_ = 0;
};

}  // namespace lamplighter
