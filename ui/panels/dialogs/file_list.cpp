#include "ui/panels/dialogs/file_list.h"

#include <algorithm>
#include <cctype>

#include "renderer/base/text.h"

namespace lamplighter {
namespace {

namespace fs = std::filesystem;

std::vector<std::string> endings(FileKind kind) {
  switch (kind) {
    case FileKind::scene:
      return {".gltf", ".glb"};
    case FileKind::picture:
      return {".exr", ".hdr", ".png", ".jpg", ".jpeg", ".webp"};
    case FileKind::profile:
      return {".ies"};
    case FileKind::timeline:
      return {".json", ".csv"};
    case FileKind::folder:
      break;
  }
  return {};
}

}  // namespace

bool fits(FileKind kind, const fs::path& path) {
  const std::vector<std::string> all = endings(kind);
  return std::find(all.begin(), all.end(), lowerCase(path.extension().string())) != all.end();
}

const char* endingsOf(FileKind kind) {
  switch (kind) {
    case FileKind::scene:
      return ".gltf, .glb";
    case FileKind::picture:
      return ".exr, .hdr, .png, .jpg, .webp";
    case FileKind::profile:
      return ".ies";
    case FileKind::timeline:
      return ".json, .csv";
    case FileKind::folder:
      break;
  }
  return "folders";
}

std::vector<FileEntry> listFolder(const fs::path& folder, FileKind kind, std::string& error) {
  std::vector<FileEntry> entries;
  std::error_code wrong;
  for (fs::directory_iterator it(folder, wrong), end; !wrong && it != end; it.increment(wrong)) {
    std::error_code ignored;
    const std::string name = it->path().filename().string();
    if (name.empty() || name.front() == '.') continue;
    if (it->is_directory(ignored))
      entries.push_back({name, true});
    else if (fits(kind, it->path()))
      entries.push_back({name, false});
  }
  error = wrong ? folder.string() + ": " + wrong.message() : "";
  std::sort(entries.begin(), entries.end(), [](const FileEntry& a, const FileEntry& b) {
    return a.folder != b.folder ? a.folder : lowerCase(a.name) < lowerCase(b.name);
  });
  return entries;
}

std::vector<FileEntry> filtered(const std::vector<FileEntry>& entries, const std::string& text) {
  const std::string wanted = lowerCase(text);
  std::vector<FileEntry> out;
  for (const FileEntry& entry : entries)
    if (lowerCase(entry.name).find(wanted) != std::string::npos) out.push_back(entry);
  return out;
}

}  // namespace lamplighter
