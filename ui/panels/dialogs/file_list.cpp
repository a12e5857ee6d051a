#include "ui/panels/dialogs/file_list.h"

#include <algorithm>

#include "renderer/base/text.h"

namespace lamplighter {
namespace fs = std::filesystem;

std::string endingsText(Extensions extensions) {
  std::string text;
  for (const std::string_view extension : extensions)
    text.append(text.empty() ? "" : ", ").append(extension);
  return text.empty() ? "folders" : text;
}

std::vector<FileEntry> listFolder(const fs::path& folder, Extensions extensions,
                                  std::string& error) {
  std::vector<FileEntry> entries;
  std::error_code wrong;
  for (fs::directory_iterator it(folder, wrong), end; !wrong && it != end; it.increment(wrong)) {
    std::error_code ignored;
    const std::string name = it->path().filename().string();
    if (name.empty() || name.front() == '.') continue;
    if (it->is_directory(ignored))
      entries.push_back({name, true});
    else if (hasExtension(it->path(), extensions))
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
