#include "editor/recovery/recovery.h"

#include <algorithm>
#include <charconv>
#include <cstdlib>
#include <fstream>
#include <optional>

#include "editor/input/recording.h"
#include "editor/recovery/document_delta.h"
#include "renderer/base/error.h"
#include "renderer/base/json_text.h"
#include "renderer/scene/gltf/gltf_io.h"

namespace lamplighter {

namespace fs = std::filesystem;

namespace {

// Complete lines only: a last line without a line break is incomplete.
std::vector<std::string> linesOf(const fs::path& journal) {
  std::ifstream in(journal, std::ios::binary);
  std::vector<std::string> lines;
  for (std::string line; std::getline(in, line);)
    if (!in.eof()) lines.push_back(line);
  return lines;
}

Json parsed(const std::string& line) { return parseJson<Json>(line); }

uint64_t hashOf(const Json& text) {
  const std::string hex = text.get<std::string>();
  uint64_t hash = 0;
  std::from_chars(hex.data(), hex.data() + hex.size(), hash, 16);
  return hash;
}

[[noreturn]] void cannot(const fs::path& folder, const std::string& why) {
  std::error_code error;
  const fs::path autosave = folder / "autosave.glb";
  throw InputError(
      folder.string(), "cannot be recovered: " + why,
      fs::exists(autosave, error) ? "open " + autosave.string() + " instead" : "discard it");
}

bool isJournal(const Json& header) {
  return header.is_object() && header.contains("lamplighter_journal") &&
         header["lamplighter_journal"] == 1;
}

// The number of edits before the first line.
int editsOf(const Json& header) {
  constexpr int kMost = 1'000'000'000;
  const int edits = wholeOf<int>(header.at("edits"));
  if (edits < 0 || edits > kMost)
    throw InputError("journal", "has an invalid number of edits", "discard it");
  return edits;
}

std::vector<FileStamp> stampsOf(const Json& files) {
  std::vector<FileStamp> out;
  for (const Json& f : files)
    out.push_back(
        {f.at(0).get<std::string>(), wholeOf<uint64_t>(f.at(1)), wholeOf<int64_t>(f.at(2))});
  return out;
}

// The scene with the meshes and textures that the lines refer to.
Scene baseOf(const Recovered& r) {
  if (r.hasLevel) return loadGltf(r.folder / "level.glb").scene;
  if (r.files.empty()) return {};
  for (const FileStamp& stamp : r.files)
    if (stampOf(stamp.path) != stamp)
      cannot(r.folder, stamp.path.string() + " has been changed since");
  return loadGltf(r.files.front().path).scene;
}

Recovered read(const fs::path& folder) {
  Recovered out;
  out.folder = folder;
  const std::vector<std::string> lines = linesOf(folder / "journal.jsonl");
  const Json header = lines.empty() ? Json() : parsed(lines.front());
  if (!isJournal(header) || lines.size() < 2) cannot(folder, "there is no journal in it");
  out.files = stampsOf(header.at("files"));
  out.hasLevel = header.at("level").get<bool>();
  out.savedHash = hashOf(header.at("saved"));
  out.edits = editsOf(header) - 1;  // the first line is not an edit
  out.base = baseOf(out);
  out.document.scene = out.base;
  out.document.path = header.at("scene").get<std::string>();
  Blobs blobs(folder);
  uint64_t hash = 0;
  for (size_t i = 1; i < lines.size(); ++i) {
    const Json line = parsed(lines[i]);
    if (line.is_discarded()) break;
    applyDelta(out.base, out.document, line.at("delta"), blobs);
    hash = hashOf(line.at("hash"));
    if (i > 1) out.labels.push_back(line.at("label").get<std::string>());
    ++out.edits;
  }
  if (documentHash(out.document) != hash)
    out.warning =
        folder.string() + ": not everything could be recovered; check the level before you save it";
  return out;
}

}  // namespace

namespace {

// Nothing if there is no unsaved work or no readable journal.
std::optional<Recoverable> recoverableIn(const fs::path& folder) {
  const std::vector<std::string> lines = linesOf(folder / "journal.jsonl");
  if (lines.size() < 2) return std::nullopt;
  const Json header = parsed(lines.front()), last = parsed(lines.back());
  if (!isJournal(header)) return std::nullopt;
  try {
    Recoverable r{folder, header.at("scene").get<std::string>(), 0,
                  editsOf(header) + static_cast<int>(lines.size()) - 2};
    if (last.is_object() && last.contains("time")) r.time = wholeOf<int64_t>(last["time"]);
    if (r.edits > 0) return r;
  } catch (const std::exception&) {
    // A damaged journal must not prevent the program from starting.
  }
  return std::nullopt;
}

}  // namespace

std::vector<Recoverable> findRecoverable(const fs::path& root) {
  std::vector<Recoverable> out;
  std::error_code error;
  for (fs::directory_iterator it(root, error), end; !error && it != end; it.increment(error)) {
    const fs::path& folder = it->path();
    std::error_code ignored;
    if (!fs::exists(folder / "journal.jsonl", ignored) || !FileLock(folder / "lock")) continue;
    if (auto r = recoverableIn(folder)) out.push_back(std::move(*r));
  }
  std::sort(out.begin(), out.end(), [](const Recoverable& a, const Recoverable& b) {
    return std::pair(b.time, b.folder) < std::pair(a.time, a.folder);
  });
  return out;
}

Recovered recover(const fs::path& folder) {
  FileLock lock(folder / "lock");
  if (!lock) cannot(folder, "another process is using it");
  try {
    Recovered out = read(folder);
    out.lock = std::move(lock);
    return out;
  } catch (const Json::exception&) {
    cannot(folder, "its journal is damaged");
  }
}

void discard(const fs::path& folder) {
  const FileLock lock(folder / "lock");
  std::error_code error;
  if (lock) fs::remove_all(folder, error);
  if (!lock || error)
    throw InputError(
        folder.string(), "cannot be discarded",
        lock ? "check the permissions of the folder" : "end the process that is using it first");
}

fs::path recoveryFolder() {
  // The specification declares relative paths invalid; they are ignored.
  const auto absolute = [](const char* variable) {
    const char* value = std::getenv(variable);
    const fs::path path(value != nullptr ? value : "");
    return path.is_absolute() ? path : fs::path();
  };
  fs::path base = absolute("XDG_STATE_HOME");
  if (base.empty()) {
    base = absolute("HOME");
    if (base.empty()) return {};
    base /= ".local/state";
  }
  return base / "lamplighter" / "recovery";
}

}  // namespace lamplighter
