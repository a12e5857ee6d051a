#include "editor/recovery/journal.h"

#include "editor/input/recording.h"
#include "editor/recovery/document_delta.h"
#include "editor/recovery/recovery.h"
#include "renderer/base/error.h"
#include "renderer/scene/gltf/gltf_io.h"

namespace lamplighter {

namespace fs = std::filesystem;

namespace {

std::string lineOf(const Json& json) {
  // Names may contain invalid UTF-8. A name with a replacement character is better than no line.
  return json.dump(-1, ' ', false, Json::error_handler_t::replace) + '\n';
}

Json entry(const Document& document, const std::string& label, int64_t time, Json delta) {
  return {{"label", label},
          {"time", time},
          {"hash", hashText(documentHash(document))},
          {"delta", std::move(delta)}};
}

}  // namespace

Journal::Journal(fs::path root, int process, Clock clock)
    : root_(std::move(root)), process_(process), clock_(std::move(clock)) {}

void Journal::begin(const Document& document) {
  close();
  // A level without a file has no meshes or textures that the journal can refer to. So is a level
  // for which there is no memory here: the journal then has all of them.
  files_.clear();
  base_ = Scene();
  isReplaced_ = false;
  savedHash_ = sceneHash(document.scene);
  std::vector<FileStamp> files = filesOf(document.scene);
  if (files.empty()) return;
  base_ = document.scene;
  files_ = std::move(files);
}

void Journal::adopt(Recovered recovered) {
  close();
  folder_ = std::move(recovered.folder);
  lock_ = std::move(recovered.lock);
  base_ = std::move(recovered.base);
  files_ = std::move(recovered.files);
  hasLevel_ = recovered.hasLevel;
  isReplaced_ = false;
  savedHash_ = recovered.savedHash;
  edits_ = recovered.edits;
  restart(recovered.document, hasLevel_);
}

void Journal::start(const Document& document) {
  const std::string name = std::to_string(clock_()) + "-" + std::to_string(process_);
  std::error_code error;
  fs::create_directories(root_, error);
  for (int i = 0;; ++i) {
    folder_ = root_ / (i == 0 ? name : name + "-" + std::to_string(i));
    if (fs::create_directory(folder_, error)) break;
    if (error || i == 1000) {
      const std::string why = error ? error.message() : "its name is taken";
      throw InputError(std::exchange(folder_, {}).string(), "cannot be created (" + why + ")",
                       "save often, because edits are not recorded for recovery");
    }
  }
  lock_ = FileLock(folder_ / "lock");
  if (isReplaced_) writeLevel();
  restart(document, hasLevel_);
}

void Journal::restart(const Document& document, bool hasLevel) {
  hasLevel_ = hasLevel_ || hasLevel;
  Json files = Json::array();
  for (const FileStamp& f : files_) files.push_back({f.path.string(), f.size, f.modified});
  std::error_code error;
  const Json header = {{"lamplighter_journal", 1},
                       {"scene", fs::absolute(document.path, error).string()},
                       {"level", hasLevel_},
                       {"files", std::move(files)},
                       {"saved", hashText(savedHash_)},
                       {"edits", edits_}};
  Blobs blobs(folder_);
  const Json whole = entry(document, "", clock_(), wholeDocument(base_, document, blobs));
  AppendFile anew(folder_ / "journal.new");
  anew.append(lineOf(header) + lineOf(whole));
  fs::rename(folder_ / "journal.new", folder_ / "journal.jsonl", error);
  if (error)
    throw InputError((folder_ / "journal.jsonl").string(),
                     "cannot be written (" + error.message() + ")",
                     "free some space, or save your work now");
  syncFolder(folder_);
  file_ = std::move(anew);
}

void Journal::record(const Document& document, const DocumentChange& change,
                     const std::string& label) {
  if (!file_.isOpen()) {
    Document before = document;
    change.revert(before);
    if (folder_.empty())
      start(before);
    else
      restart(before, hasLevel_);
  }
  Blobs blobs(folder_);
  file_.append(lineOf(entry(document, label, clock_(), deltaOf(base_, change, document, blobs))));
  ++edits_;
}

void Journal::writeLevel() {
  if (hasLevel_ || files_.empty()) return;
  saveSource(base_, folder_ / "level.glb");
  hasLevel_ = true;
}

void Journal::saving(const Document& document) {
  if (!folder_.empty() && !hasLevel_) {
    writeLevel();
    if (file_.isOpen()) restart(document, hasLevel_);
  }
  isReplaced_ = true;
}

void Journal::saved(const Document& document) {
  savedHash_ = sceneHash(document.scene);
  edits_ = 0;
  if (!folder_.empty()) restart(document, hasLevel_);
}

void Journal::close() {
  if (!folder_.empty()) {
    std::error_code ignored;
    fs::remove_all(folder_, ignored);
  }
  folder_.clear();
  file_ = {};
  lock_ = {};
  hasLevel_ = false;
  edits_ = 0;
}

std::optional<Journal::Autosave> Journal::autosave(const Document& document) const {
  if (folder_.empty() || edits_ == 0) return std::nullopt;
  return Autosave{folder_, base_, document.scene, !hasLevel_ && !files_.empty()};
}

void Journal::Autosave::write() const {
  if (needsLevel) saveSource(base, folder / "level.glb");
  saveGltf(scene, folder / "autosave.glb");
}

}  // namespace lamplighter
