// Saving, and detection of changes of the level's files by other programs.
#include <algorithm>

#include "editor/session/session.h"
#include "editor/session/user_state.h"
#include "renderer/base/error.h"
#include "renderer/scene/gltf/gltf_io.h"

namespace lamplighter {

namespace fs = std::filesystem;

namespace {

bool isSameFile(const fs::path& a, const fs::path& b) {
  std::error_code error;
  const auto place = [&](const fs::path& p) {
    return fs::weakly_canonical(fs::absolute(p, error), error);
  };
  return place(a) == place(b);
}

}  // namespace

std::vector<fs::path> Session::changedOnDisk(const fs::path& path) const {
  std::vector<fs::path> changed;
  if (writablePath(path) != path) return changed;  // a replay writes into its own folder
  for (size_t i = 0; i < disk_.size(); ++i) {
    // A file in another folder refers only to the files beside it.
    const bool counts =
        i == 0 ? isSameFile(path, disk_[i].path)
               : path.extension() != ".glb" &&
                     isSameFile(path.parent_path() / "x", disk_[i].path.parent_path() / "x");
    if (counts && stampOf(disk_[i].path) != disk_[i]) changed.push_back(disk_[i].path);
  }
  return changed;
}

void Session::save(const fs::path& wanted, bool forced) {
  finishDrag();
  editing_.commit();
  const fs::path path = writablePath(wanted);
  // In a replay, the document keeps its path.
  const bool isElsewhere = path != wanted;
  const std::vector<fs::path> changed = changedOnDisk(wanted);
  if (!changed.empty() && !forced)
    throw InputError(changed.front().string(),
                     "another program has changed or removed it since it was opened",
                     "save under another name (file.save_as), or over it (file.save force)");
  std::string problem = crashRecovery_.saving(document_);
  const std::vector<fs::path> written = saveGltf(document_.scene, path, changed.empty());
  if (!isElsewhere) {
    takeWritten(path, written, changed.empty());
    editing_.setPath(path);
  }
  savedHash_ = sceneHash(document_.scene);
  if (std::string after = crashRecovery_.saved(document_); problem.empty())
    problem = std::move(after);
  home_->preferences.addRecent(path);
  setStatus(problem.empty() ? "Saved " + wanted.filename().string() : "Saved. " + problem);
}

// Stores the files that the level now consists of.
void Session::takeWritten(const fs::path& path, const std::vector<fs::path>& written,
                          bool keepsOthers) {
  std::vector<FileStamp> now{stampOf(path)};
  const auto add = [&](const fs::path& file) {
    const bool isKnown = std::any_of(now.begin(), now.end(),
                                     [&](const FileStamp& s) { return isSameFile(s.path, file); });
    if (!isKnown) now.push_back(stampOf(file));
  };
  for (const fs::path& file : written) add(file);
  // Files beside it remain in use, unless all were written.
  for (size_t i = 1; i < disk_.size() && keepsOthers; ++i) add(disk_[i].path);
  disk_ = std::move(now);
}

bool Session::modified() const { return sceneHash(document_.scene) != savedHash_; }

}  // namespace lamplighter
