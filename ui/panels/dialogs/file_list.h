// The list of files in a file dialog.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "editor/document/file_kinds.h"

namespace lamplighter {

// Extensions as displayed: ".gltf, .glb"; "folders" if there are none.
std::string endingsText(Extensions extensions);

struct FileEntry {
  std::string name;
  bool folder = false;
};
// Folders first, then the files with one of the extensions, sorted by name, without hidden ones.
// `error`: why the folder cannot be read; "" on success.
std::vector<FileEntry> listFolder(const std::filesystem::path& folder, Extensions extensions,
                                  std::string& error);
// The entries whose names contain the text, ignoring case.
std::vector<FileEntry> filtered(const std::vector<FileEntry>& entries, const std::string& text);

}  // namespace lamplighter
