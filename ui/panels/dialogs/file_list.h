// The list of files in a file dialog.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace lamplighter {

enum class FileKind { scene, picture, profile, timeline, folder };

// Whether the file extension belongs to the kind. No file is of the kind folder.
bool fits(FileKind kind, const std::filesystem::path& path);
// Extensions as displayed: ".gltf, .glb".
const char* endingsOf(FileKind kind);

struct FileEntry {
  std::string name;
  bool folder = false;
};
// Folders first, then the files of the kind, sorted by name, without hidden ones. `error`: why the
// folder cannot be read; "" on success.
std::vector<FileEntry> listFolder(const std::filesystem::path& folder, FileKind kind,
                                  std::string& error);
// The entries whose names contain the text, ignoring case.
std::vector<FileEntry> filtered(const std::vector<FileEntry>& entries, const std::string& text);

}  // namespace lamplighter
