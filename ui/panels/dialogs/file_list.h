// What a file dialog lists.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace lamplighter {

enum class FileKind { scene, picture, profile, timeline, folder };

// Whether a file's ending is of that kind; no file is a folder.
bool fits(FileKind kind, const std::filesystem::path& path);
// Endings, as the dialog shows them: ".gltf, .glb".
const char* endingsOf(FileKind kind);

struct FileEntry {
  std::string name;
  bool folder = false;
};
// Folders first, then the files of the kind, by name; hidden ones are left out. `error`: why the
// folder cannot be read, "" where it can.
std::vector<FileEntry> listFolder(const std::filesystem::path& folder, FileKind kind,
                                  std::string& error);
// Those whose names hold the text, in any case.
std::vector<FileEntry> filtered(const std::vector<FileEntry>& entries, const std::string& text);

}  // namespace lamplighter
